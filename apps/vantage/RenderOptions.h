#pragma once

#include "CameraOptions.h"
#include "core/Solver.h"
#include "core/reference/PathTracer.h"
#include "core/view/ToneMapping.h"

#include <optional>
#include <string>
#include <vector>

namespace CLI
{
class App;
}

/// \file RenderOptions.h
/// The arguments of `vantage render`.

namespace vantage
{

/// Words and numbers as they were given. The settings of the core are filled directly; names that
/// stand for an enumeration are looked up in Resolve().
struct RenderOptions
{
  std::string scene;
  std::vector<std::string> outputs; ///< .png .exr .vti .vtp
  std::string irradiance;           ///< .exr
  std::string links;                ///< .vtp
  std::string history;              ///< .csv
  std::string report;               ///< .json

  CameraOptions view; ///< an image for each name
  std::string walk;   ///< a file of cameras (io/CameraFile.h), instead

  std::string method = NameOf(SolverSettings().method);
  std::string granularity = NameOf(Granularity::Patch);
  std::string oracle = NameOf(RefinementOracle::BF);
  SolverSettings solver;
  std::optional<std::uint64_t> steps;
  std::optional<double> error;
  std::optional<double> seconds;
  std::optional<int> samplesPerPixel;
  bool pixelCentres = false;
  bool flat = false;

  int threads = 0; ///< 0: all
  ToneMappingSettings toneMapping;
  bool quiet = false;

  bool IsPathTracing() const;
  /// Whether the image is gathered from the solution, not drawn from its elements.
  bool IsGathered() const;
  /// Looks the names up and checks everything that can be checked without the scene: names,
  /// numbers, suffixes, and whether the outputs can be written.
  /// \throw InputError for the first thing that is wrong.
  void Resolve();
  /// Whether any output shows pixels.
  bool WantsImage() const;

  Budget MakeBudget() const;
  ElementImageSettings MakeImageSettings(const Camera& camera) const;
  GatherSettings MakeGatherSettings(const Camera& camera) const;
  /// Of a picture that the gathered points of elements give, in (0, 1].
  double ErrorOfElements() const;
  PathTracerSettings MakePathTracerSettings() const;
  /// As CameraOptions::Choose(). \throw InputError
  std::vector<Camera> ChooseCameras(const Scene& scene) const;
  /// Where the image of frame k of n goes: `output` when it is the only one, else with the number,
  /// from 0001, before the suffix.
  static std::string FramePath(const std::string& output, std::size_t k, std::size_t n);

private:
  void RequireOptionsOfTheMethod() const;
  void CheckOutputs() const;
};

/// Declares the arguments; `options` must outlive the parsing.
void DeclareRenderOptions(CLI::App& command, RenderOptions& options);

} // namespace vantage
