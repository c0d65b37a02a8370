#pragma once

#include "report/MethodRun.h"

#include <array>
#include <optional>
#include <string>
#include <vector>

namespace CLI
{
class App;
}

/// \file ReportOptions.h
/// The arguments of `vantage report`.

namespace vantage
{

/// Every method, "path-tracing" last: the order of tables and legends.
std::vector<std::string> ReportMethodNames();

struct ReportOptions
{
  std::string scene;
  std::string folder;
  std::string camera;                     ///< empty: the first of the scene
  std::optional<std::array<int, 2>> size; ///< pixels
  std::vector<std::string> methods = ReportMethodNames();
  std::vector<double> errors = { 0.3, 0.1, 0.05, 0.02, 0.01, 0.005 };
  std::vector<double> powerTolerances = { 3e-3, 1e-3, 3e-4, 1e-4 };
  std::vector<int> samples = { 1, 4, 16, 64, 256, 1024 };
  double seconds = 20.0;       ///< of processor time for solving, each run
  std::string reference;       ///< an image, or empty
  std::string referenceFolder; ///< where references are kept; empty: in `folder`
  int threads = 1;             ///< of what is measured; 0: all
  std::uint64_t seed = 1;
  bool quiet = false;

  /// Checks all that can be checked without the scene and brings lists into order.
  /// \throw InputError for the first thing that is wrong.
  void Resolve();
  /// The camera, with the aspect ratio of the pictures. \throw InputError
  Camera ChooseCamera(const Scene& scene) const;
  /// Width and height of pictures for that camera.
  std::array<int, 2> SizeFor(const Camera& camera) const;
  /// What is to be measured, in the order of ReportMethodNames().
  std::vector<RunPlan> MakePlans() const;
  /// The command line with all that was left to defaults.
  std::string CommandLine(const Target& target) const;
};

/// Declares the arguments; `options` must outlive the parsing.
void DeclareReportOptions(CLI::App& command, ReportOptions& options);

} // namespace vantage
