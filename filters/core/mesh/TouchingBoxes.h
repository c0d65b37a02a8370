#pragma once

#include "core/math/Box.h"

#include <cstdint>
#include <functional>
#include <vector>

/// \file TouchingBoxes.h
/// Which boxes are near which.

namespace vantage
{

/// Calls visit(a, b) once for each two boxes that come closer to each other than the tolerance, in
/// an order that depends on the boxes alone. O(n log n + pairs), whatever sizes they have: a tree
/// of boxes is joined with itself.
void ForEachTouchingPair(const std::vector<Box>& boxes, double tolerance,
  const std::function<void(std::uint32_t, std::uint32_t)>& visit);

} // namespace vantage
