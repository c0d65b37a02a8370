#pragma once

#include "core/Error.h"
#include "core/Solution.h"
#include "core/formfactor/FormFactor.h"
#include "core/math/Image.h"
#include "core/scene/Scene.h"
#include "core/transport/Method.h"
#include "core/transport/Refinement.h"
#include "core/view/ElementImage.h"

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
  Method method = Method::ImportanceShooting;
  Granularity granularity = Granularity::Patch;
  RefinementSettings refinement;
  Accuracy accuracy = Accuracy::Default;
  std::uint32_t visibilityRays = 16; ///< a pair that is partly visible, 1 .. 1024
  std::uint32_t viewRays = 65536;    ///< cast through the image for the view importance, >= 1
  bool initialPhase = true;          ///< methods without importance: direct light of all emitters
                                     ///< first, subdivided at shadow boundaries
  std::uint64_t seed = 1;            ///< of the rays of the view importance

  /// \throw InputError naming the first value out of range.
  void Validate() const;
};

/// When Run() stops: at the first of these that is met, or at convergence.
struct Budget
{
  std::uint64_t steps = std::numeric_limits<std::uint64_t>::max(); ///< more steps from here
  double seconds = std::numeric_limits<double>::infinity();        ///< more wall-clock time, > 0
  double error = 0.0; ///< stop when StepReport::relativeUnshot <= error; 0: only at round-off

  /// \throw InputError when an amount is negative or not a number.
  void Validate() const;
};

/// One line of history.
struct StepReport
{
  std::uint64_t step = 0;        ///< 1 for the first
  std::string phase;             ///< "initial", "radiance", "importance" or "gather"
  PatchId patch = None;          ///< that shot (gathered); of an interaction step: the shooter's
  double viewFlux = 0.0;         ///< estimate of Phi from below, mean of channels
  double unshotViewFlux = 0.0;   ///< its part that is still unshot: sum of dL G Y over interactions
  double unshotPower = 0.0;      ///< sum of A dL pi over patches, W, mean of channels
  double relativeUnshot = 0.0;   ///< how far from converged: see Solver::Run()
  std::size_t elements = 0;      ///< leaves of the element tree
  std::size_t interactions = 0;  ///< that exist
  std::uint64_t evaluations = 0; ///< pairs whose throughput and visibility were computed so far
  std::uint64_t rays = 0;        ///< so far, shadow and view
  double seconds = 0.0;          ///< spent in Run() so far
};

/// What Run() ended for.
enum class RunEnd
{
  Converged,
  Budget,
  Cancelled
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

  /// Other albedos and emissions for the same polygons (as many materials, sidedness unchanged).
  /// Geometry and interactions are kept; radiance and importance start anew.
  /// \throw InputError for bad materials.
  void SetMaterials(const std::vector<Material>& materials);

  /// Observer of Run(): called after each step; returns false to stop there.
  using Observer = std::function<bool(const StepReport&)>;

  /// Works until the budget is spent, the solution has converged, or the observer cancels;
  /// a further call continues where this one stopped.
  /// Converged means: relativeUnshot <= max(budget.error, 1e-13), where relativeUnshot is, for
  /// methods driven by importance, an estimate of the part of the view flux that is not in the
  /// radiance yet, and for the others the unshot power relative to the emitted power. It says how
  /// far the interactions are solved, not how fine they are.
  /// \throw InputError when the method needs a camera and none is set; DivergenceError when the
  /// albedo is 1 in a closed scene.
  RunEnd Run(const Budget& budget = {}, const Observer& observer = {});

  const std::vector<StepReport>& History() const;
  /// What is unusual about the scene, one line each: no emitter, no view, mended polygons.
  std::vector<std::string> Warnings() const;

  ElementSolution Elements() const;
  /// In the order they were made.
  std::vector<InteractionRecord> Interactions() const;
  /// The elements seen by a camera.
  Image Render(const Camera& camera, const ElementImageSettings& settings) const;
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
