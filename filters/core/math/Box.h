#pragma once

#include "core/math/Polygon.h"

/// \file Box.h
/// An axis-aligned box.

namespace vantage
{

/// The smallest box around a polygon. \pre the polygon has a corner
struct Box
{
  Vec3 low, high;

  explicit Box(PolygonView p)
    : low(p[0])
    , high(p[0])
  {
    for (const Vec3& v : p)
    {
      this->low = glm::min(this->low, v);
      this->high = glm::max(this->high, v);
    }
  }
  bool Touches(const Box& other, double tolerance) const
  {
    return glm::all(glm::lessThanEqual(this->low, other.high + tolerance)) &&
           glm::all(glm::lessThanEqual(other.low, this->high + tolerance));
  }
};

} // namespace vantage
