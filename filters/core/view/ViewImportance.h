#pragma once

#include "core/mesh/ElementTree.h"
#include "core/scene/Camera.h"
#include "core/visibility/OccluderScene.h"

#include <cstdint>
#include <vector>

/// \file ViewImportance.h
/// What the camera sees: the importance that leaves the eye.

namespace vantage
{

/// A piece of the image that sees one point of one patch. The weights of the samples on an element,
/// summed and divided by its area, are its V: (1/A) integral over A of cos cos_eye / r^2 vis dA.
struct ViewSample
{
  PatchId patch;
  Vec3 point;
  double weight; ///< cos_eye d omega, sr
};

/// Casts about `rays` stratified rays through the image plane, uniformly over it; cos_eye is taken
/// against the line of sight, d omega = cos_eye^3 times the area at distance 1. Rays that meet
/// nothing, or the back of a one-sided facet, give no sample. O(rays log n), deterministic.
std::vector<ViewSample> SampleView(const OccluderScene& occluders, const ElementTree& tree,
  const Camera& camera, std::uint32_t rays, std::uint64_t seed);

} // namespace vantage
