#include "core/reference/ReferenceGeometry.h"

#include "core/math/ScrambledSobol.h"

namespace vantage
{

ReferenceGeometry::ReferenceGeometry(const Scene& givenScene)
  : scene(givenScene)
  , facets(BuildFacets(givenScene))
  , occluders(this->facets)
  , direct(givenScene, this->facets, this->occluders)
{
}

SurfacePlace ReferenceGeometry::PlaceOf(const Hit& hit) const
{
  const Facet& facet = this->facets.facets[hit.facet];
  const Material& material = this->scene.materials[facet.MaterialOf(hit.side)];
  const bool isFront = facet.IsPolygonFront(hit.side);
  const Vec3 front = UnitNormal(facet.shape);
  return { hit, hit.side == Side::Front ? front : -front,
    isFront || material.twoSided ? material.albedo : Color(0.0),
    isFront ? material.emission : Color(0.0) };
}

std::vector<std::optional<Hit>> ReferenceGeometry::Gather(
  const SurfacePlace& place, int rays, std::uint64_t seed) const
{
  const Frame frame(place.normal);
  std::vector<std::optional<Hit>> hits(static_cast<std::size_t>(rays));
  for (int i = 0; i < rays; ++i)
  {
    const Vec2 u = ScrambledSobol(static_cast<std::uint32_t>(i), seed);
    hits[i] = this->occluders.Intersect(
      place.hit.point, frame.ToWorld(CosineHemisphere(u)), place.hit.facet);
  }
  return hits;
}

} // namespace vantage
