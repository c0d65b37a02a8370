#pragma once

#include "core/view/GatherStage.h"

#include <cmath>

/// \file LampsOverFloor.h
/// A floor below lamps that reflects what is given, and what rays meet there.

namespace vantage::test
{

inline const Color Albedo(0.6, 0.5, 0.4);
inline const Color Emission(9.0, 8.0, 7.0);
inline const Color Reflected(0.3, 0.2, 0.1);

/// A horizontal square about a centre, facing down unless its edge is negative.
inline void AddSquare(Scene& scene, const Vec3& centre, double edge, std::uint32_t material)
{
  const double x = 0.5 * std::abs(edge);
  const double y = -0.5 * edge;
  scene.AddPolygon({ centre + Vec3(-x, -y, 0.0), centre + Vec3(x, -y, 0.0),
                     centre + Vec3(x, y, 0.0), centre + Vec3(-x, y, 0.0) },
    material);
}

/// A floor (facet 0, its upper side patch 0) below lamps in a row, the first above the origin.
inline Scene MakeFloorBelowLamps(int lamps)
{
  Scene scene;
  const std::uint32_t grey = AddMaterial(scene, Albedo, Color(0.0), false);
  const std::uint32_t lamp = AddMaterial(scene, Color(0.5), Emission, false);
  AddSquare(scene, Vec3(0.0), -8.0, grey);
  for (int i = 0; i < lamps; ++i)
  {
    AddSquare(scene, Vec3(0.4 * i, 0.0, 1.0), 0.3, lamp);
  }
  return scene;
}

inline Color AllButEmission(PatchId)
{
  return Reflected;
}

/// What a ray meets.
inline Hit Met(const GatherStage& stage, const Vec3& from, const Vec3& direction)
{
  return stage.occluders.Intersect(from, direction).value();
}

/// The point of the floor at the origin, seen from above.
inline Hit FloorHit(const GatherStage& stage)
{
  return Met(stage, Vec3(0.0, 0.0, 0.1), Vec3(0.0, 0.0, -1.0));
}

inline RadianceSolution::Element& ElementOf(GatherStage& stage, const Hit& hit)
{
  return stage.solution.elements[stage.solution.elementOfPatch[hit.Patch()]];
}

} // namespace vantage::test
