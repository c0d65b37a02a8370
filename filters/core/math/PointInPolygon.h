#pragma once

#include "core/math/Polygon.h"

/// \file PointInPolygon.h
/// Whether a place in the plane of a polygon is part of it.

namespace vantage
{

/// The border counts. \param normal of the polygon, of any length \pre place is in its plane
inline bool Contains(PolygonView shape, const Vec3& normal, const Vec3& place)
{
  for (int i = 0; i < shape.Size(); ++i)
  {
    const Vec3 along = shape[(i + 1) % shape.Size()] - shape[i];
    if (glm::dot(glm::cross(along, place - shape[i]), normal) < 0.0)
    {
      return false;
    }
  }
  return true;
}

} // namespace vantage
