#include "core/mesh/PatchMesh.h"

#include <cassert>
#include <cmath>

namespace vantage
{

namespace
{

/// Angle at `corner` between the directions to its two neighbours, in [0, pi].
double AngleAt(const Vec3& corner, const Vec3& before, const Vec3& after)
{
  const Vec3 a = after - corner;
  const Vec3 b = before - corner;
  return std::atan2(glm::length(glm::cross(a, b)), glm::dot(a, b));
}

} // namespace

std::vector<Color> PointValues(
  const ElementSurface& surface, const std::vector<Color>& valueOfPolygon)
{
  assert(valueOfPolygon.size() == surface.PolygonCount());
  std::vector<Color> values(surface.points.size(), Color(0.0));
  std::vector<double> weights(surface.points.size(), 0.0);
  for (std::size_t p = 0; p < surface.PolygonCount(); ++p)
  {
    const std::uint32_t first = surface.offsets[p];
    const std::uint32_t n = surface.offsets[p + 1] - first;
    for (std::uint32_t i = 0; i < n; ++i)
    {
      const std::uint32_t before = surface.indices[first + (i + n - 1) % n];
      const std::uint32_t here = surface.indices[first + i];
      const std::uint32_t after = surface.indices[first + (i + 1) % n];
      const double angle =
        AngleAt(surface.points[here], surface.points[before], surface.points[after]);
      values[here] += angle * valueOfPolygon[p];
      weights[here] += angle;
    }
  }
  for (std::size_t i = 0; i < values.size(); ++i)
  {
    values[i] /= weights[i];
  }
  return values;
}

} // namespace vantage
