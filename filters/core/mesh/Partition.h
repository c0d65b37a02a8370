#pragma once

#include "core/mesh/Bounds.h"
#include "core/mesh/ElementTree.h"

#include <array>
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
  std::uint32_t surface; ///< one side of one flat surface (CutSurfaces.h)
  PatchId curved;        ///< the curved surface (CurvedSurfaces.h)
};

/// Items that follow each other, and the box of their keys.
struct ClusterRange
{
  ClusterItem* first;
  ClusterItem* last;
  Bounds box;

  std::ptrdiff_t Size() const { return this->last - this->first; }
};

Bounds BoxOf(const ClusterItem* first, const ClusterItem* last);

/// Reorders a range of two items or more into two parts of `least` items at least. Of the cuts at
/// the borders of a few bins along each axis, the one with the smallest sum of count times
/// diagonal, a measure of how far a cluster is from a point; the median along the longest axis
/// where there is no such cut. O(n).
std::array<ClusterRange, 2> Partition(const ClusterRange& range, std::ptrdiff_t least);

} // namespace vantage
