#pragma once

#include "core/math/Polygon.h"

#include <array>
#include <cstdint>
#include <vector>

/// \file FlatOccluder.h
/// The exact side of occlusion: what of a plane a facet covers.

namespace vantage
{

/// A flat convex triangle or quadrilateral as the planes that bound it.
struct FlatOccluder
{
  Plane plane;
  std::array<Plane, 4> edges; ///< perpendicular to the plane, pointing inwards; a triangle repeats
                              ///< its last one
  std::uint32_t facet;        ///< that it is, or is part of

  FlatOccluder(const Polygon& shape, std::uint32_t facet);

  /// Whether a point of the plane lies on the occluder or nearer to it than the tolerance: grown a
  /// little, neighbours overlap and no ray slips through between them.
  bool Covers(const Vec3& x, double tolerance) const;
};

/// Facets are flat to about single precision only. The parts returned (one or two) are flat to the
/// tolerance, so that they meet their neighbours at the edges they share.
std::vector<Polygon> FlatParts(const Polygon& facet, double tolerance);

} // namespace vantage
