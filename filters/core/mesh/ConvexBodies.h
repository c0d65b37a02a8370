#pragma once

#include "core/mesh/DarkSides.h"
#include "core/mesh/PackedLists.h"

#include <cstdint>
#include <vector>

/// \file ConvexBodies.h
/// Closed bodies that cast their shadows as one.

namespace vantage
{

/// Of the closed bodies (DarkSides.h) those that are convex: boxes, columns, globes, tops of
/// tables, however finely a modeller has cut them.
class ConvexBodies
{
public:
  /// Between two sides: it starts at a corner of a facet of the first one, which is seen from
  /// outside, and runs counter-clockwise around that.
  struct Edge
  {
    std::uint32_t first, second; ///< sides
    std::uint32_t facet;         ///< its place in FacetsOf()
    std::uint32_t corner;
  };
  template <typename Entry>
  using List = typename PackedLists<Entry>::List;

  ConvexBodies() = default;
  /// Corners may stand out by `LargestDent`, and facets that are no more out of one plane are one
  /// side. Bodies have 2048 facets at most.
  /// O(facets), and for each body its facets times its corners, until one stands out.
  ConvexBodies(const FacetSet& facets, const DarkSides& dark);

  /// Over the distance from the middle of a facet, how far corners may stand out in front of its
  /// plane: what single precision leaves of a plane.
  static constexpr double LargestDent = 1e-5;

  /// Whether a body of DarkSides is one of them.
  bool Has(std::uint32_t body) const { return this->FacetsOf(body).size() > 0; }
  /// Its facets as seen from outside, none when it is not convex.
  List<PatchId> FacetsOf(std::uint32_t body) const
  {
    return ListOf(this->Facets, this->FirstFacet, body);
  }
  /// Of each side a facet in its plane, by place in FacetsOf().
  List<std::uint32_t> SidesOf(std::uint32_t body) const
  {
    return ListOf(this->Sides, this->FirstSide, body);
  }
  List<Edge> EdgesOf(std::uint32_t body) const
  {
    return ListOf(this->Edges, this->FirstEdge, body);
  }

private:
  template <typename Entry>
  static List<Entry> ListOf(
    const std::vector<Entry>& entries, const std::vector<std::uint32_t>& starts, std::uint32_t body)
  {
    return { entries.data() + starts[body], entries.data() + starts[body + 1] };
  }
  void Add(const FacetSet& set, const std::vector<PatchId>& facets);

  std::vector<PatchId> Facets;
  std::vector<std::uint32_t> Sides;
  std::vector<Edge> Edges;
  std::vector<std::uint32_t> FirstFacet{ 0 }; ///< of each body, and the end
  std::vector<std::uint32_t> FirstSide{ 0 };
  std::vector<std::uint32_t> FirstEdge{ 0 };
};

} // namespace vantage
