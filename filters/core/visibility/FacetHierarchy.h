#pragma once

#include "core/math/Box.h"
#include "core/mesh/Facets.h"
#include "core/visibility/ConvexRegion.h"

#include <cstdint>
#include <vector>

/// \file FacetHierarchy.h
/// Which facets reach into a piece of space.

namespace vantage
{

/// A binary tree of bounding boxes over facets, in double precision. Embree answers rays only; the
/// proofs of PairVisibility ask about volumes, and there whole branches can be cut off at the
/// planes of a shaft.
class FacetHierarchy
{
public:
  /// Median splits along the longest axis, O(n log n). Keeps a reference to the facets.
  FacetHierarchy(const FacetShapes& facets, double tolerance);

  /// Facets that reach deeper than the tolerance into the region, in ascending order.
  std::vector<std::uint32_t> FacetsIn(const ConvexRegion& region) const;

  /// True when it was proved, with no more than `effort` boxes and facets looked at, that no facet
  /// reaches into the region.
  bool IsProvablyEmpty(const ConvexRegion& region, int effort) const;

private:
  struct Box
  {
    Vec3 low, high;
    std::uint32_t first; ///< a leaf's first entry in Order, or the first of two child boxes
    std::uint32_t count; ///< facets of a leaf; 0 for an inner box
  };

  /// A facet on its way into the tree.
  struct Item
  {
    vantage::Box box;
    std::uint32_t facet;
  };

  void Build(Item* items, std::uint32_t box, std::uint32_t first, std::uint32_t last);
  bool Reaches(const Box& box, const ConvexRegion& region) const;

  /// Calls visit(facet) for facets that reach into the region and step() for all that is looked
  /// at, until one of them returns false. Returns whether all was looked at.
  template <typename Step, typename Visit>
  bool ForEachIn(const ConvexRegion& region, const Step& step, const Visit& visit) const;

  const FacetShapes* Facets;
  double Tolerance;
  std::vector<Box> Boxes;
  std::vector<std::uint32_t> Order;
};

} // namespace vantage
