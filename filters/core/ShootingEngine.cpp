#include "core/ShootingEngine.h"

#include "core/transport/ExtractRadianceSolution.h"

#include <algorithm>

namespace vantage
{

namespace
{

std::string PhaseOf(const Step& step, bool isInitial)
{
  if (isInitial)
  {
    return "initial";
  }
  if (step.kind == Step::Kind::Gather)
  {
    return "gather";
  }
  return step.quantity == Quantity::Radiance ? "radiance" : "importance";
}

} // namespace

ShootingEngine::ShootingEngine(ElementTree tree, const OccluderScene& occluders,
  std::vector<PatchOptics> optics, double meanFacetArea, const ShootingSettings& settings)
  : Settings(settings)
  , State(std::move(tree), occluders, std::move(optics), meanFacetArea, settings.transport)
  , Order(MakeSchedule(settings.method, settings.granularity, this->State))
{
  this->CollectEmitters();
}

void ShootingEngine::SetView(std::vector<ViewSample> samples)
{
  this->State.SetView(std::move(samples));
  this->Order->RestartImportance();
}

void ShootingEngine::SetOptics(std::vector<PatchOptics> optics)
{
  this->State.SetOptics(std::move(optics));
  this->Order->RestartImportance();
  this->Order->RestartRadiance(this->State);
  this->CollectEmitters();
}

bool ShootingEngine::NeedsView() const
{
  return UsesImportance(this->Settings.method) && !this->State.HasView();
}

void ShootingEngine::Prepare(const std::function<bool()>& mayGoOn)
{
  // What the eye sees is expanded first, so that the reported flux never falls.
  while (mayGoOn() && this->State.ExpandNextVisible(static_cast<std::uint32_t>(this->StepCount)))
  {
  }
}

double ShootingEngine::ErrorEstimate() const
{
  return this->Order->Rest(this->State).relativeUnshot;
}

/// Emitters in the order of the initial phase: the strongest first.
void ShootingEngine::CollectEmitters()
{
  this->PendingEmitters.clear();
  if (!this->Settings.initialPhase || UsesImportance(this->Settings.method))
  {
    return;
  }
  const ElementTree& tree = this->State.Tree();
  const auto power = [&](PatchId p)
  { return tree[tree.Patches()[p].node].area * Mean(this->State.OpticsOf(p).emission); };
  for (PatchId p = 0; p < tree.Patches().size(); ++p)
  {
    if (tree.Patches()[p].IsActive() && power(p) > 0.0)
    {
      this->PendingEmitters.push_back(p);
    }
  }
  std::stable_sort(this->PendingEmitters.begin(), this->PendingEmitters.end(),
    [&](PatchId a, PatchId b) { return power(a) < power(b); });
}

std::optional<StepReport> ShootingEngine::Advance()
{
  Step step;
  const bool isInitial = !this->IsAtStep();
  if (isInitial)
  {
    step.patch = this->PendingEmitters.back();
    this->PendingEmitters.pop_back();
  }
  else
  {
    const auto next =
      this->Order->Next(this->State, static_cast<std::uint32_t>(this->StepCount + 1));
    if (!next)
    {
      return {};
    }
    step = *next;
    ++this->StepCount;
  }
  this->Order->Perform(this->State, step, static_cast<std::uint32_t>(this->StepCount));
  return this->Report(step, isInitial);
}

StepReport ShootingEngine::Report(const Step& step, bool isInitial) const
{
  const Residual rest = this->Order->Rest(this->State);
  const Color known = this->State.ViewFluxEstimate();
  StepReport report;
  report.step = this->StepCount;
  report.phase = PhaseOf(step, isInitial);
  report.patch = step.patch;
  report.viewFlux = Mean(known);
  report.unshotViewFlux = Mean(known - this->State.ViewFluxReceived());
  report.unshotPower = rest.unshotPower;
  report.errorEstimate = rest.relativeUnshot;
  report.elements = this->State.Tree().LeafElementCount();
  report.interactions = this->State.Graph().Size();
  report.work.surfacePairs = this->State.Counters().evaluations;
  report.work.pairRays = this->State.Counters().rays;
  return report;
}

ElementSolution ShootingEngine::Elements(
  const FacetSet& facets, ElementTree elements, ElementSurface surface) const
{
  return ExtractElements(this->State, facets, std::move(elements), std::move(surface));
}

std::vector<InteractionRecord> ShootingEngine::Interactions() const
{
  return ExtractInteractions(this->State);
}

RadianceSolution ShootingEngine::Radiance() const
{
  return ExtractRadianceSolution(this->State);
}

} // namespace vantage
