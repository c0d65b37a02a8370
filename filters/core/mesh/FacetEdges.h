#pragma once

#include "core/mesh/Facets.h"

#include <algorithm>
#include <cstdint>
#include <vector>

/// \file FacetEdges.h
/// Which facets meet in which edge.

namespace vantage
{

/// An edge of a facet.
struct FacetEdge
{
  std::uint64_t edge; ///< a hash of its ends, the same for all facets that have it
  std::uint32_t facet;
  std::uint32_t corner; ///< where it starts, counter-clockwise seen from the front
};

/// Those of the same edge follow each other, in the order of the facets. Different edges are told
/// apart by 64 bits of hash. O(n).
std::vector<FacetEdge> EdgesOf(const std::vector<Facet>& facets);

/// Calls `action` with the first and the end of those that have the same edge, for each edge.
template <typename Action>
void ForEachEdge(const std::vector<FacetEdge>& edges, const Action& action)
{
  for (auto first = edges.begin(); first != edges.end();)
  {
    const auto last = std::find_if(
      first, edges.end(), [&](const FacetEdge& other) { return other.edge != first->edge; });
    action(first, last);
    first = last;
  }
}

} // namespace vantage
