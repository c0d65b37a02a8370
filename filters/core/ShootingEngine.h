#pragma once

#include "core/Engine.h"
#include "core/transport/Schedule.h"

#include <memory>

/// \file ShootingEngine.h
/// The methods of the paper: interactions that depend on the scene only, in an order that depends
/// on the method.

namespace vantage
{

struct ShootingSettings
{
  Method method;
  Granularity granularity;
  TransportSettings transport;
  bool initialPhase; ///< direct light of all emitters first
};

class ShootingEngine : public Engine
{
public:
  /// `occluders` must outlive this.
  ShootingEngine(ElementTree tree, const OccluderScene& occluders, std::vector<PatchOptics> optics,
    double meanFacetArea, const ShootingSettings& settings);

  void SetView(std::vector<ViewSample> samples) override;
  void SetOptics(std::vector<PatchOptics> optics) override;
  bool NeedsView() const override;
  void Prepare(const std::function<bool()>& mayGoOn) override;
  bool IsAtStep() const override { return this->PendingEmitters.empty(); }
  double ErrorEstimate() const override;
  std::optional<StepReport> Advance() override;
  std::uint64_t Steps() const override { return this->StepCount; }

  const ElementTree& Tree() const override { return this->State.Tree(); }
  double EmittedPower() const override { return this->State.EmittedPower(); }
  ElementSolution Elements(
    const FacetSet& facets, ElementTree elements, ElementSurface surface) const override;
  std::vector<InteractionRecord> Interactions() const override;
  RadianceSolution Radiance() const override;
  Color ViewFluxOfRadiance() const override { return this->State.ViewFluxOfRadiance(); }
  Color ViewFluxOfImportance() const override { return this->State.ViewFluxOfImportance(); }
  std::size_t Bytes() const override { return this->State.Bytes(); }

private:
  void CollectEmitters();
  StepReport Report(const Step& step, bool isInitial) const;

  ShootingSettings Settings;
  Transport State;
  std::unique_ptr<Schedule> Order;
  std::vector<PatchId> PendingEmitters; ///< of the initial phase; the next one is at the back
  std::uint64_t StepCount = 0;
};

} // namespace vantage
