#pragma once

#include "core/math/Polygon.h"

#include <vector>

/// \file SlowThroughput.h
/// Throughput the slow and obvious way, for checking: nothing here is shared with the library but
/// the type of a polygon.

namespace vantage
{

/// Adaptive cubature over a of the cosine-weighted solid angle of b, in extended precision.
/// \param tolerance by how much halving an interval may change the integral over it; the error that
/// is left is far smaller
double SlowThroughput(const Polygon& a, const Polygon& b, double tolerance);

/// Midpoint rule with cells x cells points on each (convex) quadrilateral and a ray for each pair.
double SlowVisibleThroughput(
  const Polygon& a, const Polygon& b, const std::vector<Polygon>& occluders, int cells);

} // namespace vantage
