#pragma once

#include "core/mesh/ElementTree.h"

#include <vector>

/// \file Clusters.h
/// The upper part of the element tree: binary clusters over patches.

namespace vantage
{

/// The shape of a patch, counter-clockwise seen from its side.
inline TriangleOrQuadrilateral ShapeOfPatch(const FacetSet& facets, PatchId id)
{
  const TriangleOrQuadrilateral& shape = facets.facets[id / 2].shape;
  return id % 2 == 0 ? shape : Reversed(shape);
}

/// Clusters over the active patches, with one of these at each leaf; a parent comes before its
/// children. They are split by centroid and by normal: a patch is sorted by a point of the air in
/// front of it, so that the two sides of a wall part early and the walls of a room stay together.
/// Where few surfaces are left that were cut into many patches each, the surfaces part first:
/// curved ones, and within these flat ones. What was one polygon before it was cut becomes a flat
/// cluster. O(n log n). \pre there is an active patch
std::vector<Node> MakeClusters(
  const FacetSet& facets, const std::vector<Patch>& patches, const std::vector<bool>& isActive);

} // namespace vantage
