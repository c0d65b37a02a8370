#pragma once

#include "core/transport/Schedule.h"

#include <vector>

/// \file PatchSchedule.h
/// Methods whose step is one patch with all its interactions.

namespace vantage
{

/// Shooting patch by patch: basic (each in turn), progressive (largest unshot power first),
/// importance (importance and radiance in turn; radiance from the patch whose unshot part
/// contributes most to the view, sum over i of dL_k A_k F_ki I_ki = A_k dL_k (P_k - V_k)).
/// Choosing is O(patches).
class PatchSchedule : public Schedule
{
public:
  /// \pre method is one of the shooting methods
  PatchSchedule(Method method, const Transport& transport);

  std::optional<Step> Next(Transport& transport, std::uint32_t stepNumber) override;
  void Perform(Transport& transport, const Step& step, std::uint32_t stepNumber) override;
  Residual Rest(const Transport& transport) override;
  void RestartRadiance(const Transport& transport) override;
  void RestartImportance() override;

private:
  /// Patch means at the time of the last shot.
  struct Shot
  {
    Color radiance{ 0.0 };
    Color importance{ 0.0 }; ///< Y, reflected
  };

  Color UnshotRadiance(const Transport& transport, PatchId patch) const;
  Color UnshotImportance(const Transport& transport, PatchId patch) const;
  double RadianceRank(const Transport& transport, PatchId patch) const;
  double ImportanceRank(const Transport& transport, PatchId patch) const;
  PatchId NextInTurn(const Transport& transport);
  PatchId HighestRadiance(const Transport& transport) const;
  PatchId HighestImportance(const Transport& transport) const;

  Method TheMethod;
  std::vector<Shot> Shots;
  PatchId Cursor = 0;
  Quantity LastShot = Quantity::Radiance;
};

/// Gauss-Seidel: each patch in turn gathers over its interactions from what their other ends are
/// worth now (Goral et al. 1984; Hanrahan et al. 1991). On interactions that remember what they
/// have carried, gathering at a patch is shooting everything unshot that is directed to it.
class GatheringSchedule : public Schedule
{
public:
  explicit GatheringSchedule(const Transport& transport);

  std::optional<Step> Next(Transport& transport, std::uint32_t stepNumber) override;
  void Perform(Transport& transport, const Step& step, std::uint32_t stepNumber) override;
  /// Unshot power: the sum of the changes that the last gathering of each patch made, so that it
  /// is above the emitted power until the first sweep is over.
  Residual Rest(const Transport& transport) override;
  void RestartRadiance(const Transport& transport) override;
  void RestartImportance() override {}

private:
  std::vector<double> LastChange; ///< W, of each patch; all emitted power until it has gathered
  PatchId Cursor = 0;
};

} // namespace vantage
