#pragma once

#include "core/math/Sampling.h"
#include "core/mesh/Facets.h"

#include <vector>

/// \file TestScenes.h
/// Small scenes for the tests of what looks through space.

namespace vantage::testing
{

/// Where a scene is put: x -> offset + scale * x.
struct Placement
{
  double scale = 1.0;
  Vec3 offset{ 0.0 };

  Vec3 operator()(const Vec3& x) const { return this->offset + this->scale * x; }
};

inline FacetSet FacetsOf(
  const std::vector<std::vector<Vec3>>& polygons, const Placement& place = {})
{
  Scene scene;
  scene.materials.emplace_back();
  for (const auto& polygon : polygons)
  {
    std::vector<Vec3> placed;
    for (const Vec3& v : polygon)
    {
      placed.push_back(place(v));
    }
    scene.AddPolygon(placed, 0);
  }
  return BuildFacets(scene);
}

/// The faces of an axis-aligned box, fronts towards the inside.
inline std::vector<std::vector<Vec3>> BoxFaces(const Vec3& a, const Vec3& b)
{
  return { { { a.x, a.y, a.z }, { b.x, a.y, a.z }, { b.x, b.y, a.z }, { a.x, b.y, a.z } },
    { { a.x, a.y, b.z }, { a.x, b.y, b.z }, { b.x, b.y, b.z }, { b.x, a.y, b.z } },
    { { a.x, a.y, a.z }, { a.x, a.y, b.z }, { b.x, a.y, b.z }, { b.x, a.y, a.z } },
    { { a.x, b.y, a.z }, { b.x, b.y, a.z }, { b.x, b.y, b.z }, { a.x, b.y, b.z } },
    { { a.x, a.y, a.z }, { a.x, b.y, a.z }, { a.x, b.y, b.z }, { a.x, a.y, b.z } },
    { { b.x, a.y, a.z }, { b.x, a.y, b.z }, { b.x, b.y, b.z }, { b.x, b.y, a.z } } };
}

/// The facet of the set whose plane holds all the points.
inline std::uint32_t FacetAt(const FacetSet& set, const Vec3& point)
{
  const double diagonal = glm::length(set.high - set.low);
  for (std::uint32_t f = 0; f < set.facets.size(); ++f)
  {
    const Polygon& shape = set.facets[f].shape;
    const Plane plane = SupportingPlane(shape);
    bool holds = std::abs(plane.Distance(point)) < 1e-7 * diagonal;
    for (int i = 0; i < shape.Size(); ++i)
    {
      const Vec3 edge = shape[(i + 1) % shape.Size()] - shape[i];
      const Vec3 inwards = glm::normalize(glm::cross(plane.normal, edge));
      holds = holds && glm::dot(inwards, point - shape[i]) > -1e-7 * diagonal;
    }
    if (holds)
    {
      return f;
    }
  }
  return None;
}

inline Vec3 RandomPoint(RandomStream& random)
{
  const Vec2 xy = random.Next2();
  return { xy.x, xy.y, random.Next() };
}

/// Triangles with corners anywhere in the unit cube, each shrunk towards its first corner.
inline std::vector<std::vector<Vec3>> TriangleSoup(int count, double size, std::uint64_t seed)
{
  std::vector<std::vector<Vec3>> soup;
  RandomStream random(seed);
  for (int i = 0; i < count; ++i)
  {
    const Vec3 a = RandomPoint(random);
    const Vec3 b = a + size * (RandomPoint(random) - 0.5);
    soup.push_back({ a, b, a + size * (RandomPoint(random) - 0.5) });
  }
  return soup;
}

} // namespace vantage::testing
