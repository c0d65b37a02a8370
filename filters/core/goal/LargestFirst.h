#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

/// \file LargestFirst.h
/// The few that have most of a sum.

namespace vantage
{

/// Puts those items first, in any order, that have the largest values and together `share` of the
/// sum over all of them; of equal ones those with smaller numbers. `values[item]` >= 0. Returns how
/// many they are. O(items), by selection instead of sorting.
std::size_t MoveLargestFirst(
  std::vector<std::uint32_t>& items, const std::vector<double>& values, double share);

} // namespace vantage
