#include "core/visibility/FlatOccluder.h"

#include <algorithm>
#include <cmath>

namespace vantage
{

FlatOccluder::FlatOccluder(const Polygon& shape, std::uint32_t facetId)
  : plane(SupportingPlane(shape))
  , facet(facetId)
{
  for (int i = 0; i < 4; ++i)
  {
    const int k = std::min(i, shape.Size() - 1);
    const Vec3 edge = shape[(k + 1) % shape.Size()] - shape[k];
    this->edges[i].normal = glm::normalize(glm::cross(this->plane.normal, edge));
    this->edges[i].offset = glm::dot(this->edges[i].normal, shape[k]);
  }
}

bool FlatOccluder::Covers(const Vec3& x, double tolerance) const
{
  return std::all_of(this->edges.begin(), this->edges.end(),
    [&](const Plane& edge) { return edge.Distance(x) >= -tolerance; });
}

std::vector<Polygon> FlatParts(const Polygon& facet, double tolerance)
{
  const Plane plane = SupportingPlane(facet);
  const bool isFlat = std::all_of(facet.begin(), facet.end(),
    [&](const Vec3& v) { return std::abs(plane.Distance(v)) <= tolerance; });
  if (isFlat || facet.Size() == 3)
  {
    return { facet };
  }
  return { { facet[0], facet[1], facet[2] }, { facet[0], facet[2], facet[3] } };
}

} // namespace vantage
