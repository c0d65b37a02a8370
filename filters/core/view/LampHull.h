#pragma once

#include "core/math/Polygon.h"
#include "core/view/LampSurface.h"

#include <optional>
#include <vector>

/// \file LampHull.h
/// A lamp as the edges of shadows cut it, and these edges.

namespace vantage
{

/// How much of something is on one side.
enum class Cover
{
  None,
  Part,
  Whole
};

inline Cover CoverOf(bool anyInside, bool anyOutside)
{
  return anyInside ? (anyOutside ? Cover::Part : Cover::Whole) : Cover::None;
}

/// Of corners whose heights over a plane are asked for in turn.
template <typename HeightOf>
Cover CoverOfHeights(const std::vector<Vec3>& corners, const HeightOf& heightOf)
{
  bool anyInside = false;
  bool anyOutside = false;
  for (const Vec3& corner : corners)
  {
    const double height = heightOf(corner);
    anyInside = anyInside || height > 0.0;
    anyOutside = anyOutside || height < 0.0;
  }
  return CoverOf(anyInside, anyOutside);
}

/// A number that is linear over the plane z = 0.
struct AffineOverPlane
{
  double constant, x, y;

  double At(const Vec2& place) const
  {
    return this->constant + this->x * place.x + this->y * place.y;
  }
};

/// The distance of points of z = 0 from a plane.
inline AffineOverPlane DistanceFrom(const Plane& plane)
{
  return { -plane.offset, plane.normal.x, plane.normal.y };
}

/// An edge of what casts a shadow, and the plane through it and a point x of z = 0: its normal is
/// n(x) = moment - along x x, towards a place y: dot(n(x), y - x), of which the products with x
/// alone are linear as well.
struct ShadowEdge
{
  Vec3 along;
  Vec3 moment; ///< n(0), not normalised

  ShadowEdge(const Vec3& from, const Vec3& to)
    : along(to - from)
    , moment(glm::cross(this->along, from))
  {
  }

  /// What is inside of the edge as x sees it. \param sign 1 if the edge runs counter-clockwise
  /// around the shadow as seen from x, else -1
  LampSurface::HalfSpace SideBehind(double sign, const Vec2& x) const
  {
    const Vec3 normal(this->moment.x + this->along.z * x.y, this->moment.y - this->along.z * x.x,
      this->moment.z - this->along.x * x.y + this->along.y * x.x);
    return { sign * normal, -sign * (this->moment.x * x.x + this->moment.y * x.y) };
  }
};

/// A lamp and what it lies in. Refers to it.
class LampHull
{
public:
  explicit LampHull(const LampSurface& lamp);

  const LampSurface& Lamp() const { return *this->TheLamp; }
  /// Of a convex polygon or body that holds the lamp.
  const std::vector<Vec3>& Corners() const { return this->Hull; }

  /// How much of the hull is inside of a side.
  Cover HullBehind(const LampSurface::HalfSpace& side) const
  {
    return CoverOfHeights(this->Hull, [&side](const Vec3& corner) { return side.Height(corner); });
  }
  /// Whether an edge hides none of the lamp from some points, and all of it from others.
  bool PassesBetween(const ShadowEdge& edge, double sign, const Polygon& points) const;
  /// The plane of a face of the lamp that some corners are in front of.
  std::optional<Plane> FaceInFrontOf(const std::vector<Vec3>& corners) const;

private:
  Cover LampBehind(const LampSurface::HalfSpace& side) const;

  const LampSurface* TheLamp;
  std::vector<Vec3> Hull;
};

/// Whether all points are, or touch the plane.
inline bool AreInFront(const std::vector<Vec3>& points, const Plane& plane)
{
  for (const Vec3& point : points)
  {
    if (plane.Distance(point) < -LampSurface::Touching)
    {
      return false;
    }
  }
  return true;
}

} // namespace vantage
