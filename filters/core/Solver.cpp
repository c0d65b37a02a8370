#include "core/Solver.h"

#include "core/GoalOrientedEngine.h"
#include "core/ShootingEngine.h"
#include "core/mesh/ContactCuts.h"
#include "core/mesh/DarkSides.h"
#include "core/transport/Solvability.h"
#include "core/view/ViewImportance.h"

#include <algorithm>
#include <chrono>
#include <cmath>

namespace vantage
{

namespace
{

/// Below this part nothing but round-off is left.
constexpr double RoundOff = 1e-13;

std::vector<PatchOptics> MakeOptics(const FacetSet& facets, const std::vector<Material>& materials)
{
  std::vector<PatchOptics> optics(2 * facets.facets.size());
  for (std::uint32_t f = 0; f < facets.facets.size(); ++f)
  {
    const Facet& facet = facets.facets[f];
    for (const Side side : { Side::Front, Side::Back })
    {
      const Material& material = materials[facet.MaterialOf(side)];
      PatchOptics& patch = optics[PatchOf(f, side)];
      patch.albedo = material.albedo;
      patch.emission = facet.IsPolygonFront(side) ? material.emission : Color(0.0);
    }
  }
  return optics;
}

Scene Validated(Scene scene)
{
  scene.Validate();
  return scene;
}

std::unique_ptr<Engine> MakeEngine(const SolverSettings& settings, const Scene& scene,
  const FacetSet& facets, const DarkSides& dark, const OccluderScene& occluders)
{
  settings.Validate();
  ElementTree tree(facets, scene.materials, dark);
  std::vector<PatchOptics> optics = MakeOptics(facets, scene.materials);
  if (settings.method == Method::GoalOriented)
  {
    return std::make_unique<GoalOrientedEngine>(std::move(tree), occluders, std::move(optics),
      facets.meanArea,
      GoalOrientedSettings{ settings.visibilityRays, settings.refinement.minimumElementSize,
        settings.refinement.maximumLevel, settings.importance, settings.seed });
  }
  return std::make_unique<ShootingEngine>(std::move(tree), occluders, std::move(optics),
    facets.meanArea,
    ShootingSettings{ settings.method, settings.granularity,
      { settings.refinement, settings.accuracy, settings.visibilityRays }, settings.initialPhase });
}

double SecondsSince(std::chrono::steady_clock::time_point start)
{
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

} // namespace

void SolverSettings::Validate() const
{
  this->refinement.Validate();
  if (this->visibilityRays < 1 || this->visibilityRays > 1024)
  {
    throw InputError("solver: visibilityRays is " + std::to_string(this->visibilityRays) +
                     "; give an integer from 1 to 1024");
  }
  if (this->viewRays < 1)
  {
    throw InputError("solver: viewRays is 0; give at least 1");
  }
  if (Gathers(this->method) && this->granularity == Granularity::Interaction)
  {
    throw InputError("solver: " + NameOf(this->method) +
                     " gathers at whole patches; choose the granularity patch");
  }
}

void Budget::Validate() const
{
  if (!(this->seconds > 0.0))
  {
    throw InputError(
      "budget: seconds is " + std::to_string(this->seconds) + "; give a number above zero");
  }
  if (!(this->error >= 0.0 && std::isfinite(this->error)))
  {
    throw InputError("budget: error is " + std::to_string(this->error) + "; give a number >= 0");
  }
}

double FractionDone(const Budget& budget, const StepReport& before, const StepReport& now)
{
  const double goal = std::max(budget.error, RoundOff);
  const double byError = std::log(std::max(now.errorEstimate, goal)) / std::log(goal);
  const double bySteps =
    static_cast<double>(now.step - before.step) / static_cast<double>(budget.steps);
  const double byTime = (now.seconds - before.seconds) / budget.seconds;
  return std::clamp(std::max({ 0.0, byError, bySteps, byTime }), 0.0, 1.0);
}

/// What the public face hides: it composes the layers.
struct Solver::Implementation
{
  Implementation(Scene givenScene, const SolverSettings& givenSettings)
    : scene(Validated(std::move(givenScene)))
    , settings(givenSettings)
    , facets(CutAtContacts(BuildFacets(this->scene)))
    , dark(FindDarkSides(this->facets, this->scene.materials))
    , occluders(std::make_shared<const OccluderScene>(this->facets, this->dark))
    , engine(MakeEngine(givenSettings, this->scene, this->facets, this->dark, *this->occluders))
  {
  }

  /// One move; false when there is nothing left to do.
  bool Advance()
  {
    std::optional<StepReport> report = this->engine->Advance();
    if (!report)
    {
      return false;
    }
    report->work.viewRays = this->castViewRays;
    report->seconds = this->secondsBefore + SecondsSince(this->runStart);
    this->history.push_back(*report);
    return true;
  }

  bool SeesBackSidesOnly(const std::vector<ViewSample>& samples) const
  {
    return std::none_of(samples.begin(), samples.end(),
      [this](const ViewSample& sample)
      {
        const Patch& patch = this->engine->Tree().Patches()[sample.patch];
        return this->facets.facets[patch.facet].IsPolygonFront(patch.side);
      });
  }

  void RequireRunnable(const Budget& budget) const
  {
    const std::string method = NameOf(this->settings.method);
    if (this->engine->NeedsView())
    {
      throw InputError(
        "solver: " + method + " needs a camera; set one, or choose progressive-shooting");
    }
    const bool isLimited = budget.error > 0.0 || std::isfinite(budget.seconds) ||
                           budget.steps < std::numeric_limits<std::uint64_t>::max();
    if (this->settings.method == Method::GoalOriented && !isLimited)
    {
      throw InputError("budget: " + method +
                       " would refine without end; give an error above zero, "
                       "a number of steps or a time");
    }
  }

  /// Not when a lamp is switched on inside a closed body.
  bool KnowsAllThatIsLit(const std::vector<Material>& materials) const
  {
    if (std::none_of(materials.begin(), materials.end(),
          [](const Material& material) { return MaxChannel(material.emission) > 0.0; }))
    {
      return true; // FindDarkSides() finds nothing then
    }
    const DarkSides stillDark = FindDarkSides(this->facets, materials);
    return std::equal(this->dark.bodyOf.begin(), this->dark.bodyOf.end(), stillDark.bodyOf.begin(),
      [](std::uint32_t before, std::uint32_t now) { return before == None || now != None; });
  }

  /// Materials have changed, or nothing has been asked of them yet.
  void RequireSolvableOnce()
  {
    if (!this->isKnownSolvable)
    {
      RequireSolvable(
        this->engine->Tree(), *this->occluders, MakeOptics(this->facets, this->scene.materials));
      this->isKnownSolvable = true;
    }
  }

  Scene scene;
  SolverSettings settings;
  FacetSet facets;
  DarkSides dark;
  std::shared_ptr<const OccluderScene> occluders;
  std::unique_ptr<Engine> engine;
  std::vector<StepReport> history;
  std::uint64_t castViewRays = 0;
  bool seesNothing = false;
  bool seesBackSidesOnly = false;
  bool isKnownSolvable = false;
  double secondsBefore = 0.0; ///< in earlier calls of Run()
  std::chrono::steady_clock::time_point runStart;
};

Solver::Solver(Scene scene, const SolverSettings& settings)
  : Impl(std::make_unique<Implementation>(std::move(scene), settings))
{
}

Solver::~Solver() = default;
Solver::Solver(Solver&&) noexcept = default;
Solver& Solver::operator=(Solver&&) noexcept = default;

void Solver::SetCamera(const Camera& camera)
{
  camera.Validate();
  Implementation& s = *this->Impl;
  std::vector<ViewSample> samples =
    SampleView(*s.occluders, s.engine->Tree(), camera, s.settings.viewRays, s.settings.seed);
  s.castViewRays += s.settings.viewRays;
  s.seesNothing = samples.empty();
  s.seesBackSidesOnly = !samples.empty() && s.SeesBackSidesOnly(samples);
  s.engine->SetView(std::move(samples));
}

bool Solver::CanTake(const std::vector<Material>& materials) const
{
  const Implementation& s = *this->Impl;
  const std::vector<Material>& known = s.scene.materials;
  return std::equal(known.begin(), known.end(), materials.begin(), materials.end(),
           [](const Material& a, const Material& b) { return a.twoSided == b.twoSided; }) &&
         s.KnowsAllThatIsLit(materials);
}

void Solver::SetMaterials(const std::vector<Material>& materials)
{
  Implementation& s = *this->Impl;
  Scene changed = s.scene;
  changed.materials = materials;
  changed.Validate();
  if (!this->CanTake(materials))
  {
    throw InputError("materials: their number, their sidedness and which closed bodies have no "
                     "lamp inside belong to the geometry; make a new solver to change them");
  }
  s.scene = std::move(changed);
  s.engine->SetOptics(MakeOptics(s.facets, s.scene.materials));
  s.isKnownSolvable = false;
}

RunEnd Solver::Run(const Budget& budget, const Observer& observer)
{
  budget.Validate();
  Implementation& s = *this->Impl;
  Engine& engine = *s.engine;
  s.RequireRunnable(budget);
  s.RequireSolvableOnce();
  s.runStart = std::chrono::steady_clock::now();
  const auto hasTime = [&] { return SecondsSince(s.runStart) < budget.seconds; };
  engine.Prepare(hasTime);
  const double share = s.settings.method == Method::GoalOriented ? GoalShare : 1.0;
  const double goal = std::max(share * budget.error, RoundOff);
  const std::uint64_t firstStep = engine.Steps();
  RunEnd end = RunEnd::Budget;
  while (true)
  {
    if (engine.IsAtStep() && engine.ErrorEstimate() <= goal)
    {
      end = RunEnd::Converged;
      break;
    }
    if ((engine.IsAtStep() && engine.Steps() - firstStep >= budget.steps) || !hasTime())
    {
      break;
    }
    if (!s.Advance())
    {
      end = engine.ErrorEstimate() <= goal ? RunEnd::Converged : RunEnd::Exhausted;
      break;
    }
    if (observer && !observer(s.history.back()))
    {
      end = RunEnd::Cancelled;
      break;
    }
  }
  s.secondsBefore += SecondsSince(s.runStart);
  return end;
}

const std::vector<StepReport>& Solver::History() const
{
  return this->Impl->history;
}

std::vector<std::string> Solver::Warnings() const
{
  const Implementation& s = *this->Impl;
  std::vector<std::string> warnings;
  if (s.engine->EmittedPower() == 0.0)
  {
    warnings.push_back("scene: nothing in it emits light; every image will be black");
  }
  if (s.seesNothing)
  {
    warnings.push_back("camera: it sees nothing; move it or turn it towards the scene");
  }
  if (s.seesBackSidesOnly)
  {
    warnings.push_back(
      "camera: it sees nothing but back sides; is it inside a wall or a piece of furniture?");
  }
  if (s.facets.report.degeneratePolygons > 0)
  {
    warnings.push_back("scene: dropped " + std::to_string(s.facets.report.degeneratePolygons) +
                       " polygons without area");
  }
  const std::vector<std::string> ofMaterials = WarningsOf(s.scene.materials);
  warnings.insert(warnings.end(), ofMaterials.begin(), ofMaterials.end());
  return warnings;
}

ElementSolution Solver::Elements() const
{
  const Implementation& s = *this->Impl;
  const ElementTree& tree = s.engine->Tree();
  return s.engine->Elements(s.facets, tree, PatchMesh(tree, s.facets).Surface());
}

GatheredElements Solver::GatherElements(const Camera& camera, double error) const
{
  camera.Validate();
  if (!(error > 0.0 && error <= 1.0))
  {
    throw InputError(
      "elements: error is " + std::to_string(error) + "; give a number above 0 and not above 1");
  }
  const Implementation& s = *this->Impl;
  MeshGatherSettings settings;
  settings.interpolationError = std::max(InterpolationShare * error, LeastGatherError);
  settings.gatherError = std::max(GatherShare * error, LeastGatherError);
  settings.seed = s.settings.seed;
  GatheredMesh mesh = GatherMesh(*s.occluders, s.engine->Radiance(), s.facets, s.engine->Tree(),
    SampleView(*s.occluders, s.engine->Tree(), camera, s.settings.viewRays, s.settings.seed),
    settings);
  GatheredElements gathered;
  gathered.elements = s.engine->Elements(s.facets, std::move(mesh.tree), std::move(mesh.surface));
  gathered.elements.pointRadiance = std::move(mesh.pointRadiance);
  std::vector<Color>& irradiance = gathered.elements.pointIrradiance;
  if (!irradiance.empty())
  {
    for (std::size_t k = 0; k < mesh.gathered.size(); ++k)
    {
      irradiance[mesh.gathered[k]] = mesh.irradiance[k];
    }
  }
  gathered.errorEstimate = std::hypot(mesh.interpolationError, mesh.gatherError);
  gathered.counts = mesh.counts;
  return gathered;
}

std::vector<InteractionRecord> Solver::Interactions() const
{
  return this->Impl->engine->Interactions();
}

Image Solver::Render(const Camera& camera, const ElementImageSettings& settings) const
{
  const Implementation& s = *this->Impl;
  const ElementSolution solution = this->Elements();
  return RenderElements(*s.occluders, s.engine->Tree(), solution.surface,
    settings.flat ? solution.radiance : solution.pointRadiance, camera, settings);
}

std::shared_ptr<const SolutionSnapshot> Solver::Snapshot() const
{
  return std::make_shared<const SolutionSnapshot>(
    this->Impl->occluders, this->Impl->engine->Radiance());
}

GatheredView Solver::Gather(
  const Camera& camera, const GatherSettings& settings, const GatherObserver& observer) const
{
  return this->Snapshot()->Gather(camera, settings, observer);
}

Color Solver::ViewFluxOfRadiance() const
{
  return this->Impl->engine->ViewFluxOfRadiance();
}

Color Solver::ViewFluxOfImportance() const
{
  return this->Impl->engine->ViewFluxOfImportance();
}

std::size_t Solver::MemoryBytes() const
{
  return this->Impl->engine->Bytes();
}

const Scene& Solver::GetScene() const
{
  return this->Impl->scene;
}

const SolverSettings& Solver::Settings() const
{
  return this->Impl->settings;
}

} // namespace vantage
