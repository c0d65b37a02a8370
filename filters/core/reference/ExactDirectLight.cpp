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

/// A lamp from a point: what of it is above the horizon, and what can stand in the way. The point
/// becomes the origin and the lamp is about 1 away.
struct ExactDirectLight::Sight
{
  Sight(const Polygon& lamp, const Plane& givenLampPlane, const Vec3& x, const Vec3& givenNormal,
    double tolerance);

  /// The part of a facet that lies between the point and the lamp's plane.
  Polygon ShadowCaster(const Polygon& facet, double tolerance) const
  {
    const Polygon above = ClipToFront(facet, this->ground, tolerance);
    return Rescaled(ClipToFront(above, this->lampPlane, tolerance), this->origin, this->scale);
  }
  double SeenPast(const std::vector<Polygon>& shadows) const
  {
    return PointToVisiblePolygon(Vec3(0.0), this->normal, this->target, shadows);
  }

  Vec3 origin, normal;
  Plane ground, lampPlane;
  Polygon shining; ///< the part of the lamp above the horizon, empty when nothing shines here
  double scale = 1.0;
  Polygon target; ///< that part, rescaled
};

ExactDirectLight::Sight::Sight(const Polygon& lamp, const Plane& givenLampPlane, const Vec3& x,
  const Vec3& givenNormal, double tolerance)
  : origin(x)
  , normal(givenNormal)
  , ground{ givenNormal, glm::dot(givenNormal, x) }
  , lampPlane(givenLampPlane)
{
  if (this->lampPlane.Distance(x) > tolerance)
  {
    this->shining = ClipToFront(lamp, this->ground, tolerance);
  }
  if (!this->shining.Empty())
  {
    this->scale = 1.0 / glm::length(Centroid(this->shining) - x);
    this->target = Rescaled(this->shining, x, this->scale);
  }
}

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
        const Polygon shape = side == Side::Front ? facet.shape : Reversed(facet.shape);
        this->Lamps.push_back({ shape, SupportingPlane(shape), emission, f });
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
  const double tolerance = this->Occluders->Tolerance();
  const Sight sight(lamp.shape, lamp.plane, hit.point, normal, tolerance);
  if (sight.target.Empty() || this->IsHiddenByOne(lamp, hit, sight))
  {
    return 0.0;
  }
  std::vector<Polygon> shadows;
  const ConvexRegion between = Pyramid(hit.point, sight.shining, sight.ground);
  for (const std::uint32_t f : this->Occluders->FacetsInRegion(between))
  {
    const Polygon shadow = f == hit.facet || f == lamp.facet
                             ? Polygon()
                             : sight.ShadowCaster(this->Occluders->Shape(f), tolerance);
    if (shadow.Empty())
    {
      continue;
    }
    shadows.push_back(shadow);
    if (sight.SeenPast({ shadow }) == 0.0)
    {
      return 0.0;
    }
  }
  return sight.SeenPast(shadows);
}

/// Whether one of the facets on the way to the middle of the lamp hides all of it: most lamps of
/// many rooms are behind a wall, and a ray finds that sooner than all that stands between does.
bool ExactDirectLight::IsHiddenByOne(const Lamp& lamp, const Hit& hit, const Sight& sight) const
{
  const Vec3 way = Centroid(sight.shining) - hit.point;
  Hit at = hit;
  for (double left = 1.0; left > 0.0;)
  {
    const auto next = this->Occluders->Intersect(at.point, way, at.facet);
    if (!next || next->facet == lamp.facet || next->distance >= left)
    {
      return false;
    }
    const Polygon shadow =
      sight.ShadowCaster(this->Occluders->Shape(next->facet), this->Occluders->Tolerance());
    if (!shadow.Empty() && sight.SeenPast({ shadow }) == 0.0)
    {
      return true;
    }
    left -= next->distance;
    at = *next;
  }
  return false;
}

} // namespace vantage
