#pragma once

#include "core/Solver.h"
#include "report/Measurement.h"

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

/// \file MethodRun.h
/// One method, taken further and further, and judged at every stop.

namespace vantage
{

inline const std::string PathTracingName = "path-tracing";

/// What all runs have in common.
struct Target
{
  Scene scene;
  Camera camera;
  int width = 0; ///< pixels of a picture
  int height = 0;
  Image reference;       ///< radiance at the centres of these pixels
  double noise = 0.0;    ///< of the reference, relative L1; 0: not known
  double exposure = 0.0; ///< with which pictures are shown
  std::string identity;  ///< of all of the above, as text
};

/// One run: a method with one accuracy of its graph, stopped at ever larger budgets.
struct RunPlan
{
  std::string method;
  std::optional<double> powerTolerance; ///< of methods on a fixed graph
  std::vector<double> budgets;          ///< asked errors, largest first; of path tracing samples
  double seconds = 0.0;                 ///< at most, of processor time, for all solving; > 0
  std::uint64_t seed = 1;
  std::size_t threads = 1;

  /// All of it, as text.
  std::string Identity() const;
  /// "importance-shooting, power tolerance 0.0003".
  std::string Title() const;
};

/// What a run tells; any of them may throw, which ends it.
struct RunObserver
{
  std::function<void(double part)> progressed;
  std::function<void(const Measurement&, const Image&)> measured; ///< without names of files
  std::function<void(const Solver&)> solved; ///< after the stop next to ExampleError
};

/// Of which interactions are drawn.
inline constexpr double ExampleError = 0.05;

/// A run stops at the same states whether it goes through other budgets before or not, so that what
/// is measured at each is what a run of its own would give: processor time of the solution up to
/// there, and of its picture. Pixel centres. A solution is gathered with the share of its asked
/// error (GatherShare) that a picture of `vantage render` has. The solutions of methods other than
/// goal-oriented are shown in two ways, each with its own time: gathered, and by their elements.
/// Path tracing begins anew at every budget.
void RunMethod(const Target& target, const RunPlan& plan, const RunObserver& observer);

} // namespace vantage
