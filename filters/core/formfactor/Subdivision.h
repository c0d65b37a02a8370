#pragma once

#include "core/math/Polygon.h"

#include <array>

/// \file Subdivision.h
/// Cutting convex polygons into smaller ones that keep their orientation.

namespace vantage
{

/// The two parts on either side of a diagonal. \pre at least four vertices
std::array<Polygon, 2> InHalves(const Polygon& p);

/// The two parts on either side of the plane through the centre, across the direction in which the
/// polygon is longest. \pre at most Polygon::Capacity - 1 vertices
std::array<Polygon, 2> AcrossTheMiddle(const Polygon& p);

/// Four parts of half the size. \pre three or four vertices
std::array<Polygon, 4> InFour(const Polygon& p);

} // namespace vantage
