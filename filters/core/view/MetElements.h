#pragma once

#include "core/transport/RadianceSolution.h"

#include <cstdint>
#include <vector>

/// \file MetElements.h
/// Where rays have been, as far as a sample of them tells.

namespace vantage
{

/// Whether rays meet the surroundings of an element about as often as most of what they meet:
/// `hits` are how many of a sample of them each element has got. Neighbours are pooled up the tree
/// until there are enough hits to tell how densely they lie, so that it does not depend on how
/// finely a surface has been cut. Those in a pool with less than a hundredth of the median density
/// are not met often: what is seen through a slit. O(elements).
std::vector<bool> FindMetOften(
  const RadianceSolution& solution, const std::vector<std::uint32_t>& hits);

} // namespace vantage
