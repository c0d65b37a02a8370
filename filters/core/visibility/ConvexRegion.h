#pragma once

#include "core/math/Polygon.h"

#include <array>
#include <optional>
#include <vector>

/// \file ConvexRegion.h
/// Convex pieces of space: boxes, and the shaft of all segments between two polygons, or a polygon
/// and some points (Haines, Wallace 1991).

namespace vantage
{

/// The points in front of all planes. Those planes lie close around the bounding box or inside it.
struct ConvexRegion
{
  static constexpr int Capacity = 12;

  std::array<Plane, Capacity> planes; ///< normals point inwards
  int planeCount = 0;
  Vec3 low{ 0.0 }; ///< bounding box
  Vec3 high{ 0.0 };

  /// \pre planeCount < Capacity
  void Add(const Plane& plane);
};

/// An axis-aligned box that includes its boundary: it is grown by twice the tolerance, so that
/// what touches it from outside reaches into it.
ConvexRegion BoxRegion(const Vec3& low, const Vec3& high, double tolerance);

/// A convex region that holds every segment between the two polygons: their convex hull, or a
/// little more where the hull has faces thinner than the tolerance. Lies in front of both.
/// Nothing when the polygons have too many corners or do not lie in front of each other.
/// \pre each polygon was clipped to the front of the other one. O(1).
std::optional<ConvexRegion> Shaft(const Polygon& a, const Polygon& b, double tolerance);

/// A convex region that holds every segment from the polygon to points in front of it: their hull,
/// but for the faces that do not touch the polygon, in place of which there is a plane parallel to
/// it. \pre the polygon has few enough corners, Capacity - 2. O(corners * points).
ConvexRegion ShaftTo(const Polygon& base, const std::vector<Vec3>& points, double tolerance);

/// Whether part of the polygon lies deeper than the tolerance inside the region. Exact.
bool ReachesInto(PolygonView polygon, const ConvexRegion& region, double tolerance);

} // namespace vantage
