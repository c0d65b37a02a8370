#include "core/Solver.h"

#include "core/transport/Schedule.h"
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

TransportSettings TransportPart(const SolverSettings& settings)
{
  settings.Validate();
  return { settings.refinement, settings.accuracy, settings.visibilityRays };
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
  if (this->method == Method::GaussSeidel && this->granularity == Granularity::Interaction)
  {
    throw InputError("solver: gauss-seidel gathers at whole patches; choose the granularity patch");
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

/// What the public face hides: it composes the layers.
struct Solver::Implementation
{
  Implementation(Scene givenScene, const SolverSettings& givenSettings)
    : scene(Validated(std::move(givenScene)))
    , settings(givenSettings)
    , facets(BuildFacets(this->scene))
    , occluders(this->facets)
    , transport(ElementTree(this->facets, this->scene.materials), this->occluders,
        MakeOptics(this->facets, this->scene.materials), this->facets.meanArea,
        TransportPart(givenSettings))
    , schedule(MakeSchedule(givenSettings.method, givenSettings.granularity, this->transport))
  {
    this->CollectEmitters();
  }

  bool UsesImportance() const { return this->settings.method == Method::ImportanceShooting; }

  /// Emitters in the order of the initial phase: the strongest first.
  void CollectEmitters()
  {
    this->pendingEmitters.clear();
    if (!this->settings.initialPhase || this->UsesImportance())
    {
      return;
    }
    const ElementTree& tree = this->transport.Tree();
    const auto power = [&](PatchId p)
    { return tree[tree.Patches()[p].node].area * Mean(this->transport.OpticsOf(p).emission); };
    for (PatchId p = 0; p < tree.Patches().size(); ++p)
    {
      if (tree.Patches()[p].IsActive() && power(p) > 0.0)
      {
        this->pendingEmitters.push_back(p);
      }
    }
    // The next one is at the back.
    std::stable_sort(this->pendingEmitters.begin(), this->pendingEmitters.end(),
      [&](PatchId a, PatchId b) { return power(a) < power(b); });
  }

  /// One move; false when there is nothing left to do.
  bool Advance()
  {
    Step step;
    const bool isInitial = !this->pendingEmitters.empty();
    if (isInitial)
    {
      step.patch = this->pendingEmitters.back();
      this->pendingEmitters.pop_back();
    }
    else
    {
      const auto next =
        this->schedule->Next(this->transport, static_cast<std::uint32_t>(this->steps + 1));
      if (!next)
      {
        return false;
      }
      step = *next;
      ++this->steps;
    }
    this->schedule->Perform(this->transport, step, static_cast<std::uint32_t>(this->steps));
    this->Report(step, isInitial);
    return true;
  }

  void Report(const Step& step, bool isInitial)
  {
    const Residual rest = this->schedule->Rest(this->transport);
    const Color known = this->transport.ViewFluxEstimate();
    StepReport report;
    report.step = this->steps;
    report.phase = isInitial                             ? "initial"
                   : step.kind == Step::Kind::Gather     ? "gather"
                   : step.quantity == Quantity::Radiance ? "radiance"
                                                         : "importance";
    report.patch = step.patch;
    report.viewFlux = Mean(known);
    report.unshotViewFlux = Mean(known - this->transport.ViewFluxReceived());
    report.unshotPower = rest.unshotPower;
    report.relativeUnshot = rest.relativeUnshot;
    report.elements = this->transport.Tree().LeafElementCount();
    report.interactions = this->transport.Graph().Size();
    report.evaluations = this->transport.Counters().evaluations;
    report.rays = this->transport.Counters().rays + this->castViewRays;
    report.seconds = this->secondsBefore + SecondsSince(this->runStart);
    this->history.push_back(report);
  }

  bool SeesBackSidesOnly(const std::vector<ViewSample>& samples) const
  {
    return std::none_of(samples.begin(), samples.end(),
      [this](const ViewSample& sample)
      {
        const Patch& patch = this->transport.Tree().Patches()[sample.patch];
        return this->facets.facets[patch.facet].IsPolygonFront(patch.side);
      });
  }

  /// Materials have changed, or nothing has been asked of them yet.
  void RequireSolvableOnce()
  {
    if (!this->isKnownSolvable)
    {
      RequireSolvable(
        this->transport.Tree(), this->occluders, MakeOptics(this->facets, this->scene.materials));
      this->isKnownSolvable = true;
    }
  }

  Scene scene;
  SolverSettings settings;
  FacetSet facets;
  OccluderScene occluders;
  Transport transport;
  std::unique_ptr<Schedule> schedule;
  std::vector<PatchId> pendingEmitters; ///< of the initial phase
  std::vector<StepReport> history;
  std::uint64_t steps = 0;
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
    SampleView(s.occluders, s.transport.Tree(), camera, s.settings.viewRays, s.settings.seed);
  s.castViewRays += s.settings.viewRays;
  s.seesNothing = samples.empty();
  s.seesBackSidesOnly = !samples.empty() && s.SeesBackSidesOnly(samples);
  s.transport.SetView(std::move(samples));
  s.schedule->RestartImportance();
}

void Solver::SetMaterials(const std::vector<Material>& materials)
{
  Implementation& s = *this->Impl;
  Scene changed = s.scene;
  changed.materials = materials;
  changed.Validate();
  for (std::size_t m = 0; m < s.scene.materials.size(); ++m)
  {
    if (materials.size() != s.scene.materials.size() ||
        materials[m].twoSided != s.scene.materials[m].twoSided)
    {
      throw InputError("materials: their number and sidedness belong to the geometry; make a new "
                       "solver to change them");
    }
  }
  s.scene = std::move(changed);
  s.transport.SetOptics(MakeOptics(s.facets, s.scene.materials));
  s.schedule->RestartImportance();
  s.schedule->RestartRadiance(s.transport);
  s.isKnownSolvable = false;
  s.CollectEmitters();
}

RunEnd Solver::Run(const Budget& budget, const Observer& observer)
{
  budget.Validate();
  Implementation& s = *this->Impl;
  if (s.UsesImportance() && !s.transport.HasView())
  {
    throw InputError(
      "solver: importance-shooting needs a camera; set one, or choose progressive-shooting");
  }
  s.RequireSolvableOnce();
  s.runStart = std::chrono::steady_clock::now();
  // What the eye sees is expanded first, so that the reported flux never falls.
  while (SecondsSince(s.runStart) < budget.seconds &&
         s.transport.ExpandNextVisible(static_cast<std::uint32_t>(s.steps)))
  {
  }
  const double goal = std::max(budget.error, RoundOff);
  const std::uint64_t firstStep = s.steps;
  RunEnd end = RunEnd::Budget;
  while (true)
  {
    const bool isInitial = !s.pendingEmitters.empty();
    if (!isInitial && s.schedule->Rest(s.transport).relativeUnshot <= goal && s.steps > 0)
    {
      end = RunEnd::Converged;
      break;
    }
    if ((!isInitial && s.steps - firstStep >= budget.steps) ||
        SecondsSince(s.runStart) >= budget.seconds)
    {
      break;
    }
    if (!s.Advance())
    {
      end = RunEnd::Converged;
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
  if (s.transport.EmittedPower() == 0.0)
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
  return warnings;
}

ElementSolution Solver::Elements() const
{
  return ExtractElements(this->Impl->transport, this->Impl->facets);
}

std::vector<InteractionRecord> Solver::Interactions() const
{
  return ExtractInteractions(this->Impl->transport);
}

Image Solver::Render(const Camera& camera, const ElementImageSettings& settings) const
{
  const Implementation& s = *this->Impl;
  const ElementSolution solution = this->Elements();
  return RenderElements(
    s.occluders, s.transport.Tree(), solution.surface, solution.radiance, camera, settings);
}

Color Solver::ViewFluxOfRadiance() const
{
  return this->Impl->transport.ViewFluxOfRadiance();
}

Color Solver::ViewFluxOfImportance() const
{
  return this->Impl->transport.ViewFluxOfImportance();
}

std::size_t Solver::MemoryBytes() const
{
  return this->Impl->transport.Bytes();
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
