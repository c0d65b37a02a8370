#pragma once

#include "core/math/Types.h"

#include <array>
#include <cassert>
#include <initializer_list>
#include <vector>

/// \file Polygon.h
/// A small convex planar polygon that lives on the stack.

namespace vantage
{

/// An oriented plane: points x with dot(normal, x) = offset; in front where the dot is larger.
/// The normal has unit length.
struct Plane
{
  Vec3 normal{ 0.0, 0.0, 1.0 };
  double offset = 0.0;

  /// Signed distance of x, positive in front.
  double Distance(const Vec3& x) const { return glm::dot(this->normal, x) - this->offset; }
};

/// A convex planar polygon, counter-clockwise seen from its front. Patches and elements have three
/// or four vertices; clipping one to half-spaces adds at most one vertex a plane.
class Polygon
{
public:
  static constexpr int Capacity = 16;

  Polygon() = default;
  Polygon(std::initializer_list<Vec3> vertices)
  {
    for (const Vec3& v : vertices)
    {
      this->Add(v);
    }
  }

  void Add(const Vec3& v)
  {
    assert(this->Count < Capacity);
    this->Vertices[this->Count++] = v;
  }
  void Clear() { this->Count = 0; }

  int Size() const { return this->Count; }
  bool Empty() const { return this->Count < 3; }
  const Vec3& operator[](int i) const { return this->Vertices[i]; }
  Vec3& operator[](int i) { return this->Vertices[i]; }
  const Vec3* begin() const { return this->Vertices.data(); }
  const Vec3* end() const { return this->Vertices.data() + this->Count; }

private:
  std::array<Vec3, Capacity> Vertices;
  int Count = 0;
};

/// Area-weighted normal (Newell): its length is the area. Exact for any planar polygon, relative
/// to its first vertex so that far-away polygons lose nothing.
Vec3 AreaNormal(const Polygon& p);

double Area(const Polygon& p);

/// Unit normal; (0,0,0) for a polygon without area.
Vec3 UnitNormal(const Polygon& p);

/// Centre of gravity of the surface (not of the vertices).
Vec3 Centroid(const Polygon& p);

/// Supporting plane, through the vertex mean.
Plane SupportingPlane(const Polygon& p);

/// Radius of the smallest sphere around `centre` that holds the polygon.
double RadiusAround(const Polygon& p, const Vec3& centre);

/// The part of p in front of the plane (Sutherland, Hodgman 1974, one plane). Vertices nearer to
/// the plane than `tolerance` count as on it. The result is Empty() when nothing is in front.
Polygon ClipToFront(const Polygon& p, const Plane& plane, double tolerance = 0.0);

/// The same polygon seen from its other side.
Polygon Reversed(const Polygon& p);

/// Quadrilaterals around vertex 0 that make up p; the last one may be a triangle.
std::vector<Polygon> InQuadrilaterals(const Polygon& p);

/// Point of a triangle or quadrilateral at (u, v) in the unit square: bilinear on a quadrilateral
/// v0 v1 v2 v3 = (0,0) (1,0) (1,1) (0,1); the area-preserving square-to-triangle map of Shirley
/// and Chiu (1997) on a triangle. \pre p.Size() is 3 or 4.
Vec3 PointAt(const Polygon& p, const Vec2& uv);
/// The same of corners that are kept elsewhere.
Vec3 PointAt(const Vec3* corners, int count, const Vec2& uv);

/// The area that a unit of (u, v) covers at PointAt(p, uv): |dx/du x dx/dv|. Area(p) everywhere on
/// a triangle or a parallelogram. \pre p.Size() is 3 or 4.
double AreaElementAt(const Polygon& p, const Vec2& uv);

/// The same, to the bit, whichever end comes first.
inline Vec3 Midpoint(const Vec3& a, const Vec3& b)
{
  return 0.5 * (a + b);
}

} // namespace vantage
