#include "core/formfactor/SurfaceQuadrature.h"

#include "core/formfactor/GaussLegendre.h"

#include <cassert>

namespace vantage
{
namespace
{

void AddQuadrilateral(
  SurfaceNodes& nodes, const std::array<Vec3, 4>& corners, const Vec3& normal, int points)
{
  const GaussRule& rule = GaussLegendre(points);
  const Vec3 alongU = corners[1] - corners[0];
  const Vec3 alongV = corners[3] - corners[0];
  const Vec3 twist = corners[2] - corners[1] - alongV;
  for (int i = 0; i < rule.count; ++i)
  {
    const double u = rule.nodes[i];
    const Vec3 derivativeV = alongV + u * twist;
    for (int j = 0; j < rule.count; ++j)
    {
      const double v = rule.nodes[j];
      const Vec3 derivativeU = alongU + v * twist;
      const Vec3 point = corners[0] + u * alongU + v * derivativeV;
      const double jacobian = glm::dot(glm::cross(derivativeU, derivativeV), normal);
      nodes.x[nodes.count] = point.x;
      nodes.y[nodes.count] = point.y;
      nodes.z[nodes.count] = point.z;
      nodes.weights[nodes.count] = rule.weights[i] * rule.weights[j] * jacobian;
      ++nodes.count;
    }
  }
}

} // namespace

SurfaceNodes NodesOn(const Polygon& p, int points)
{
  assert(points >= 1 && points <= SurfaceNodes::MaxPointsPerSide);
  SurfaceNodes nodes;
  const Vec3 normal = UnitNormal(p);
  for (int i = 1; i + 1 < p.Size(); i += 2)
  {
    // A triangle is a quadrilateral whose last two corners coincide.
    const int last = i + 2 < p.Size() ? i + 2 : i + 1;
    AddQuadrilateral(nodes, { p[0], p[i], p[i + 1], p[last] }, normal, points);
  }
  return nodes;
}

} // namespace vantage
