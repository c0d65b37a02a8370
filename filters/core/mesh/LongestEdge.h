#pragma once

#include "core/mesh/ElementTree.h"

#include <algorithm>

/// \file LongestEdge.h
/// What the least size of elements is measured by.

namespace vantage
{

/// Of a patch or an element, in units of the scene.
inline double LongestEdge(const Node& node)
{
  double longest = 0.0;
  for (int i = 0; i < node.cornerCount; ++i)
  {
    longest =
      std::max(longest, glm::length(node.corners[(i + 1) % node.cornerCount] - node.corners[i]));
  }
  return longest;
}

} // namespace vantage
