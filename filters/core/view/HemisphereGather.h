#pragma once

#include "core/math/ScrambledSobol.h"
#include "core/view/LitSurfaces.h"

#include <cstdint>
#include <vector>

/// \file HemisphereGather.h
/// Indirect light at a point, by rays.

namespace vantage
{

/// Calls visit(index, LitRadiance) for each of `rays` directions of a scrambled Sobol sequence,
/// distributed by the cosine, that meets something. Returns the shadow rays that it took.
template <typename Visit>
std::uint64_t ForEachSeen(const OccluderScene& occluders, const LitSurfaces& surfaces,
  PatchId patch, const Vec3& point, const Vec3& normal, std::uint32_t rays, std::uint64_t seed,
  const Visit& visit)
{
  const Frame frame(normal);
  std::uint64_t shadowRays = 0;
  for (std::uint32_t i = 0; i < rays; ++i)
  {
    const Vec3 direction = frame.ToWorld(CosineHemisphere(ScrambledSobol(i, seed)));
    if (const auto hit = occluders.Intersect(point, direction, patch / 2))
    {
      visit(i, surfaces.Radiance(*hit, i, Hash(seed, 1), shadowRays));
    }
  }
  return shadowRays;
}

struct HemisphereEstimate
{
  Color irradiance{ 0.0 }; ///< W m^-2
  double noise = 0.0;      ///< guess at the standard error, mean of channels; see below
  std::uint64_t shadowRays = 0;
};

/// Irradiance at a point from the reflected radiance of all that it sees (LitSurfaces.h). What the
/// rays hit does not emit here, since lamps are counted one by one. A ray that meets nothing or an
/// inactive side brings nothing. The two halves of the sequence are good estimates by themselves;
/// the noise is guessed from their difference, so it means something only in the mean over many
/// points. Unbiased over the seeds. O(rays log n).
///
/// \param patch that the point lies on, active
/// \param normal of the patch, unit
/// \param rays >= 1; a power of two is spread best
HemisphereEstimate GatherHemisphere(const OccluderScene& occluders, const LitSurfaces& surfaces,
  PatchId patch, const Vec3& point, const Vec3& normal, std::uint32_t rays, std::uint64_t seed);

} // namespace vantage
