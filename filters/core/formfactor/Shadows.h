#pragma once

#include "core/math/Polygon.h"

#include <vector>

/// \file Shadows.h
/// Which part of a polygon can be seen past convex occluders.

namespace vantage
{

/// Integral of the cosine over the solid angle of the part of `p` that a point x with unit normal n
/// sees past the occluders, in sr. The shadow of an occluder is a convex cone with its apex at x,
/// so what is left of a convex polygon is a few convex pieces, each in closed form.
/// \pre `p` and the occluders are in front of x, x and the occluders are in front of p, lengths are
/// about 1, and no occluder has more than MaxOccluderVertices vertices.
double PointToVisiblePolygon(
  const Vec3& x, const Vec3& n, const Polygon& p, const std::vector<Polygon>& occluders);

/// Clipping a triangle to a cone with one side more than that must still fit a Polygon.
inline constexpr int MaxOccluderVertices = Polygon::Capacity - 4;

} // namespace vantage
