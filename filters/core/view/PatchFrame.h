#pragma once

#include "core/math/Polygon.h"

/// \file PatchFrame.h
/// A patch's own coordinates.

namespace vantage
{

/// Coordinates in the plane of a polygon: x along its first edge, z its normal, the origin at its
/// first corner. They move with the polygon.
struct PatchFrame
{
  Vec3 origin, x, y, z;

  explicit PatchFrame(const Polygon& shape)
    : origin(shape[0])
    , x(glm::normalize(shape[1] - shape[0]))
    , z(UnitNormal(shape))
  {
    this->y = glm::cross(this->z, this->x);
  }

  Vec2 InPlane(const Vec3& point) const
  {
    const Vec3 d = point - this->origin;
    return { glm::dot(d, this->x), glm::dot(d, this->y) };
  }
  Vec3 ToLocal(const Vec3& point) const
  {
    const Vec3 d = point - this->origin;
    return { glm::dot(d, this->x), glm::dot(d, this->y), glm::dot(d, this->z) };
  }
  Vec3 ToWorld(const Vec3& local) const
  {
    return this->origin + local.x * this->x + local.y * this->y + local.z * this->z;
  }
};

} // namespace vantage
