#pragma once

#include "core/mesh/ElementTree.h"

#include <cstdint>
#include <vector>

/// \file PatchEdges.h
/// Which patch continues which across an edge.

namespace vantage
{

/// The edge of an active patch from one of its corners to the next.
struct PatchEdge
{
  PatchId patch;
  std::uint32_t corner;         ///< of the patch, where the edge starts
  std::uint32_t next;           ///< edge of the same patch, in the list of all edges
  std::uint32_t partner = None; ///< edge it is joined to; it runs in the opposite direction
};

/// All edges of the active patches, patch by patch, with those joined that bound the same air. In
/// the order of their angle around an edge, the upper side of each facet bounds the same wedge as
/// the lower side of the next. So a wall between two rooms takes part in both without tying them
/// together, and at a free edge the two sides of one facet are joined. An edge has no partner where
/// the other side of its wedge is not active. O(n log n).
std::vector<PatchEdge> PairEdges(const ElementTree& tree, const FacetSet& facets);

} // namespace vantage
