#pragma once

#include "core/Error.h"
#include "core/Solution.h"
#include "core/SolutionSnapshot.h"
#include "core/StepReport.h"
#include "core/formfactor/FormFactor.h"
#include "core/math/Image.h"
#include "core/scene/Scene.h"
#include "core/transport/Method.h"
#include "core/transport/Refinement.h"
#include "core/view/ElementImage.h"
#include "core/view/MeshGather.h"

#include <cstdint>
#include <functional>
#include <limits>
#include <memory>
#include <string>
#include <vector>

/// \file Solver.h
/// The public face of the core: a scene goes in, Run() works on it, solution and report come out.

namespace vantage
{

/// How the solver works. Changing any of these needs a new solver.
struct SolverSettings
{
  Method method = Method::GoalOriented;
  Granularity granularity = Granularity::Patch; ///< of the shooting methods
  RefinementSettings refinement; ///< goal-oriented: minimumElementSize and maximumLevel only
  Accuracy accuracy = Accuracy::Default; ///< of form factors; not of goal-oriented
  std::uint32_t visibilityRays = 16;     ///< a pair that is partly visible, 1 .. 1024
  std::uint32_t viewRays = 16384;        ///< cast through the image for the view importance, >= 1
  bool initialPhase = true; ///< methods without importance: direct light of all emitters
                            ///< first, subdivided at shadow boundaries
  bool importance = true;   ///< goal-oriented: false refines for all surfaces alike
  std::uint64_t seed = 1;   ///< of the rays of the view importance, and of goal-oriented those of
                            ///< the interactions

  /// \throw InputError naming the first value out of range.
  void Validate() const;
};

/// When Run() stops: at the first of these that is met, or at convergence.
struct Budget
{
  std::uint64_t steps = std::numeric_limits<std::uint64_t>::max(); ///< more steps from here
  double seconds = std::numeric_limits<double>::infinity();        ///< more wall-clock time, > 0
  double error = 0.0; ///< stop when StepReport::errorEstimate <= error; 0: only at round-off, which
                      ///< goal-oriented never reaches

  /// \throw InputError when an amount is negative or not a number.
  void Validate() const;
};

/// The part of a budget that is used up, 0 to 1, by the criterion that is nearest to its end.
/// `before`: the last step of earlier runs. Errors fall geometrically, so their logarithms tell how
/// far they are.
double FractionDone(const Budget& budget, const StepReport& before, const StepReport& now);

/// Of the error of a picture, the parts that are left to the solution and to the gather; they are
/// independent, so their squares add up to that of the whole. Measured: the least time to a true
/// error of 1 % in labyrinths and study scenes, where nineteen pictures of twenty keep what was
/// asked (vantage-benchmarks speed, study).
inline constexpr double GoalShare = 0.83;
inline constexpr double GatherShare = 0.55;

/// The same of a mesh whose points are gathered and interpolated between (GatherElements()).
inline constexpr double InterpolationShare = 0.35;

/// Elements that are fine enough to be drawn, with the light of a view at their points.
struct GatheredElements
{
  ElementSolution elements;
  /// Of the picture that they give, relative L1, without the error of the solution.
  double errorEstimate = 0.0;
  GatherCounts counts;
};

/// What Run() ended for.
enum class RunEnd
{
  Converged,
  Budget,
  Cancelled,
  Exhausted ///< nothing is left to do, but the error is above what was asked for
};

/// Progressive solution of one scene. Not to be used from two threads at once; works on all
/// threads of the current TBB arena, with the same result for any number of them.
class Solver
{
public:
  /// Builds facets, tree and occluders. \throw InputError for a bad scene or settings.
  explicit Solver(Scene scene, const SolverSettings& settings = {});
  ~Solver();
  Solver(Solver&&) noexcept;
  Solver& operator=(Solver&&) noexcept;

  /// Looks from another camera. Radiance, elements and interactions are kept; importance starts
  /// anew. \throw InputError for a bad camera.
  void SetCamera(const Camera& camera);

  /// Whether SetMaterials() can: there are as many of them, as sided as before, and none of them
  /// makes a lamp of what is inside a closed body that was dark (mesh/DarkSides.h).
  bool CanTake(const std::vector<Material>& materials) const;
  /// Other albedos and emissions for the same polygons. Geometry and interactions are kept;
  /// radiance and importance start anew. \throw InputError for bad materials, and those it cannot
  /// take.
  void SetMaterials(const std::vector<Material>& materials);

  /// Observer of Run(): called after each step; returns false to stop there.
  using Observer = std::function<bool(const StepReport&)>;

  /// Works until the budget is spent, the solution has converged or is exhausted, or the
  /// observer cancels; a further call continues where this one stopped.
  ///
  /// Converged means StepReport::errorEstimate <= max(budget.error, 1e-13). Of the methods on a
  /// fixed graph of interactions the estimate is the part that is still unshot (of the view flux
  /// where importance drives them, else of the emitted power): it says how far the interactions are
  /// solved, not how fine they are. Of goal-oriented it is the relative L1 error of a gathered
  /// picture (Gather()), and the run ends at GoalShare of budget.error, as the gather adds its own.
  /// It is exhausted when no interaction may be refined any more, as elements are as small as the
  /// refinement settings allow; with 200,000 of them also when nine tenths of the error (its
  /// square) lie where none may.
  ///
  /// \throw InputError when the method needs a camera and none is set, or when goal-oriented is
  /// given no limit at all; DivergenceError when the albedo is 1 in a closed scene.
  RunEnd Run(const Budget& budget = {}, const Observer& observer = {});

  const std::vector<StepReport>& History() const;
  /// What is unusual about the scene, one line each: no emitter, no view, mended polygons, specular
  /// materials.
  std::vector<std::string> Warnings() const;

  /// Before the first step what is emitted.
  ElementSolution Elements() const;
  /// In the order they were made.
  std::vector<InteractionRecord> Interactions() const;
  /// The elements split further where a camera sees light that varies, with gathered light at their
  /// points: what plain Gouraud shading of them needs. `error` is that of the picture, relative L1,
  /// of which gather and interpolation take their shares, though none below LeastGatherError.
  /// \throw InputError for a bad camera, or an error outside (0, 1].
  GatheredElements GatherElements(const Camera& camera, double error) const;
  /// The elements seen by a camera.
  Image Render(const Camera& camera, const ElementImageSettings& settings) const;
  /// What Gather() needs, for pictures that outlive the solver or its next step. O(elements).
  std::shared_ptr<const SolutionSnapshot> Snapshot() const;
  /// The picture of a camera; see SolutionSnapshot::Gather().
  GatheredView Gather(const Camera& camera, const GatherSettings& settings,
    const GatherObserver& observer = {}) const;
  /// Estimates of Phi, each channel: from radiance <V, L> and from importance <E, P>; they agree
  /// at convergence when all interactions exist (duality).
  Color ViewFluxOfRadiance() const;
  Color ViewFluxOfImportance() const;
  /// Bytes held by tree, interactions and fields.
  std::size_t MemoryBytes() const;

  const Scene& GetScene() const;
  const SolverSettings& Settings() const;

private:
  struct Implementation;
  std::unique_ptr<Implementation> Impl;
};

} // namespace vantage
