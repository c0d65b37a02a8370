#pragma once

#include "core/math/Types.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <initializer_list>
#include <type_traits>
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

template <int MostVertices>
class PolygonOf;

/// The vertices of a polygon that is kept elsewhere.
class PolygonView
{
public:
  PolygonView(const Vec3* first, int count)
    : First(first)
    , Count(count)
  {
  }
  template <int MostVertices>
  PolygonView(const PolygonOf<MostVertices>& p)
    : PolygonView(p.begin(), p.Size())
  {
  }

  int Size() const { return this->Count; }
  const Vec3& operator[](int i) const { return this->First[i]; }
  const Vec3* begin() const { return this->First; }
  const Vec3* end() const { return this->First + this->Count; }

private:
  const Vec3* First;
  int Count;
};

/// A convex planar polygon, counter-clockwise seen from its front, with room for so many vertices.
template <int MostVertices>
class PolygonOf
{
public:
  static constexpr int Capacity = MostVertices;

  PolygonOf() = default;
  PolygonOf(std::initializer_list<Vec3> vertices)
  {
    for (const Vec3& v : vertices)
    {
      this->Add(v);
    }
  }
  /// \pre there is room for them
  explicit PolygonOf(PolygonView vertices)
    : Count(vertices.Size())
  {
    assert(this->Count <= Capacity);
    std::copy(vertices.begin(), vertices.end(), this->Vertices.begin());
  }
  template <int Fewer, typename = std::enable_if_t<(Fewer < MostVertices)>>
  PolygonOf(const PolygonOf<Fewer>& other)
    : PolygonOf(PolygonView(other))
  {
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

/// Has room for what is left of a triangle or quadrilateral after clipping it to half-spaces, each
/// of which adds at most one vertex.
using Polygon = PolygonOf<16>;

/// Has not: what is kept of each facet of a large scene.
using TriangleOrQuadrilateral = PolygonOf<4>;

/// Area-weighted normal (Newell): its length is the area. Exact for any planar polygon, relative
/// to its first vertex so that far-away polygons lose nothing.
Vec3 AreaNormal(PolygonView p);

double Area(PolygonView p);

/// Unit normal; (0,0,0) for a polygon without area.
Vec3 UnitNormal(PolygonView p);

/// Centre of gravity of the surface (not of the vertices).
Vec3 Centroid(PolygonView p);

/// Supporting plane, through the vertex mean.
Plane SupportingPlane(PolygonView p);

/// Radius of the smallest sphere around `centre` that holds the polygon.
double RadiusAround(PolygonView p, const Vec3& centre);

/// The part of p in front of the plane (Sutherland, Hodgman 1974, one plane). Vertices nearer to
/// the plane than `tolerance` count as on it. The result is Empty() when nothing is in front.
Polygon ClipToFront(const Polygon& p, const Plane& plane, double tolerance = 0.0);

/// The same polygon seen from its other side.
template <int MostVertices>
PolygonOf<MostVertices> Reversed(const PolygonOf<MostVertices>& p)
{
  PolygonOf<MostVertices> result;
  for (int i = p.Size() - 1; i >= 0; --i)
  {
    result.Add(p[i]);
  }
  return result;
}

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
