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

} // namespace

HemisphereEstimate GatherHemisphere(const OccluderScene& occluders, const LitSurfaces& surfaces,
  PatchId patch, const Vec3& point, const Vec3& normal, std::uint32_t rays, std::uint64_t seed)
{
  const Frame frame(normal);
  const std::uint32_t facet = patch / 2;
  const std::uint32_t half = rays / 2;
  HemisphereEstimate estimate;
  Color sum(0.0);
  Color sumOfHalf(0.0);
  for (std::uint32_t i = 0; i < rays; ++i)
  {
    const Vec3 direction = frame.ToWorld(CosineHemisphere(ScrambledSobol(i, seed)));
    if (const auto hit = occluders.Intersect(point, direction, facet))
    {
      const LitRadiance radiance = surfaces.Radiance(*hit, i, Hash(seed, 1), estimate.shadowRays);
      sum += radiance.direct + radiance.indirect;
    }
    if (i + 1 == half)
    {
      sumOfHalf = sum;
    }
  }
  estimate.irradiance = sum * (Pi / rays);
  // Half the difference of the halves is the difference between one of them and the whole.
  estimate.noise = half > 0
                     ? NoiseOfWhole * Mean(glm::abs(sumOfHalf * (Pi / half) - estimate.irradiance))
                     : Mean(estimate.irradiance);
  return estimate;
}

} // namespace vantage
