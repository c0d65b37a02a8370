#pragma once

#include "core/Solution.h"
#include "core/StepReport.h"
#include "core/transport/PatchOptics.h"
#include "core/transport/RadianceSolution.h"
#include "core/transport/ViewWeights.h"

#include <functional>
#include <optional>
#include <vector>

/// \file Engine.h
/// One way to solve: what Solver drives.

namespace vantage
{

class Engine
{
public:
  virtual ~Engine() = default;

  /// Another view: importance starts anew.
  virtual void SetView(std::vector<ViewSample> samples) = 0;
  /// Other materials: radiance and importance start anew, interactions stay.
  virtual void SetOptics(std::vector<PatchOptics> optics) = 0;

  virtual bool NeedsView() const = 0;
  /// What has to be done before the first step of a run, as long as `mayGoOn`.
  virtual void Prepare(const std::function<bool()>& mayGoOn) = 0;
  /// Whether the next move is a step, and not part of the initial phase.
  virtual bool IsAtStep() const = 0;
  /// StepReport::errorEstimate as of now; infinite before it can be told.
  virtual double ErrorEstimate() const = 0;
  /// One move, with all of its report but the view rays and the seconds; nothing when nothing is
  /// left to do.
  virtual std::optional<StepReport> Advance() = 0;
  virtual std::uint64_t Steps() const = 0;

  virtual const ElementTree& Tree() const = 0;
  virtual double EmittedPower() const = 0;
  /// What is known of the leaves of a copy of Tree(), which may be split further, and which
  /// `surface` shows.
  virtual ElementSolution Elements(
    const FacetSet& facets, ElementTree elements, ElementSurface surface) const = 0;
  virtual std::vector<InteractionRecord> Interactions() const = 0;
  virtual RadianceSolution Radiance() const = 0;
  virtual Color ViewFluxOfRadiance() const = 0;
  virtual Color ViewFluxOfImportance() const = 0;
  virtual std::size_t Bytes() const = 0;
};

} // namespace vantage
