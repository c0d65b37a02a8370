#pragma once

#include "core/mesh/ElementTree.h"

/// \file KernelVariation.h
/// How unlike the points of two ends are to each other.

namespace vantage
{

/// How much the kernel cos cos / r^2 varies over both ends, roughly, relative to its mean: their
/// sizes over their distance, at most 1.
inline double KernelVariation(const Node& a, const Node& b)
{
  const double distance = glm::length(a.centre - b.centre);
  const double size = a.radius + b.radius;
  return size < distance ? size / distance : 1.0;
}

} // namespace vantage
