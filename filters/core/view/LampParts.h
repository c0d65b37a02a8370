#pragma once

#include "core/math/Polygon.h"

#include <cstdint>
#include <functional>
#include <vector>

/// \file LampParts.h
/// Recognises lamps that a modeller cut into facets.

namespace vantage
{

/// What a polygon is part of, named by the first polygon of each.
struct LampPart
{
  std::uint32_t whole;  ///< polygons that share edges, each with the next
  std::uint32_t convex; ///< of these, polygons of which none hides another
};

/// Finds what each of some polygons is part of. Those of a convex part lie behind each other's
/// planes, so from where the front of one is seen nothing of it is hidden by another. A globe, a
/// tube, a disc is one part each; of a ring it is the outer half, and of the inner half each
/// segment. Corners may stand out by LampSurface::LargestDent. Convex parts have 1024 polygons at
/// most. O(n * polygons of a part).
/// \param shapes counter-clockwise from the side that shines
/// \param areAlike whether two of them may be parts of one lamp
std::vector<LampPart> LampPartsOf(const std::vector<TriangleOrQuadrilateral>& shapes,
  const std::function<bool(std::uint32_t, std::uint32_t)>& areAlike);

} // namespace vantage
