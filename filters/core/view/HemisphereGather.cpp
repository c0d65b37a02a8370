#include "core/view/HemisphereGather.h"

#include "core/math/ScrambledSobol.h"

namespace vantage
{

namespace
{

/// Errors of the whole sequence over half the difference of its halves, both root mean square, as
/// measured in furnished rooms with 32 .. 512 rays: independent halves would give 1, but those of a
/// Sobol sequence complete each other.
constexpr double NoiseOfWhole = 0.8;

/// Of ray `index` out of `count`, in an estimate by the first half of them alone.
double InHalf(double weight, std::uint32_t index, std::uint32_t count)
{
  const std::uint32_t half = count / 2;
  return index < half ? weight * count / half : 0.0;
}

} // namespace

HemisphereRays::HemisphereRays(const OccluderScene& occluders, const LitSurfaces& surfaces,
  PatchId patch, const Vec3& point, LitBy litBy, std::uint32_t rays, std::uint64_t seed)
  : Occluders(&occluders)
  , Surfaces(&surfaces)
  , Patch(patch)
  , Point(point)
  , Axes(NormalOf(occluders, patch))
  , By(litBy)
  , Seed(seed)
  , Spots(surfaces.Spots(), point, this->Axes.z)
  , ToSpots(this->Spots.PartOf(rays))
  , Around(rays - this->ToSpots)
{
}

std::optional<SeenLight> HemisphereRays::Cast(std::uint32_t ray, std::uint64_t& shadowRays) const
{
  return ray < this->Around ? this->CastAround(ray, shadowRays)
                            : this->CastToSpot(ray - this->Around, shadowRays);
}

std::optional<SeenLight> HemisphereRays::CastAround(
  std::uint32_t index, std::uint64_t& shadowRays) const
{
  const Vec3 direction = this->Axes.ToWorld(CosineHemisphere(ScrambledSobol(index, this->Seed)));
  const auto hit = this->Occluders->Intersect(this->Point, direction, this->Patch / 2);
  if (!hit)
  {
    return {};
  }
  const LitRadiance radiance =
    this->Surfaces->Radiance(*hit, this->By, index, Hash(this->Seed, 1), shadowRays);
  const double weight = this->WeightOf(radiance, hit->point);
  return SeenLight{ radiance, weight, InHalf(weight, index, this->Around) };
}

std::optional<SeenLight> HemisphereRays::CastToSpot(
  std::uint32_t index, std::uint64_t& shadowRays) const
{
  const SpotDirections::Target target =
    this->Spots.Draw(ScrambledSobol(index, Hash(this->Seed, 2)));
  const auto hit =
    this->Occluders->Intersect(this->Point, target.place - this->Point, this->Patch / 2);
  if (!hit)
  {
    return {};
  }
  const LitRadiance radiance =
    this->Surfaces->Radiance(*hit, this->By, index, Hash(this->Seed, 3), shadowRays);
  if (radiance.texel != target.texel)
  {
    return {};
  }
  const double weight = this->WeightOf(radiance, hit->point);
  return SeenLight{ radiance, weight, InHalf(weight, index, this->ToSpots) };
}

/// Cosine over the density of the direction, over all rays of either kind.
double HemisphereRays::WeightOf(const LitRadiance& radiance, const Vec3& place) const
{
  if (this->ToSpots == 0)
  {
    return Pi / this->Around;
  }
  const Vec3 way = place - this->Point;
  const double cosine = glm::dot(this->Axes.z, way) / glm::length(way);
  const double density =
    this->Around * cosine / Pi +
    this->ToSpots * this->Spots.Density(radiance.texel, radiance.within, place);
  return cosine > 0.0 ? cosine / density : 0.0;
}

HemisphereEstimate GatherHemisphere(const OccluderScene& occluders, const LitSurfaces& surfaces,
  PatchId patch, const Vec3& point, std::uint32_t rays, std::uint64_t seed)
{
  const HemisphereRays all(occluders, surfaces, patch, point, LitBy::Texels, rays, seed);
  HemisphereEstimate estimate;
  Color byHalf(0.0);
  for (std::uint32_t ray = 0; ray < rays; ++ray)
  {
    if (const auto seen = all.Cast(ray, estimate.shadowRays))
    {
      const Color radiance = seen->radiance.direct + seen->radiance.indirect;
      estimate.irradiance += seen->weight * radiance;
      byHalf += seen->weightInHalf * radiance;
    }
  }
  // Half the difference of the halves is the difference between one of them and the whole.
  estimate.noise = NoiseOfWhole * Mean(glm::abs(byHalf - estimate.irradiance));
  return estimate;
}

} // namespace vantage
