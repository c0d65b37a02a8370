#pragma once

#include "core/mesh/ElementTree.h"

#include <array>
#include <cstdint>
#include <vector>

/// \file InteractionGraph.h
/// Interactions between patches and elements, and who takes part in which.

namespace vantage
{

using InteractionId = std::uint32_t;

/// Which end of an interaction shoots: 0 or 1.
using End = int;

inline constexpr End Other(End end)
{
  return 1 - end;
}

/// Two elements that exchange light. One throughput serves both directions, so reciprocity holds
/// by construction.
struct Interaction
{
  std::array<NodeId, 2> ends;
  double throughput;          ///< G, m^2 sr, visibility included
  double visibility;          ///< visible fraction, in [0, 1]
  std::uint32_t agreeingRays; ///< rays that found the same, all free or all hidden, down the chain
                              ///< of ancestors to here; 0 where they disagreed
  std::uint32_t step;         ///< in which it was made
  /// What each end has shot over this interaction so far, total: radiance it sent and importance
  /// Y = rho P it sent.
  std::array<Color, 2> shotRadiance{ Color(0.0), Color(0.0) };
  std::array<Color, 2> shotImportance{ Color(0.0), Color(0.0) };
  bool isActive = true; ///< false once refined: its children carry what follows
};

/// All interactions, in the order they were made, and for each patch the active ones that one of
/// its elements takes part in.
class InteractionGraph
{
public:
  explicit InteractionGraph(std::size_t patchCount)
    : OfPatch(patchCount)
  {
  }

  InteractionId Add(const ElementTree& tree, const Interaction& interaction);

  /// Retires an interaction; its children have taken over.
  void Retire(InteractionId id);

  InteractionId Size() const { return static_cast<InteractionId>(this->All.size()); }
  std::size_t ActiveCount() const { return this->Active; }
  Interaction& operator[](InteractionId id) { return this->All[id]; }
  const Interaction& operator[](InteractionId id) const { return this->All[id]; }

  /// Active interactions of a patch, in the order they were made. The list stays valid until the
  /// next Add().
  const std::vector<InteractionId>& Of(PatchId patch);

  std::size_t Bytes() const;

private:
  struct PatchList
  {
    std::vector<InteractionId> ids;
    bool hasRetired = false;
  };

  std::vector<Interaction> All;
  std::vector<PatchList> OfPatch;
  std::vector<std::array<PatchId, 2>> PatchesOf;
  std::size_t Active = 0;
};

/// The end of an interaction that lies on the patch. \pre one does
inline End EndOn(const ElementTree& tree, const Interaction& interaction, PatchId patch)
{
  return tree[interaction.ends[0]].patch == patch ? 0 : 1;
}

} // namespace vantage
