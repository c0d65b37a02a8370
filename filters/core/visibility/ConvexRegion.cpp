#include "core/visibility/ConvexRegion.h"

#include <algorithm>
#include <limits>

namespace vantage
{

namespace
{

/// A hull of polygons with this many corners has at most as many faces as a region has planes:
/// one for each edge and the two polygons themselves.
constexpr int MaximumCorners = (ConvexRegion::Capacity - 2) / 2;

bool IsInFront(const Polygon& p, const Plane& plane, double tolerance)
{
  return std::all_of(
    p.begin(), p.end(), [&](const Vec3& v) { return plane.Distance(v) >= -tolerance; });
}

/// Smallest and largest signed distance of a polygon from a plane.
struct Range
{
  double nearest, furthest;
};

Range RangeAlong(PolygonView p, const Plane& plane)
{
  constexpr double Infinity = std::numeric_limits<double>::infinity();
  Range range{ Infinity, -Infinity };
  for (const Vec3& v : p)
  {
    const double distance = plane.Distance(v);
    range.nearest = std::min(range.nearest, distance);
    range.furthest = std::max(range.furthest, distance);
  }
  return range;
}

/// The plane through an edge and a point, turned so that `inside` lies in front. Nothing when they
/// are too close to one line to have a plane.
std::optional<Plane> PlaneThrough(
  const Vec3& from, const Vec3& to, const Vec3& point, const Vec3& inside, double tolerance)
{
  const Vec3 normal = glm::cross(to - from, point - from);
  const double length = glm::length(normal);
  const double reach = std::max(glm::length(to - from), glm::length(point - from));
  if (!(length > tolerance * reach))
  {
    return std::nullopt;
  }
  Plane plane;
  plane.normal = normal / length;
  plane.offset = glm::dot(plane.normal, from);
  if (plane.Distance(inside) < 0.0)
  {
    plane.normal = -plane.normal;
    plane.offset = -plane.offset;
  }
  return plane;
}

/// Adds the face of the hull that leaves edge from-to of a towards a corner of b. An edge that
/// already lies in a face (parallel edges share one) needs no other.
void AddFaceAtEdge(ConvexRegion& shaft, const Vec3& from, const Vec3& to, const Polygon& a,
  const Polygon& b, const Vec3& middle, double tolerance)
{
  for (int k = 2; k < shaft.planeCount; ++k)
  {
    const Plane& known = shaft.planes[k];
    if (std::abs(known.Distance(from)) <= tolerance && std::abs(known.Distance(to)) <= tolerance)
    {
      return;
    }
  }
  for (const Vec3& corner : b)
  {
    const auto plane = PlaneThrough(from, to, corner, middle, tolerance);
    if (plane && IsInFront(a, *plane, tolerance) && IsInFront(b, *plane, tolerance))
    {
      shaft.Add(*plane);
      return;
    }
  }
}

} // namespace

void ConvexRegion::Add(const Plane& plane)
{
  assert(this->planeCount < Capacity);
  this->planes[this->planeCount++] = plane;
}

ConvexRegion BoxRegion(const Vec3& low, const Vec3& high, double tolerance)
{
  ConvexRegion box;
  box.low = low - 2.0 * tolerance;
  box.high = high + 2.0 * tolerance;
  for (int axis = 0; axis < 3; ++axis)
  {
    Vec3 normal(0.0);
    normal[axis] = 1.0;
    box.Add({ normal, box.low[axis] });
    box.Add({ -normal, -box.high[axis] });
  }
  return box;
}

std::optional<ConvexRegion> Shaft(const Polygon& a, const Polygon& b, double tolerance)
{
  const Plane planeA = SupportingPlane(a);
  const Plane planeB = SupportingPlane(b);
  if (a.Size() > MaximumCorners || b.Size() > MaximumCorners ||
      !IsInFront(b, planeA, 2.0 * tolerance) || !IsInFront(a, planeB, 2.0 * tolerance))
  {
    return std::nullopt;
  }
  ConvexRegion shaft;
  shaft.low = shaft.high = a[0];
  for (const Polygon* p : { &a, &b })
  {
    for (const Vec3& v : *p)
    {
      shaft.low = glm::min(shaft.low, v);
      shaft.high = glm::max(shaft.high, v);
    }
  }
  shaft.Add(planeA);
  shaft.Add(planeB);
  const Vec3 middle = 0.5 * (Centroid(a) + Centroid(b));
  for (int i = 0; i < a.Size(); ++i)
  {
    AddFaceAtEdge(shaft, a[i], a[(i + 1) % a.Size()], a, b, middle, tolerance);
  }
  for (int i = 0; i < b.Size(); ++i)
  {
    AddFaceAtEdge(shaft, b[i], b[(i + 1) % b.Size()], b, a, middle, tolerance);
  }
  return shaft;
}

ConvexRegion ShaftTo(const Polygon& base, const std::vector<Vec3>& points, double tolerance)
{
  ConvexRegion shaft;
  shaft.low = shaft.high = base[0];
  const Plane ground = SupportingPlane(base);
  double highest = 0.0;
  for (const Vec3& v : base)
  {
    shaft.low = glm::min(shaft.low, v);
    shaft.high = glm::max(shaft.high, v);
  }
  for (const Vec3& v : points)
  {
    shaft.low = glm::min(shaft.low, v);
    shaft.high = glm::max(shaft.high, v);
    highest = std::max(highest, ground.Distance(v));
  }
  shaft.Add(ground);
  shaft.Add({ -ground.normal, -(ground.offset + highest) });
  for (int i = 0; i < base.Size(); ++i)
  {
    // The plane through the edge that is turned outwards until it has all points inside.
    const Vec3& from = base[i];
    const Vec3 along = base[(i + 1) % base.Size()] - from;
    const double length = glm::length(along);
    if (!(length > tolerance))
    {
      continue;
    }
    const Vec3 inward = glm::cross(ground.normal, along / length);
    Vec2 outermost(1.0, 0.0); // the direction of the plane from the edge: inwards, upwards
    for (const Vec3& v : points)
    {
      const Vec2 way(glm::dot(v - from, inward), std::max(ground.Distance(v), 0.0));
      if (way.y * outermost.x - way.x * outermost.y > 0.0)
      {
        outermost = way;
      }
    }
    const Vec2 direction = glm::normalize(outermost);
    const Vec3 normal = direction.y * inward - direction.x * ground.normal;
    shaft.Add({ normal, glm::dot(normal, from) });
  }
  return shaft;
}

bool ReachesInto(PolygonView polygon, const ConvexRegion& region, double tolerance)
{
  // Most polygons lie behind one of the planes, and most planes cut off nothing of the others.
  for (int k = 0; k < region.planeCount; ++k)
  {
    if (RangeAlong(polygon, region.planes[k]).furthest <= tolerance)
    {
      return false;
    }
  }
  Polygon rest(polygon);
  for (int k = 0; k < region.planeCount && !rest.Empty(); ++k)
  {
    const Range range = RangeAlong(rest, region.planes[k]);
    if (range.nearest < -tolerance || range.furthest <= tolerance)
    {
      rest = ClipToFront(rest, region.planes[k], tolerance);
    }
  }
  return !rest.Empty();
}

} // namespace vantage
