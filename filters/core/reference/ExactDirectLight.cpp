#include "core/reference/ExactDirectLight.h"

#include "core/formfactor/FormFactor.h"
#include "core/formfactor/Shadows.h"

#include <algorithm>

namespace vantage
{

namespace
{

/// The polygon moved so that `origin` is at (0,0,0), and scaled.
Polygon Rescaled(const Polygon& polygon, const Vec3& origin, double scale)
{
  Polygon result;
  for (const Vec3& v : polygon)
  {
    result.Add(scale * (v - origin));
  }
  return result;
}

/// The pyramid of all segments from a point to a polygon that lies in front of `ground`, which goes
/// through the point.
ConvexRegion Pyramid(const Vec3& apex, const Polygon& base, const Plane& ground)
{
  ConvexRegion region;
  region.low = region.high = apex;
  const Plane basePlane = SupportingPlane(base);
  region.Add(basePlane);
  region.Add(ground);
  for (int i = 0; i < base.Size(); ++i)
  {
    region.low = glm::min(region.low, base[i]);
    region.high = glm::max(region.high, base[i]);
    const Vec3 across = glm::cross(base[i] - apex, base[(i + 1) % base.Size()] - base[i]);
    const double length = glm::length(across);
    if (length > 0.0)
    {
      // The base is counter-clockwise seen from the apex: inwards is to the left of its edges.
      const Vec3 inward = -across / length;
      region.Add({ inward, glm::dot(inward, apex) });
    }
  }
  return region;
}

} // namespace

ExactDirectLight::ExactDirectLight(
  const Scene& scene, const FacetSet& facets, const OccluderScene& occluders)
  : Occluders(&occluders)
{
  for (std::uint32_t f = 0; f < facets.facets.size(); ++f)
  {
    const Facet& facet = facets.facets[f];
    for (const Side side : { Side::Front, Side::Back })
    {
      const Color& emission = scene.materials[facet.MaterialOf(side)].emission;
      if (facet.IsPolygonFront(side) && MaxChannel(emission) > 0.0)
      {
        this->Lamps.push_back(
          { side == Side::Front ? facet.shape : Reversed(facet.shape), emission, f });
      }
    }
  }
}

Color ExactDirectLight::At(const Hit& hit, const Vec3& normal) const
{
  Color sum(0.0);
  for (const Lamp& lamp : this->Lamps)
  {
    if (lamp.facet != hit.facet)
    {
      sum += this->SeenOf(lamp, hit, normal) / Pi * lamp.emission;
    }
  }
  return sum;
}

/// Integral of the cosine over what the point sees of the lamp, sr.
double ExactDirectLight::SeenOf(const Lamp& lamp, const Hit& hit, const Vec3& normal) const
{
  const Vec3& x = hit.point;
  const double tolerance = this->Occluders->Tolerance();
  const Plane lampPlane = SupportingPlane(lamp.shape);
  if (lampPlane.Distance(x) <= tolerance)
  {
    return 0.0;
  }
  const Plane ground{ normal, glm::dot(normal, x) };
  const Polygon shining = ClipToFront(lamp.shape, ground, tolerance);
  if (shining.Empty())
  {
    return 0.0;
  }
  const double scale = 1.0 / glm::length(Centroid(shining) - x);
  const Polygon target = Rescaled(shining, x, scale);
  std::vector<Polygon> shadows;
  for (const std::uint32_t f : this->Occluders->FacetsInRegion(Pyramid(x, shining, ground)))
  {
    if (f == hit.facet || f == lamp.facet)
    {
      continue;
    }
    const Polygon above = ClipToFront(this->Occluders->Shape(f), ground, tolerance);
    const Polygon between = ClipToFront(above, lampPlane, tolerance);
    if (between.Empty())
    {
      continue;
    }
    shadows.push_back(Rescaled(between, x, scale));
    if (PointToVisiblePolygon(Vec3(0.0), normal, target, { shadows.back() }) == 0.0)
    {
      return 0.0;
    }
  }
  return PointToVisiblePolygon(Vec3(0.0), normal, target, shadows);
}

} // namespace vantage
