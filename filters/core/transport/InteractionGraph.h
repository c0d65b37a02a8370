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
  double throughput;  ///< G, m^2 sr, visibility included
  double visibility;  ///< visible fraction, in (0, 1]
  std::uint32_t step; ///< in which it was made
  /// What each end has shot over this interaction so far, in all: radiance, and importance
  /// Y = rho P.
  std::array<Color, 2> shotRadiance{ Color(0.0), Color(0.0) };
  std::array<Color, 2> shotImportance{ Color(0.0), Color(0.0) };
};

/// All interactions, in the order they were made, and for each patch those that one of its elements
/// takes part in.
class InteractionGraph
{
public:
  explicit InteractionGraph(std::size_t patchCount)
    : OfPatch(patchCount)
  {
  }

  void Add(const ElementTree& tree, const Interaction& interaction)
  {
    const InteractionId id = this->Size();
    this->All.push_back(interaction);
    for (const NodeId end : interaction.ends)
    {
      this->OfPatch[tree[end].patch].push_back(id);
    }
  }

  InteractionId Size() const { return static_cast<InteractionId>(this->All.size()); }
  Interaction& operator[](InteractionId id) { return this->All[id]; }
  const Interaction& operator[](InteractionId id) const { return this->All[id]; }

  /// Interactions of a patch, in the order they were made.
  const std::vector<InteractionId>& Of(PatchId patch) const { return this->OfPatch[patch]; }

  std::size_t Bytes() const
  {
    std::size_t bytes = this->All.capacity() * sizeof(Interaction);
    for (const std::vector<InteractionId>& ids : this->OfPatch)
    {
      bytes += sizeof(ids) + ids.capacity() * sizeof(InteractionId);
    }
    return bytes;
  }

private:
  std::vector<Interaction> All;
  std::vector<std::vector<InteractionId>> OfPatch;
};

/// The end of an interaction that lies on the patch. \pre one does
inline End EndOn(const ElementTree& tree, const Interaction& interaction, PatchId patch)
{
  return tree[interaction.ends[0]].patch == patch ? 0 : 1;
}

} // namespace vantage
