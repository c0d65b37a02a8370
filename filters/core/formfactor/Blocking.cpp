#include "core/formfactor/Blocking.h"

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

/// Where the hull of all vertices meets the plane, as seen from one edge of the occluder: the range
/// of distances inside that edge.
struct Range
{
  double least = std::numeric_limits<double>::infinity();
  double most = -std::numeric_limits<double>::infinity();
};

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
  return apart && insideAll ? Blocking::Full : Blocking::Partial;
}

} // namespace vantage
