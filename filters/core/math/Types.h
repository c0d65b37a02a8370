#pragma once

#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

/// \file Types.h
/// The few types that everything is written in. Lengths are in scene units throughout.

namespace vantage
{

using Vec2 = glm::dvec2;
using Vec3 = glm::dvec3;

/// Three linear RGB channels: radiance, albedo, importance, flux.
using Color = glm::dvec3;

inline constexpr double Pi = 3.141592653589793238462643;

/// The one number that ranks a colour: the mean of its channels, so that no channel is favoured.
inline double Mean(const Color& c)
{
  return (c.x + c.y + c.z) / 3.0;
}

inline double MaxChannel(const Color& c)
{
  return c.x > c.y ? (c.x > c.z ? c.x : c.z) : (c.y > c.z ? c.y : c.z);
}

} // namespace vantage
