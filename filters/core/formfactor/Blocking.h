#pragma once

#include "core/math/Polygon.h"

/// \file Blocking.h
/// How an occluder stands between two polygons, without sampling.

namespace vantage
{

enum class Blocking
{
  None,    ///< no segment between the two polygons passes through the occluder
  Partial, ///< not known to be one of the others
  Full     ///< all segments do
};

/// The segments between two polygons meet the plane of an occluder within the convex hull of the
/// points where segments between their vertices do. None when that hull and the occluder are apart
/// (an edge of one of them has the other outside), Full when it is inside the occluder. Points
/// nearer than `tolerance` count as on a plane.
Blocking BlockingBetween(
  const Polygon& a, const Polygon& b, const Polygon& occluder, double tolerance);

/// Width, in the narrowest direction, of the area on the ground from which the occluder hides
/// something of b; infinite when that area is. What varies on the ground varies over such lengths.
/// \pre the occluder and b are in front of the ground
double PenumbraWidth(const Plane& ground, const Polygon& b, const Polygon& occluder);

} // namespace vantage
