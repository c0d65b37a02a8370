#pragma once

#include "core/math/Types.h"

#include <cstdint>
#include <vector>

/// \file Weld.h
/// One vertex where several lie in one place.

namespace vantage
{

/// Distinct points, and which of them each of the welded positions is.
struct WeldedPoints
{
  std::vector<Vec3> points;           ///< sorted by x, then y, then z
  std::vector<std::uint32_t> indices; ///< of a point, one for each position
  std::size_t moved = 0;              ///< positions, each counted once, that were not kept
};

/// Welds positions that are linked by steps of at most `tolerance` (>= 0, in scene units) into the
/// first of them by x, y, z. The result does not depend on the order of the positions.
/// \pre no coordinate is -0
/// O(n log n) while only a few distinct positions lie within one tolerance.
WeldedPoints Weld(const std::vector<Vec3>& positions, double tolerance);

} // namespace vantage
