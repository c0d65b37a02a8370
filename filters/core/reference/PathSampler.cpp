#include "core/reference/PathSampler.h"

#include "core/math/Sampling.h"
#include "core/math/ScrambledSobol.h"

#include <algorithm>

namespace vantage
{

namespace
{

/// A path goes on with no more than this probability once roulette has begun, so that it ends even
/// where nothing is absorbed.
constexpr double LargestSurvival = 0.95;

/// Streams of random numbers of a pixel; the tracer uses one more for the place in the pixel.
enum Stream : std::uint64_t
{
  WhichLamp = 1,
  PlaceOnLamp,
  GatherDirection,
  RestOfPath
};

} // namespace

PathSampler::PathSampler(const Scene& scene, const FacetSet& facets, const OccluderScene& occluders)
  : TheScene(&scene)
  , Facets(&facets)
  , Occluders(&occluders)
  , Lamps(scene, facets)
{
  for (const Facet& facet : facets.facets)
  {
    this->Normals.push_back(UnitNormal(facet.shape));
  }
}

PathSampler::Vertex PathSampler::VertexAt(const Hit& hit) const
{
  const Facet& facet = this->Facets->facets[hit.facet];
  const Material& material = this->TheScene->materials[facet.MaterialOf(hit.side)];
  const bool isFront = facet.IsPolygonFront(hit.side);
  const double sign = hit.side == Side::Front ? 1.0 : -1.0;
  return { hit, sign * this->Normals[hit.facet],
    isFront || material.twoSided ? material.albedo : Color(0.0),
    isFront ? material.emission : Color(0.0) };
}

/// Radiance that x reflects of one lamp, chosen at random.
Color PathSampler::DirectLight(const Vertex& x, const LampNumbers& u, PixelSample& sample) const
{
  const auto choice = this->Lamps.Choose(x.hit.point, x.normal, u.lamp);
  if (!choice || choice->lamp->facet == x.hit.facet)
  {
    return Color(0.0);
  }
  const Lamp& lamp = *choice->lamp;
  const Vec3 y = PointAt(lamp.shape, u.place);
  const Vec3 path = y - x.hit.point;
  const double cosines = glm::dot(x.normal, path) * glm::dot(lamp.normal, -path);
  if (glm::dot(x.normal, path) <= 0.0 || cosines <= 0.0)
  {
    return Color(0.0);
  }
  ++sample.rays;
  if (this->Occluders->IsOccluded({ x.hit.point, x.hit.facet }, { y, lamp.facet }))
  {
    return Color(0.0);
  }
  const double squaredDistance = glm::dot(path, path);
  const double throughput = cosines / (squaredDistance * squaredDistance) *
                            AreaElementAt(lamp.shape, u.place) / choice->probability;
  return x.albedo / Pi * lamp.emission * throughput;
}

/// Radiance that `first` reflects of light that was reflected before: one path from it.
Color PathSampler::IndirectLight(const Vertex& first, std::uint32_t number, const Vec2& direction,
  const PathTracerSettings& settings, const RadianceLookup& lookup, PixelSample& sample) const
{
  RandomStream random(sample.seed, RestOfPath, number);
  Color sum(0.0);
  Color throughput(1.0);
  Vertex x = first;
  Vec2 u = direction;
  for (int bounce = 1;; ++bounce)
  {
    // The density of the direction cancels the cosine and the 1 / pi of the BRDF.
    throughput *= x.albedo;
    const Vec3 towards = Frame(x.normal).ToWorld(CosineHemisphere(u));
    ++sample.rays;
    const auto hit = this->Occluders->Intersect(x.hit.point, towards, x.hit.facet);
    if (!hit)
    {
      return sum;
    }
    if (lookup)
    {
      return throughput * lookup(*hit);
    }
    x = this->VertexAt(*hit);
    const double survival = bounce > settings.rouletteDepth
                              ? std::min(LargestSurvival, MaxChannel(throughput * x.albedo))
                              : 1.0;
    if (MaxChannel(x.albedo) <= 0.0 || random.Next() >= survival)
    {
      return sum;
    }
    throughput /= survival;
    const double lamp = random.Next();
    sum += throughput * this->DirectLight(x, { lamp, random.Next2() }, sample);
    u = random.Next2();
  }
}

Color PathSampler::Radiance(const Vec3& origin, const Vec3& direction,
  const PathTracerSettings& settings, const RadianceLookup& lookup, PixelSample& sample) const
{
  ++sample.rays;
  const auto hit = this->Occluders->Intersect(origin, direction);
  if (!hit)
  {
    return Color(0.0);
  }
  const Vertex x = this->VertexAt(*hit);
  if (MaxChannel(x.albedo) <= 0.0)
  {
    return x.emission;
  }
  Color direct(0.0);
  for (int i = 0; i < settings.shadowRays; ++i)
  {
    const std::uint32_t number = sample.index * settings.shadowRays + i;
    const double lamp = ScrambledSobol(number, Hash(sample.seed, WhichLamp)).x;
    const Vec2 place = ScrambledSobol(number, Hash(sample.seed, PlaceOnLamp));
    direct += this->DirectLight(x, { lamp, place }, sample);
  }
  Color indirect(0.0);
  for (int i = 0; i < settings.gatherRays; ++i)
  {
    const std::uint32_t number = sample.index * settings.gatherRays + i;
    const Vec2 u = ScrambledSobol(number, Hash(sample.seed, GatherDirection));
    indirect += this->IndirectLight(x, number, u, settings, lookup, sample);
  }
  return x.emission + direct / static_cast<double>(settings.shadowRays) +
         indirect / static_cast<double>(settings.gatherRays);
}

} // namespace vantage
