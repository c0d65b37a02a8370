#include "core/formfactor/Blocking.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

namespace vantage
{
namespace
{

/// Vertices of the two polygons on one side of a plane.
struct OneSide
{
  std::array<Vec3, 2 * Polygon::Capacity> points;
  std::array<double, 2 * Polygon::Capacity> heights; ///< above the plane, >= 0
  int count = 0;
  bool ofA = false; ///< some are vertices of a
  bool ofB = false;

  void Add(const Vec3& point, double height, bool isOfA)
  {
    this->points[this->count] = point;
    this->heights[this->count++] = height;
    this->ofA = this->ofA || isOfA;
    this->ofB = this->ofB || !isOfA;
  }
  double Highest() const
  {
    return this->count > 0
             ? *std::max_element(this->heights.begin(), this->heights.begin() + this->count)
             : 0.0;
  }
};

struct Range
{
  double least = std::numeric_limits<double>::infinity();
  double most = -std::numeric_limits<double>::infinity();
};

/// Where the hull of all vertices meets the plane of the occluder: the range of distances inside
/// one of its edges.
Range RangeInside(const Plane& edge, const OneSide& above, const OneSide& below)
{
  Range range;
  for (int i = 0; i < above.count; ++i)
  {
    const double di = edge.Distance(above.points[i]);
    for (int j = 0; j < below.count; ++j)
    {
      const double dj = edge.Distance(below.points[j]);
      const double height = above.heights[i] + below.heights[j];
      const double d =
        height > 0.0 ? (di * below.heights[j] + dj * above.heights[i]) / height : 0.5 * (di + dj);
      range.least = std::min(range.least, d);
      range.most = std::max(range.most, d);
    }
  }
  return range;
}

Range RangeOf(const Plane& plane, const Polygon& p)
{
  Range range;
  for (const Vec3& v : p)
  {
    const double d = plane.Distance(v);
    range.least = std::min(range.least, d);
    range.most = std::max(range.most, d);
  }
  return range;
}

/// The plane through edge i of p and a point, which may be on either side of p.
std::optional<Plane> ThroughEdge(const Polygon& p, int i, const Vec3& point)
{
  const Vec3 normal = glm::cross(p[(i + 1) % p.Size()] - p[i], point - p[i]);
  const double length = glm::length(normal);
  if (length == 0.0)
  {
    return std::nullopt;
  }
  return Plane{ normal / length, glm::dot(normal, p[i]) / length };
}

/// Whether a plane through an edge of a and a vertex of b has both on one side and the occluder on
/// the other: these planes are the sides of the hull of a and b.
bool SideOfHullParts(const Polygon& a, const Polygon& b, const Polygon& occluder, double tolerance)
{
  for (int i = 0; i < a.Size(); ++i)
  {
    for (const Vec3& v : b)
    {
      const std::optional<Plane> side = ThroughEdge(a, i, v);
      if (!side)
      {
        continue;
      }
      const Range ofA = RangeOf(*side, a);
      const Range ofB = RangeOf(*side, b);
      const Range ofOccluder = RangeOf(*side, occluder);
      const bool below = std::max(ofA.most, ofB.most) <= tolerance;
      const bool above = std::min(ofA.least, ofB.least) >= -tolerance;
      if ((below && ofOccluder.least >= -tolerance) || (above && ofOccluder.most <= tolerance))
      {
        return true;
      }
    }
  }
  return false;
}

/// Where b is, as seen from the occluder's side of a plane between or beside them.
enum class SideOfB
{
  Behind,
  InFront
};

/// Adds the planes through an edge of one and a vertex of the other polygon that have the occluder
/// in front and b where it is asked for. One and other are b and the occluder or the reverse.
void AddTangents(const Polygon& one, const Polygon& other, const Polygon& b,
  const Polygon& occluder, SideOfB side, double tolerance, std::vector<Plane>& planes)
{
  for (int i = 0; i < one.Size(); ++i)
  {
    for (const Vec3& v : other)
    {
      const std::optional<Plane> plane = ThroughEdge(one, i, v);
      if (!plane)
      {
        continue;
      }
      const Range ofOccluder = RangeOf(*plane, occluder);
      Range ofB = RangeOf(*plane, b);
      if (side == SideOfB::Behind)
      {
        ofB = { -ofB.most, -ofB.least };
      }
      if (ofB.least >= -tolerance && ofOccluder.least >= -tolerance)
      {
        planes.push_back(*plane);
      }
      else if (ofB.most <= tolerance && ofOccluder.most <= tolerance)
      {
        planes.push_back({ -plane->normal, -plane->offset });
      }
    }
  }
}

std::vector<Plane> Tangents(
  const Polygon& b, const Polygon& occluder, SideOfB side, double tolerance)
{
  std::vector<Plane> planes;
  AddTangents(b, occluder, b, occluder, side, tolerance, planes);
  AddTangents(occluder, b, b, occluder, side, tolerance, planes);
  return planes;
}

} // namespace

Blocking BlockingBetween(
  const Polygon& a, const Polygon& b, const Polygon& occluder, double tolerance)
{
  const Plane plane = SupportingPlane(occluder);
  OneSide above, below;
  for (const Polygon* p : { &a, &b })
  {
    for (const Vec3& v : *p)
    {
      const double height = plane.Distance(v);
      (height > 0.0 ? above : below).Add(v, std::abs(height), p == &a);
    }
  }
  if (above.Highest() <= tolerance || below.Highest() <= tolerance)
  {
    return Blocking::None;
  }
  const bool apart = above.ofA != above.ofB && below.ofA != below.ofB;
  bool insideAll = true;
  for (int i = 0; i < occluder.Size(); ++i)
  {
    const Vec3 along = occluder[(i + 1) % occluder.Size()] - occluder[i];
    const Vec3 inward = glm::cross(plane.normal, along);
    const double length = glm::length(inward);
    if (length == 0.0)
    {
      continue;
    }
    const Plane edge{ inward / length, glm::dot(inward, occluder[i]) / length };
    const Range range = RangeInside(edge, above, below);
    if (range.most <= tolerance)
    {
      return Blocking::None;
    }
    insideAll = insideAll && range.least >= -tolerance;
  }
  if (apart && insideAll)
  {
    return Blocking::Full;
  }
  const bool beside =
    SideOfHullParts(a, b, occluder, tolerance) || SideOfHullParts(b, a, occluder, tolerance);
  return beside ? Blocking::None : Blocking::Partial;
}

std::vector<Plane> PenumbraSides(const Polygon& b, const Polygon& occluder, double tolerance)
{
  return Tangents(b, occluder, SideOfB::Behind, tolerance);
}

std::vector<Plane> UmbraSides(const Polygon& b, const Polygon& occluder, double tolerance)
{
  return Tangents(b, occluder, SideOfB::InFront, tolerance);
}

} // namespace vantage
