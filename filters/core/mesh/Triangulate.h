#pragma once

#include "core/math/Types.h"

#include <array>
#include <vector>

/// \file Triangulate.h
/// Triangles of a plane polygon.

namespace vantage
{

/// The triangles of a simple polygon, counter-clockwise, that may be concave, touch itself or be
/// bridged to its holes: ear clipping (Meisters 1975), the best-shaped ear first. A polygon that
/// cuts itself gives some triangles that cover it roughly. Triangles without area are left out.
/// O(n^2). \pre three corners or more
std::vector<std::array<int, 3>> Triangulate(const std::vector<Vec2>& corners);

} // namespace vantage
