#pragma once

#include "core/mesh/Bounds.h"
#include "core/mesh/ElementTree.h"

#include <vector>

/// \file DarkSides.h
/// The insides of closed bodies: what no light can reach.

namespace vantage
{

/// Patches that are known to be dark: those of shells (Shells.h) that enclose air without a lamp in
/// there.
struct DarkSides
{
  std::vector<std::uint32_t> bodyOf; ///< of each patch: the body that it is inside of, or None
  std::vector<Bounds> bodies;        ///< the box around each

  bool operator[](PatchId patch) const { return this->bodyOf[patch] != None; }
};

/// The insides of furniture, of columns and of solid walls, as modellers draw them. None is dark in
/// a scene where nothing emits.
///
/// What counts as a lamp in there: a side of the shell that emits, a lamp around which the shell
/// winds (the signed solid angle of all its sides, over 4 pi), and one that may stick through it.
/// Shells that wind around some of their own sides in another sense than around others, as broken
/// models do, are not dark; some sides of each are looked at.
/// O(n log n); a lamp whose bounding box meets that of a shell costs as much as that has sides, up
/// to some millions in all, and then the shell is not dark.
DarkSides FindDarkSides(const FacetSet& facets, const std::vector<Material>& materials);

} // namespace vantage
