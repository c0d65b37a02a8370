#pragma once

#include "core/view/IndirectLight.h"
#include "core/view/IndirectSurface.h"

#include <vector>

/// \file SpotPlanes.h
/// Which points share a plane, or a curved surface.

namespace vantage
{

/// The spots of each plane. Patches that lie in one plane, face the same way and touch are one
/// plane, since what falls onto them is continuous. The walls that stand on a plane come with it.
/// Planes with few spots that share an edge and turn by little there are one surface, as the facets
/// of a ball are, as far as they are seen from the plane of one of them: that they are flat, each
/// of them, is lost then, and what it matters shows as a surprise.
/// \param mostSpots of a cell to start with; each plane starts with some cells at least
/// O(spots + n log n) for n patches.
std::vector<IndirectSurface> SurfacesOf(
  const OccluderScene& occluders, const std::vector<IndirectSpot>& spots, std::size_t mostSpots);

} // namespace vantage
