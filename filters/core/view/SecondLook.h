#pragma once

#include "core/view/LitSurfaces.h"

#include <cstdint>
#include <vector>

/// \file SecondLook.h
/// One more reflection before the solution is looked up.

namespace vantage
{

/// What a look has cost.
struct SecondLookCounts
{
  std::uint64_t rays = 0;
  std::uint64_t shadowRays = 0;
};

/// Betters the indirect light of the elements that a gather meets: replaces what the solution says
/// by the mean over the points that were met, from each of which `raysOfHit` rays look at the lit
/// surfaces around. Elements take light as means over links, which is too little where both are
/// uneven; here only what those surfaces have got by further reflections comes from elements.
/// Where few hits tell of an element, the solution keeps its say. Elements that nothing met stay.
/// Parallel over hits, the same for any number of threads.
SecondLookCounts LookAgain(const OccluderScene& occluders, const RadianceSolution& solution,
  const std::vector<Hit>& hits, std::uint32_t raysOfHit, std::uint64_t seed, LitSurfaces& surfaces);

} // namespace vantage
