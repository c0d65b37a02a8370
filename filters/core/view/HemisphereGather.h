#pragma once

#include "core/math/Sampling.h"
#include "core/view/BrightSpots.h"
#include "core/view/LitSurfaces.h"

#include <cstdint>
#include <optional>

/// \file HemisphereGather.h
/// Indirect light at a point, by rays.

namespace vantage
{

/// What a ray has met.
struct SeenLight
{
  LitRadiance radiance;
  double weight; ///< of it in the irradiance, sr
  /// The same in an estimate by the first half of the rays alone.
  double weightInHalf;
};

/// Rays from a point of a surface into the hemisphere above. The sum of weight times radiance over
/// all of them is the irradiance from all that reflects light there, without bias. What they meet
/// does not emit here, since lamps are counted one by one.
///
/// Most or all of them are distributed by the cosine, and some drawn by bright spots, where these
/// are worth it; either kind comes from a scrambled Sobol sequence, and both are combined by the
/// balance heuristic (Veach, Guibas 1995). Of rays to spots only those count that meet what they
/// were drawn for: so there is one way to draw what one of them brings, besides by the cosine.
///
/// Refers to occluders and surfaces, which must outlive it.
class HemisphereRays
{
public:
  /// \param patch that the point lies on, active
  /// \param rays >= 1; a power of two is spread best
  HemisphereRays(const OccluderScene& occluders, const LitSurfaces& surfaces, PatchId patch,
    const Vec3& point, LitBy litBy, std::uint32_t rays, std::uint64_t seed);

  /// Nothing, if the ray meets nothing or does not count; an inactive side is black. Adds to
  /// `shadowRays` what it traces. \param ray below their number
  std::optional<SeenLight> Cast(std::uint32_t ray, std::uint64_t& shadowRays) const;

private:
  std::optional<SeenLight> CastAround(std::uint32_t index, std::uint64_t& shadowRays) const;
  std::optional<SeenLight> CastToSpot(std::uint32_t index, std::uint64_t& shadowRays) const;
  double WeightOf(const LitRadiance& radiance, const Vec3& place) const;

  const OccluderScene* Occluders;
  const LitSurfaces* Surfaces;
  PatchId Patch;
  Vec3 Point;
  Frame Axes;
  LitBy By;
  std::uint64_t Seed;
  SpotDirections Spots;
  std::uint32_t ToSpots; ///< how many rays
  std::uint32_t Around;
};

struct HemisphereEstimate
{
  Color irradiance{ 0.0 }; ///< W m^-2
  double noise = 0.0;      ///< guess at the standard error, mean of channels; see below
  std::uint64_t shadowRays = 0;
};

/// Irradiance at a point by so many HemisphereRays, lit by texels where there are any. The two
/// halves of a sequence are good estimates by themselves; the noise is guessed from their
/// difference, so it means something only in the mean over many points. O(rays log n).
HemisphereEstimate GatherHemisphere(const OccluderScene& occluders, const LitSurfaces& surfaces,
  PatchId patch, const Vec3& point, std::uint32_t rays, std::uint64_t seed);

} // namespace vantage
