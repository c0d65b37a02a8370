#pragma once

#include "core/mesh/ElementTree.h"

#include <cstddef>

/// \file Partition.h
/// Parts what is to go into one cluster from what is to go into another.

namespace vantage
{

/// A patch on its way into the clusters.
struct ClusterItem
{
  Vec3 key; ///< what it is sorted by
  PatchId patch;
  std::uint32_t surface; ///< one side of one surface (CutSurfaces.h)
};

/// Reorders a range of two items or more into two parts of `least` items at least; returns where
/// the second one starts. Of the cuts at the borders of a few bins along each axis, the one with
/// the smallest sum of count times diagonal, a measure of how far a cluster is from a point; the
/// median along the longest axis where there is no such cut. O(n).
ClusterItem* Partition(ClusterItem* first, ClusterItem* last, std::ptrdiff_t least);

} // namespace vantage
