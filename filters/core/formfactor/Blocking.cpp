#include "core/formfactor/Blocking.h"

#include "core/math/Sampling.h"

#include <algorithm>
#include <cmath>
#include <limits>

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

/// Whether a plane through an edge of a and a vertex of b has both on one side and the occluder on
/// the other: these planes are the sides of the hull of a and b.
bool SideOfHullParts(const Polygon& a, const Polygon& b, const Polygon& occluder, double tolerance)
{
  for (int i = 0; i < a.Size(); ++i)
  {
    const Vec3 along = a[(i + 1) % a.Size()] - a[i];
    for (const Vec3& v : b)
    {
      const Vec3 normal = glm::cross(along, v - a[i]);
      const double length = glm::length(normal);
      if (length == 0.0)
      {
        continue;
      }
      const Plane side{ normal / length, glm::dot(normal, a[i]) / length };
      const Range ofA = RangeOf(side, a);
      const Range ofB = RangeOf(side, b);
      const Range ofOccluder = RangeOf(side, occluder);
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

double PenumbraWidth(const Plane& ground, const Polygon& b, const Polygon& occluder)
{
  constexpr int directions = 8;
  const Frame frame(ground.normal);
  std::array<Range, directions> ranges;
  for (const Vec3& y : b)
  {
    const double heightB = ground.Distance(y);
    for (const Vec3& v : occluder)
    {
      const double height = ground.Distance(v);
      if (height >= heightB)
      {
        return std::numeric_limits<double>::infinity();
      }
      const Vec3 shadow = y + (heightB / (heightB - height)) * (v - y);
      for (int k = 0; k < directions; ++k)
      {
        const double angle = k * Pi / directions;
        const double along =
          glm::dot(shadow, std::cos(angle) * frame.x + std::sin(angle) * frame.y);
        ranges[k].least = std::min(ranges[k].least, along);
        ranges[k].most = std::max(ranges[k].most, along);
      }
    }
  }
  double width = std::numeric_limits<double>::infinity();
  for (const Range& range : ranges)
  {
    width = std::min(width, range.most - range.least);
  }
  return width;
}

} // namespace vantage
