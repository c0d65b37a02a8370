#pragma once

#include "core/mesh/ElementTree.h"
#include "core/scene/Camera.h"
#include "core/transport/ViewWeights.h"
#include "core/visibility/OccluderScene.h"

#include <cstdint>
#include <vector>

/// \file ViewImportance.h
/// What the camera sees: the importance that leaves the eye.

namespace vantage
{

/// Casts about `rays` (at least 1) rays, one through each cell of a grid of nearly square cells
/// over the image plane, at a place in the cell that is a hash of the seed; cos_eye is taken
/// against the line of sight, d omega = cos_eye^3 times the area at distance 1. Rays that meet
/// nothing, or an inactive patch (the back of a one-sided facet), give no sample.
/// From the bottom row of the image to the top. O(rays log n), deterministic.
std::vector<ViewSample> SampleView(const OccluderScene& occluders, const ElementTree& tree,
  const Camera& camera, std::uint32_t rays, std::uint64_t seed);

} // namespace vantage
