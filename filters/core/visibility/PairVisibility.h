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
  double fraction = 1.0;   ///< of the segments between their front sides that are free, in [0, 1]
  std::uint32_t rays = 0;  ///< shadow rays that were traced
  std::uint32_t lines = 0; ///< along which these went: that of the centres, and one for each other
  bool isCertain = false;  ///< proved: nothing in between, or one convex facet hides everything
};

/// One end: a convex polygon that lies on a facet, seen from its front.
struct VisibilityEnd
{
  Polygon shape; ///< three or four corners
  std::uint32_t facet;
};

/// Certain where a proof is cheap: 1 when no facet reaches into the convex hull of the two
/// polygons, 0 when one of the first facets between their centres cuts all segments between their
/// corners (both exact for convex polygons, up to the tolerance of the occluders), and 0 as well
/// when the polygons do not face each other. Only what lies in front of the other end takes part.
///
/// Else `rays` (1 .. 4096) stratified segments in one stage, those that leave or arrive at a back
/// side not counted. The segments are points of a scrambled Sobol sequence in the four coordinates
/// of the two ends: n rays, a power of two, resolve the n-th part of each side of both ends, as
/// edges of shadows tend to be parallel to sides. Two seeds give independent estimates. The rays
/// that try the proofs take no part in the estimate, which would otherwise be biased.
///
/// The ends are put in order first: swapping a and b changes nothing, to the bit.
/// Complexity: O((proof + rays) log n), the proof being worth about as much as a few rays.
PairVisibility EstimateVisibility(const OccluderScene& occluders, const VisibilityEnd& a,
  const VisibilityEnd& b, std::uint32_t rays, std::uint64_t seed);

} // namespace vantage
