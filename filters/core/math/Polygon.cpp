#include "core/math/Polygon.h"

#include <algorithm>
#include <cmath>

namespace vantage
{

Vec3 AreaNormal(PolygonView p)
{
  Vec3 sum(0.0);
  for (int i = 2; i < p.Size(); ++i)
  {
    sum += glm::cross(p[i - 1] - p[0], p[i] - p[0]);
  }
  return 0.5 * sum;
}

double Area(PolygonView p)
{
  return glm::length(AreaNormal(p));
}

Vec3 UnitNormal(PolygonView p)
{
  const Vec3 n = AreaNormal(p);
  const double length = glm::length(n);
  return length > 0.0 ? n / length : Vec3(0.0);
}

Vec3 Centroid(PolygonView p)
{
  const Vec3 n = UnitNormal(p);
  Vec3 moment(0.0);
  double total = 0.0;
  for (int i = 2; i < p.Size(); ++i)
  {
    const Vec3 a = p[i - 1] - p[0];
    const Vec3 b = p[i] - p[0];
    const double area = glm::dot(glm::cross(a, b), n);
    moment += area * (a + b);
    total += area;
  }
  return total > 0.0 ? p[0] + moment / (3.0 * total) : p[0];
}

Plane SupportingPlane(PolygonView p)
{
  Plane plane;
  plane.normal = UnitNormal(p);
  Vec3 mean(0.0);
  for (const Vec3& v : p)
  {
    mean += v - p[0];
  }
  plane.offset = glm::dot(plane.normal, p[0] + mean / static_cast<double>(p.Size()));
  return plane;
}

double RadiusAround(PolygonView p, const Vec3& centre)
{
  double r2 = 0.0;
  for (const Vec3& v : p)
  {
    r2 = std::max(r2, glm::dot(v - centre, v - centre));
  }
  return std::sqrt(r2);
}

Polygon ClipToFront(const Polygon& p, const Plane& plane, double tolerance)
{
  Polygon result;
  bool anyInside = false;
  const int n = p.Size();
  for (int i = 0; i < n; ++i)
  {
    const Vec3& a = p[i];
    const Vec3& b = p[(i + 1) % n];
    const double da = plane.Distance(a);
    const double db = plane.Distance(b);
    if (da >= -tolerance)
    {
      result.Add(a);
      anyInside = anyInside || da > tolerance;
    }
    if ((da > tolerance && db < -tolerance) || (da < -tolerance && db > tolerance))
    {
      result.Add(a + (da / (da - db)) * (b - a));
    }
  }
  if (!anyInside)
  {
    result.Clear();
  }
  return result;
}

std::vector<Polygon> InQuadrilaterals(const Polygon& p)
{
  std::vector<Polygon> parts;
  for (int i = 1; i + 1 < p.Size(); i += 2)
  {
    Polygon part{ p[0], p[i], p[i + 1] };
    if (i + 2 < p.Size())
    {
      part.Add(p[i + 2]);
    }
    parts.push_back(part);
  }
  return parts;
}

Vec3 PointAt(const Polygon& p, const Vec2& uv)
{
  return PointAt(p.begin(), p.Size(), uv);
}

Vec3 PointAt(const Vec3* corners, int count, const Vec2& uv)
{
  assert(count == 3 || count == 4);
  const Vec3* p = corners;
  if (count == 3)
  {
    const double s = std::sqrt(uv.x);
    return p[0] + s * ((1.0 - uv.y) * (p[1] - p[0]) + uv.y * (p[2] - p[0]));
  }
  const Vec3 bottom = p[0] + uv.x * (p[1] - p[0]);
  const Vec3 top = p[3] + uv.x * (p[2] - p[3]);
  return bottom + uv.y * (top - bottom);
}

double AreaElementAt(const Polygon& p, const Vec2& uv)
{
  assert(p.Size() == 3 || p.Size() == 4);
  if (p.Size() == 3)
  {
    return Area(p);
  }
  const Vec3 alongU = (1.0 - uv.y) * (p[1] - p[0]) + uv.y * (p[2] - p[3]);
  const Vec3 alongV = (1.0 - uv.x) * (p[3] - p[0]) + uv.x * (p[2] - p[1]);
  return glm::length(glm::cross(alongU, alongV));
}

} // namespace vantage
