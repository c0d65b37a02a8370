#pragma once

#include "core/math/Polygon.h"

#include <optional>

/// \file FacingPair.h
/// What two polygons see of each other, in coordinates fit for computing.

namespace vantage
{

/// Two polygons, each wholly in front of the other, in lengths of about 1 near the origin. The
/// one with the smaller radius is a.
struct FacingPair
{
  Polygon a, b;
  Vec3 normalA, normalB; ///< unit
  double areaA, areaB;   ///< of what is left of a and b
  Vec3 centreA, centreB; ///< centroids of what is left
  double radiusA, radiusB;
  Vec3 origin; ///< what became (0, 0, 0)
  double unit; ///< the length that became 1: throughputs scale with its square
};

/// Clips each polygon to the front half-space of the other. Nothing when they do not see each
/// other: one has no area, is behind the other, or lies in its plane. Two polygons that coincide
/// are the two sides of one wall, so they do not see each other however their normals point.
/// The same to the bit for (a, b) and (b, a).
/// \pre at most Polygon::Capacity - 1 vertices each
std::optional<FacingPair> Face(const Polygon& a, const Polygon& b);

/// Sets areas, centres and radii from the polygons. \return whether both have an area
bool Measure(FacingPair& pair);

} // namespace vantage
