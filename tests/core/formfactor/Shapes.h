#pragma once

#include "core/math/Polygon.h"
#include "core/math/Sampling.h"

#include <cmath>
#include <vector>

/// \file Shapes.h
/// Polygons that the form factor tests share.

namespace vantage
{

/// [0, w] x [0, h] at height z, facing up.
inline Polygon Floor(double w = 1.0, double h = 1.0, double z = 0.0)
{
  return { { 0, 0, z }, { w, 0, z }, { w, h, z }, { 0, h, z } };
}

/// The same, facing down.
inline Polygon Ceiling(double z, double w = 1.0, double h = 1.0)
{
  return Reversed(Floor(w, h, z));
}

/// Four elements around the middle of a quadrilateral.
inline std::vector<Polygon> Quartered(const Polygon& q)
{
  const Vec3 m01 = 0.5 * (q[0] + q[1]), m12 = 0.5 * (q[1] + q[2]);
  const Vec3 m23 = 0.5 * (q[2] + q[3]), m30 = 0.5 * (q[3] + q[0]);
  const Vec3 c = 0.25 * (q[0] + q[1] + q[2] + q[3]);
  return { { q[0], m01, c, m30 }, { m01, q[1], m12, c }, { c, m12, q[2], m23 },
    { m30, c, m23, q[3] } };
}

/// A rotation, a scale and a shift, the same for all points.
struct Motion
{
  Frame frame{ Vec3(0, 0, 1) };
  double scale = 1.0;
  Vec3 shift{ 0.0 };

  Polygon operator()(const Polygon& p) const
  {
    Polygon moved;
    for (const Vec3& v : p)
    {
      moved.Add(this->shift + this->scale * this->frame.ToWorld(v));
    }
    return moved;
  }
};

/// The faces of a box with its corners at `low` and `high`, facing inwards.
inline std::vector<Polygon> InsideOfBox(const Vec3& low, const Vec3& high)
{
  const auto corner = [&](int i)
  { return Vec3(i & 1 ? high.x : low.x, i & 2 ? high.y : low.y, i & 4 ? high.z : low.z); };
  const int faces[6][4] = { { 0, 1, 3, 2 }, { 4, 6, 7, 5 }, { 0, 4, 5, 1 }, { 2, 3, 7, 6 },
    { 0, 2, 6, 4 }, { 1, 5, 7, 3 } };
  std::vector<Polygon> box;
  for (const auto& f : faces)
  {
    box.push_back({ corner(f[0]), corner(f[1]), corner(f[2]), corner(f[3]) });
  }
  return box;
}

/// A regular polygon with its centre at c, turned by `angle`, in the plane of the frame's x and y.
inline Polygon Regular(const Vec3& c, const Frame& frame, double radius, int sides, double angle)
{
  Polygon p;
  for (int i = 0; i < sides; ++i)
  {
    const double t = angle + 2.0 * Pi * i / sides;
    p.Add(c + radius * (std::cos(t) * frame.x + std::sin(t) * frame.y));
  }
  return p;
}

inline Vec3 RandomDirection(RandomStream& random)
{
  const double z = 2.0 * random.Next() - 1.0;
  const double phi = 2.0 * Pi * random.Next();
  const double r = std::sqrt(1.0 - z * z);
  return { r * std::cos(phi), r * std::sin(phi), z };
}

/// A rectangle, a triangle or a convex quadrilateral around c, about 2 long and 2 aspect wide.
inline Polygon RandomPolygon(RandomStream& random, const Vec3& c, const Vec3& normal, double aspect)
{
  const Frame frame(normal);
  const double t = 2.0 * Pi * random.Next();
  const Vec3 x = std::cos(t) * frame.x + std::sin(t) * frame.y;
  const Vec3 y = aspect * (std::cos(t) * frame.y - std::sin(t) * frame.x);
  const double kind = random.Next();
  const double s = random.Next();
  if (kind < 0.4)
  {
    return { c - x - y, c + x - y, c + x + y, c - x + y };
  }
  if (kind < 0.7)
  {
    return { c - x - y, c + x - y, c + (2.0 * s - 1.0) * x + y };
  }
  return { c - x - y, c + x - y, c + (0.2 + 0.8 * s) * x + y, c - x + (0.2 + 0.7 * s) * y };
}

} // namespace vantage
