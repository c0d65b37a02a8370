#pragma once

#include "core/mesh/Facets.h"
#include "core/scene/Scene.h"
#include "core/visibility/OccluderScene.h"

#include <vector>

/// \file ExactDirectLight.h
/// Direct light without sampling.

namespace vantage
{

/// Irradiance from the emitters: what a point sees of each of them, cut out past all occluders in
/// between, in closed form. Knows nothing of transport/. Keeps references; safe to use from many
/// threads.
class ExactDirectLight
{
public:
  /// The scene must be valid; `facets` are its facets and `occluders` are made of them.
  ExactDirectLight(const Scene& scene, const FacetSet& facets, const OccluderScene& occluders);

  /// Irradiance over pi at a point of a facet on the side of the given normal: times the albedo it
  /// is the radiance reflected. O(emitters), one ray each for those that one facet hides alone;
  /// for the others exponential in the number of occluders whose shadows overlap at the point.
  Color At(const Hit& hit, const Vec3& normal) const;

private:
  struct Lamp
  {
    Polygon shape; ///< counter-clockwise seen from where it shines
    Plane plane;   ///< of the shape
    Color emission;
    std::uint32_t facet;
  };

  struct Sight;

  double SeenOf(const Lamp& lamp, const Hit& hit, const Vec3& normal) const;
  bool IsHiddenByOne(const Lamp& lamp, const Hit& hit, const Sight& sight) const;

  const OccluderScene* Occluders;
  std::vector<Lamp> Lamps;
};

} // namespace vantage
