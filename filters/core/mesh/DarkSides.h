#pragma once

#include "core/mesh/ElementTree.h"
#include "core/mesh/FacetEdges.h"

#include <vector>

/// \file DarkSides.h
/// The insides of closed bodies: what no light can reach.

namespace vantage
{

/// For each patch whether it is known to be dark: it belongs to a shell (Shells.h) that encloses
/// air, and there is no lamp in there. So are the insides of furniture, of columns and of solid
/// walls, as modellers draw them. None is dark in a scene where nothing emits.
///
/// What counts as a lamp in there: a side of the shell that emits, a lamp around which the shell
/// winds (the signed solid angle of all its sides, over 4 pi), and one that may stick through it.
/// Shells that wind around some of their own sides in another sense than around others, as broken
/// models do, are not dark; some sides of each are looked at. `edges` of the facets.
/// O(n log n); a lamp whose bounding box meets that of a shell costs as much as that has sides.
std::vector<bool> DarkSides(const FacetSet& facets, const std::vector<FacetEdge>& edges,
  const std::vector<Material>& materials);

} // namespace vantage
