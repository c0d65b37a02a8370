#pragma once

#include "core/reference/ExactDirectLight.h"
#include "core/scene/Scene.h"
#include "core/visibility/OccluderScene.h"

#include <cstdint>
#include <optional>
#include <vector>

/// \file ReferenceGeometry.h
/// A scene as references see it. Nothing here knows transport/.

namespace vantage
{

/// How a surface answers at a point, on one side.
struct SurfacePlace
{
  Hit hit;
  Vec3 normal; ///< on that side
  Color albedo;
  Color emission;
};

struct ReferenceGeometry
{
  /// The scene must be valid and outlive this.
  explicit ReferenceGeometry(const Scene& scene);

  SurfacePlace PlaceOf(const Hit& hit) const;

  /// What rays from a place meet whose directions are distributed by the cosine, stratified.
  std::vector<std::optional<Hit>> Gather(
    const SurfacePlace& place, int rays, std::uint64_t seed) const;

  const Scene& scene;
  FacetSet facets;
  OccluderScene occluders;
  ExactDirectLight direct;
};

} // namespace vantage
