#include "core/GoalOrientedEngine.h"

#include "core/goal/SolutionOfLinks.h"

#include <algorithm>
#include <limits>

namespace vantage
{

namespace
{

/// A round refines the worst links that together have this part of all errors. More makes fewer
/// rounds, and refines more links that need it less.
constexpr double RefinedShare = 0.45;
/// One estimate may be low by chance, as long as clusters are sampled by a few rays: the error is
/// the largest of so many in turn.
constexpr std::size_t EstimatesToTrust = 3;
/// An error that is estimated from fewer links is no estimate.
constexpr std::size_t LeastLinks = 256;

} // namespace

GoalOrientedEngine::GoalOrientedEngine(ElementTree tree, const OccluderScene& occluders,
  std::vector<PatchOptics> optics, double meanFacetArea, const GoalOrientedSettings& settings)
  : Settings(settings)
  , State(std::move(tree), occluders, std::move(optics), meanFacetArea, settings)
{
}

void GoalOrientedEngine::SetView(std::vector<ViewSample> samples)
{
  this->State.SetView(std::move(samples));
  this->HasView = true;
  this->IsSolved = false;
}

void GoalOrientedEngine::SetOptics(std::vector<PatchOptics> optics)
{
  this->State.SetOptics(std::move(optics));
  this->IsSolved = false;
}

double GoalOrientedEngine::ErrorEstimate() const
{
  if (!this->IsSolved)
  {
    return std::numeric_limits<double>::infinity();
  }
  double largest = this->State.ErrorEstimate();
  for (const double estimate : this->LastEstimates)
  {
    largest = std::max(largest, estimate);
  }
  return largest;
}

std::optional<StepReport> GoalOrientedEngine::Advance()
{
  if (this->IsSolved)
  {
    this->LastEstimates.insert(this->LastEstimates.begin(), this->State.ErrorEstimate());
    this->LastEstimates.resize(std::min(this->LastEstimates.size(), EstimatesToTrust - 1));
    if (this->State.Refine(RefinedShare) == 0)
    {
      return {};
    }
  }
  else
  {
    this->LastEstimates.clear();
  }
  this->State.Solve();
  while (this->State.LinkCount() < LeastLinks && this->State.Refine(RefinedShare) > 0)
  {
    this->State.Solve();
  }
  this->IsSolved = true;
  ++this->StepCount;
  return this->Report();
}

StepReport GoalOrientedEngine::Report() const
{
  const GoalOrientedCounters& counters = this->State.Counters();
  StepReport report;
  report.step = this->StepCount;
  report.phase = "refine";
  report.viewFlux = Mean(this->State.ViewFlux());
  report.errorEstimate = this->ErrorEstimate();
  report.elements = this->State.LeafCount();
  report.interactions = this->State.LinkCount();
  report.work.pairRays = counters.linkRays;
  report.work.probeRays = this->State.Tree().ProbeRays();
  report.work.surfacePairs = counters.surfacePairs;
  report.work.clusterPairs = counters.clusterPairs;
  report.work.refined = counters.refined;
  report.work.certified = counters.certified;
  report.work.hidden = counters.hidden;
  report.work.sweeps = counters.sweeps;
  return report;
}

double GoalOrientedEngine::EmittedPower() const
{
  return Pi * this->State.Tree()[0].area * Mean(this->State.Tree()[0].emission);
}

ElementSolution GoalOrientedEngine::Elements(
  const FacetSet& facets, ElementTree elements, ElementSurface surface) const
{
  return ExtractElements(this->State, facets, std::move(elements), std::move(surface));
}

std::vector<InteractionRecord> GoalOrientedEngine::Interactions() const
{
  return ExtractInteractions(this->State);
}

RadianceSolution GoalOrientedEngine::Radiance() const
{
  return SolutionOfLinks(this->State);
}

Color GoalOrientedEngine::ViewFluxOfRadiance() const
{
  return this->State.ViewFlux();
}

Color GoalOrientedEngine::ViewFluxOfImportance() const
{
  return this->State.ViewFluxOfImportance();
}

} // namespace vantage
