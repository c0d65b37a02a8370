#pragma once

#include "core/mesh/Facets.h"

#include <vector>

/// \file ActivePatches.h
/// Which sides of facets exchange light.

namespace vantage
{

struct DarkSides;

/// Those that may.
enum class Sides
{
  Both,     ///< of two-sided materials; the front of others
  FrontOnly ///< that are the front of a polygon of the scene
};

/// For each patch whether it is one of them. O(n).
std::vector<bool> ActivePatches(
  const FacetSet& facets, const std::vector<Material>& materials, Sides sides = Sides::Both);

/// Without those that are dark.
std::vector<bool> ActivePatches(
  const FacetSet& facets, const std::vector<Material>& materials, const DarkSides& dark);

} // namespace vantage
