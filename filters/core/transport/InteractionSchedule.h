#pragma once

#include "core/transport/Schedule.h"

#include <vector>

/// \file InteractionSchedule.h
/// Methods whose step is one interaction, as the algorithms of the paper are written.

namespace vantage
{

/// Shooting interaction by interaction: basic (all of each patch in turn), progressive (largest
/// dL A F), importance (importance and radiance in turn; radiance by the largest dL A F I,
/// equation 8, importance by the largest dY A F). A patch whose interactions do not exist yet
/// competes with all that it could shoot; when it wins, its interactions are made. Choosing costs
/// O(patches) and the interactions of the patches that the last step has changed.
class InteractionSchedule : public Schedule
{
public:
  /// \pre method is one of the shooting methods
  InteractionSchedule(Method method, const Transport& transport);

  std::optional<Step> Next(Transport& transport, std::uint32_t stepNumber) override;
  void Perform(Transport& transport, const Step& step, std::uint32_t stepNumber) override;
  Residual Rest(const Transport& transport) override;
  void RestartRadiance(const Transport& transport) override;
  void RestartImportance() override;

private:
  /// The best thing a patch could shoot next.
  struct Candidate
  {
    double rank = 0.0;
    InteractionId interaction = None; ///< None: its interactions are still to be made
  };

  /// What is known of a patch until something near it changes.
  struct PatchState
  {
    bool isStale = true;
    Candidate radiance;
    Candidate importance;
    ViewResidual rest; ///< sums over its interactions: of dL G, of dL G Y, and of dY G
  };

  std::optional<Step> NextInTurn(Transport& transport, std::uint32_t stepNumber);
  std::optional<Step> HighestRanked(
    Transport& transport, Quantity quantity, std::uint32_t stepNumber);
  void Refresh(const Transport& transport);
  PatchState Assess(const Transport& transport, PatchId patch) const;
  PatchState AssessUnexpanded(const Transport& transport, PatchId patch) const;
  void MarkStale(Transport& transport, PatchId patch, bool withNeighbours);
  void MarkAllStale();

  Method TheMethod;
  std::vector<PatchState> States;
  Quantity LastShot = Quantity::Radiance;
  PatchId Cursor = 0;              ///< in turn: the patch
  std::vector<InteractionId> Turn; ///< in turn: its interactions that are still to come
};

} // namespace vantage
