#pragma once

#include "core/transport/Schedule.h"

#include <vector>

/// \file ImportanceGathering.h
/// Gathering where it matters to the view.

namespace vantage
{

/// Radiance is gathered, importance is shot, over the same interactions (Smits, Arvo, Salesin: An
/// importance-driven radiosity algorithm, SIGGRAPH 1992): a patch that gathers over a link what its
/// other end is worth sends back over it how much that matters. The two take turns. Importance is
/// shot by the patch with most of it unshot; radiance is gathered by the patch i whose gathering
/// changes the view most, by W_i Y_i, with
///
///     W_i = sum over its links of F_ki A_k dL_k      what is there for it to gather, W,
///
/// and Y_i what it reflects of its importance: Southwell's relaxation, weighted by the view.
///
/// Smits et al. also refine by importance, radiance and error of the form factor, in rounds of
/// falling tolerance. That is left out here on purpose. Interactions refined for a view are other
/// ones for each view and method, and what a comparison of methods then compares is meshes: they
/// would not converge to one solution, and a camera move could not keep them. On the graph of the
/// other methods importance decides which interactions are made, as a patch has none before it
/// shoots importance, gathers, or emits towards one that gathers. Refinement by importance is what
/// goal-oriented does, from the root link down and with an estimate of the error.
///
/// A step costs the interactions of one patch; choosing it is O(patches).
class ImportanceGathering : public Schedule
{
public:
  explicit ImportanceGathering(const Transport& transport);

  std::optional<Step> Next(Transport& transport, std::uint32_t stepNumber) override;
  void Perform(Transport& transport, const Step& step, std::uint32_t stepNumber) override;
  /// Unshot power: all that is there to be gathered, and what emitters without interactions emit.
  Residual Rest(const Transport& transport) override;
  void RestartRadiance(const Transport& transport) override;
  void RestartImportance() override;

private:
  void CountNewInteractions(const Transport& transport);
  void ExpandSenders(Transport& transport, PatchId receiver, std::uint32_t stepNumber);
  void Gather(Transport& transport, PatchId patch);
  void ShootImportance(Transport& transport, PatchId patch);
  Color& UngatheredAt(const Transport& transport, NodeId node);
  double GatherRank(const Transport& transport, PatchId patch) const;
  double ShootRank(const Transport& transport, PatchId patch) const;

  std::vector<Color> Ungathered;     ///< W of each patch, of the interactions counted
  std::vector<Color> ShotImportance; ///< Y of each patch at its last shot, mean
  InteractionId Counted = 0;         ///< the interactions before this one
  Quantity LastMoved = Quantity::Radiance;
};

} // namespace vantage
