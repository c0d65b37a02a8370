#pragma once

#include "core/Engine.h"
#include "core/goal/GoalOrientedTransport.h"

/// \file GoalOrientedEngine.h
/// Only the interactions that the view needs: a step is a round of refinement.

namespace vantage
{

class GoalOrientedEngine : public Engine
{
public:
  /// `occluders` must outlive this.
  GoalOrientedEngine(ElementTree tree, const OccluderScene& occluders,
    std::vector<PatchOptics> optics, double meanFacetArea, const GoalOrientedSettings& settings);

  void SetView(std::vector<ViewSample> samples) override;
  void SetOptics(std::vector<PatchOptics> optics) override;
  bool NeedsView() const override { return !this->HasView && this->Settings.importance; }
  void Prepare(const std::function<bool()>&) override {}
  bool IsAtStep() const override { return true; }
  double ErrorEstimate() const override;
  std::optional<StepReport> Advance() override;
  std::uint64_t Steps() const override { return this->StepCount; }

  const ElementTree& Tree() const override { return this->State.Tree().Tree(); }
  double EmittedPower() const override;
  ElementSolution Elements(
    const FacetSet& facets, ElementTree elements, ElementSurface surface) const override;
  std::vector<InteractionRecord> Interactions() const override;
  RadianceSolution Radiance() const override;
  Color ViewFluxOfRadiance() const override;
  Color ViewFluxOfImportance() const override;
  std::size_t Bytes() const override { return this->State.Bytes(); }

private:
  StepReport Report() const;

  GoalOrientedSettings Settings;
  GoalOrientedTransport State;
  bool HasView = false;
  bool IsSolved = false;
  std::vector<double> LastEstimates; ///< of the rounds before, the latest first
  std::uint64_t StepCount = 0;
};

} // namespace vantage
