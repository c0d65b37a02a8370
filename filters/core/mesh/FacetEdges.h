#pragma once

#include "core/mesh/Facets.h"

#include <algorithm>
#include <cstdint>
#include <functional>
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

/// Of `count` facets, of which `shapeOf` gives the shapes. Those of the same edge follow each
/// other, in the order of the facets. Different edges are told apart by 64 bits of hash. O(count).
std::vector<FacetEdge> EdgesOf(
  std::uint32_t count, const std::function<PolygonView(std::uint32_t)>& shapeOf);

inline std::vector<FacetEdge> EdgesOf(const std::vector<Facet>& facets)
{
  return EdgesOf(static_cast<std::uint32_t>(facets.size()),
    [&facets](std::uint32_t facet) -> PolygonView { return facets[facet].shape; });
}

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
