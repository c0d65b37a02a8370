#pragma once

#include "core/transport/RadianceSolution.h"
#include "core/view/ViewGather.h"

#include <memory>

/// \file SolutionSnapshot.h
/// A solution that can be looked at from anywhere, whatever becomes of the solver.

namespace vantage
{

/// The light on all surfaces as a solver had it at one moment, and the geometry that is needed to
/// look at it. It never changes: share it freely, between threads too.
class SolutionSnapshot
{
public:
  SolutionSnapshot(std::shared_ptr<const OccluderScene> occluders, RadianceSolution radiance)
    : Occluders(std::move(occluders))
    , Radiance(std::move(radiance))
  {
  }

  /// The picture of a camera, gathered at its pixels: lamps are integrated there, and what other
  /// surfaces reflect is looked up one reflection away. A goal-oriented solution is fine only where
  /// the camera it was solved for looks. The report's error estimate is that of the gather alone.
  /// \throw InputError for a bad camera or bad settings.
  GatheredView Gather(
    const Camera& camera, const GatherSettings& settings, const GatherObserver& observer = {}) const
  {
    return GatherView(*this->Occluders, this->Radiance, camera, settings, observer);
  }

  /// Bytes held by the radiance; the geometry is shared with the solver.
  std::size_t Bytes() const { return this->Radiance.Bytes(); }

private:
  std::shared_ptr<const OccluderScene> Occluders;
  RadianceSolution Radiance;
};

} // namespace vantage
