#pragma once

#include "core/mesh/Facets.h"
#include "core/mesh/PackedLists.h"

#include <cstdint>
#include <vector>

/// \file Neighbourhood.h
/// Which facets are near which.

namespace vantage
{

/// For each facet the others whose bounding boxes come closer to its own than the tolerance, in
/// ascending order. O(n log n + their number).
PackedLists<std::uint32_t> NeighboursOf(const std::vector<Facet>& facets, double tolerance);

} // namespace vantage
