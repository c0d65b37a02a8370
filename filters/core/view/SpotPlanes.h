#pragma once

#include "core/view/IndirectLight.h"
#include "core/view/IndirectSurface.h"

#include <vector>

/// \file SpotPlanes.h
/// Which points share a plane.

namespace vantage
{

/// The spots of each plane. Patches that lie in one plane, face the same way and touch are one
/// plane, since what falls onto them is continuous. The walls that stand on a plane come with it.
/// \param mostSpots of a cell to start with; each plane starts with some cells at least
/// O(spots + n log n) for n patches.
std::vector<IndirectSurface> SurfacesOf(
  const OccluderScene& occluders, const std::vector<IndirectSpot>& spots, std::size_t mostSpots);

} // namespace vantage
