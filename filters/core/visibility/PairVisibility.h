#pragma once

#include "core/visibility/OccluderScene.h"

#include <cstdint>

/// \file PairVisibility.h
/// How much of one polygon another one sees.

namespace vantage
{

/// Result of a visibility estimate between two polygons.
struct PairVisibility
{
  double fraction = 1.0;  ///< of the segments between them that are free, in [0, 1]
  std::uint32_t rays = 0; ///< shadow rays that were traced
  bool isCertain = false; ///< proved: nothing in between, or one convex facet hides everything
};

/// One end: a convex polygon that lies on a facet.
struct VisibilityEnd
{
  Polygon shape; ///< three or four corners
  std::uint32_t facet;
};

/// Certain where a proof is cheap: 1 when no facet reaches into the convex hull of the two
/// polygons, 0 when one single facet cuts all segments between their corners (both proofs are exact
/// for convex polygons). Else `rays` stratified segments in one stage. The pattern is a fixed
/// low-discrepancy set that is shifted by `shift` and symmetric in the two ends, so that the
/// result does not depend on which of them is called a (up to round-off). Two different `shift`s
/// give independent estimates. Complexity: O(rays log n).
PairVisibility EstimateVisibility(const OccluderScene& occluders, const VisibilityEnd& a,
  const VisibilityEnd& b, std::uint32_t rays, std::uint64_t shift);

} // namespace vantage
