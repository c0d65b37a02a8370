#pragma once

#include "core/math/Polygon.h"

#include <vector>

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

/// The planes between b and an occluder that go through an edge of one and a vertex of the other,
/// with the occluder in front. From behind one of them the occluder hides nothing of b; from a
/// point in front of all of them it hides something, if it is not behind b.
std::vector<Plane> PenumbraSides(const Polygon& b, const Polygon& occluder, double tolerance);

/// The planes through an edge of one and a vertex of the other that have both b and the occluder in
/// front. From a point beyond the occluder and in front of all of them it hides all of b; from
/// behind one of them, some of b is seen past it.
std::vector<Plane> UmbraSides(const Polygon& b, const Polygon& occluder, double tolerance);

} // namespace vantage
