#pragma once

#include "core/view/LitSurfaces.h"

#include <cstdint>
#include <vector>

/// \file SecondLook.h
/// One more reflection before the solution is looked up.

namespace vantage
{

/// What a look has cost, and what it said.
struct SecondLook
{
  std::uint64_t rays = 0;
  std::uint64_t shadowRays = 0;
  /// Indirect radiance, over that of the solution: what agrees with itself in the mean.
  double correction = 1.0;
};

/// Betters the indirect light of the elements that a gather meets, by rays: from each point that
/// was met, `raysOfHit` look at the lit surfaces around. Elements take light as means over links,
/// which is too little where both are uneven. So,
///
/// - What an element has is replaced by what the rays from its points found; only what those
///   surfaces have got by further reflections comes from elements. Where few hits tell of an
///   element, the solution keeps its say. Elements that nothing met stay.
/// - The indirect light I of the solution should be D + R I, what is reflected of the lamps' and of
///   itself. In the mean over all rays that says by which factor s it errs, s I = D + R s I; all
///   indirect light is multiplied by that, as far as it is more than noise.
///
/// Parallel over hits, the same for any number of threads.
SecondLook LookAgain(const OccluderScene& occluders, const RadianceSolution& solution,
  const std::vector<Hit>& hits, std::uint32_t raysOfHit, std::uint64_t seed, LitSurfaces& surfaces);

} // namespace vantage
