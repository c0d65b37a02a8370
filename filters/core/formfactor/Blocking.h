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
/// points where segments between their vertices do. None when that hull is outside one edge of the
/// occluder, Full when it is inside all. Points nearer than `tolerance` count as on a plane.
Blocking BlockingBetween(
  const Polygon& a, const Polygon& b, const Polygon& occluder, double tolerance);

} // namespace vantage
