#pragma once

#include "core/mesh/FacetEdges.h"

#include <vector>

/// \file ActivePatches.h
/// Which sides of facets exchange light.

namespace vantage
{

/// Those that may.
enum class Sides
{
  Both,      ///< of two-sided materials; the front of others
  FrontOnly, ///< that are the front of a polygon of the scene
  Lit        ///< as Both, without what is known to be dark (DarkSides.h)
};

/// For each patch whether it is one of them. `edges` of the facets. O(n), but for the dark ones.
std::vector<bool> ActivePatches(const FacetSet& facets, const std::vector<FacetEdge>& edges,
  const std::vector<Material>& materials, Sides sides);

} // namespace vantage
