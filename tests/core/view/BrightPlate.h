#pragma once

#include "core/math/Sampling.h"
#include "core/view/GatherStage.h"
#include "core/view/LitSurfaces.h"

#include <vector>

/// \file BrightPlate.h
/// A room that glows faintly, with a small plate in it whose upper side is bright.

namespace vantage::test
{

/// All sides of the room have the radiance 1, and so has what stands in it; the plate has `bright`.
class BrightPlate
{
public:
  static constexpr double Height = 0.3;

  explicit BrightPlate(const std::vector<Vec3>& plate, double bright = 200.0,
    const std::vector<std::vector<Vec3>>& others = {})
    : Bright(bright)
    , Stage(MakeScene(plate, others), [](PatchId) { return Color(1.0); })
    , Lit(Stage.occluders, Stage.solution)
  {
    for (PatchId p = 0; p < this->Stage.tree.Patches().size(); ++p)
    {
      const Vec3 centre = Centroid(this->Stage.facets.facets[p / 2].shape);
      if (centre.z == Height && this->Stage.Normal(p).z > 0.5)
      {
        this->Patch = p;
      }
      if (centre.z == 2.0 && this->Stage.Normal(p).z < -0.5)
      {
        this->Ceiling = p;
      }
    }
    RadianceSolution::Element& element =
      this->Stage.solution.elements[this->Stage.solution.elementOfPatch[this->Patch]];
    element.indirect = Color(bright);
    element.reflected = Color(bright);
    this->Lit = LitSurfaces(this->Stage.occluders, this->Stage.solution);
  }

  static std::vector<Vec3> Square()
  {
    return { { 0.9, 0.9, Height }, { 1.1, 0.9, Height }, { 1.1, 1.1, Height },
      { 0.9, 1.1, Height } };
  }

  double Bright;
  GatherStage Stage;
  LitSurfaces Lit;
  PatchId Patch = None;   ///< upper side of the plate
  PatchId Ceiling = None; ///< lower side of the ceiling, z = 2

  /// Rays from all over the ceiling.
  std::vector<Hit> Sample(int rays, std::uint64_t seed) const
  {
    const Frame down(Vec3(0, 0, -1));
    RandomStream random(seed);
    std::vector<Hit> hits;
    for (int i = 0; i < rays; ++i)
    {
      const Vec2 place = 2.0 * random.Next2();
      const Vec3 way = down.ToWorld(CosineHemisphere(random.Next2()));
      if (const auto hit =
            this->Stage.occluders.Intersect(Vec3(place, 2.0), way, this->Ceiling / 2))
      {
        hits.push_back(*hit);
      }
    }
    return hits;
  }

  RayOrigins Origins(double rays) const
  {
    RayOrigins origins;
    origins.rays = rays;
    for (int i = 0; i < 100; ++i)
    {
      origins.places.push_back(
        { Vec3(0.1 + 0.2 * (i % 10), 0.1 + 0.2 * (i / 10), 2.0), Vec3(0, 0, -1) });
    }
    return origins;
  }

  /// Makes texels and finds the spots.
  void Light(int rays, std::uint64_t seed)
  {
    this->Lit.LightSample(this->Sample(rays, seed), this->Origins(rays), seed);
  }

private:
  static Scene MakeScene(
    const std::vector<Vec3>& plate, const std::vector<std::vector<Vec3>>& others)
  {
    Scene scene;
    const std::uint32_t grey = AddMaterial(scene, Color(0.5));
    AddRoom(scene, { 0, 0, 0 }, { 2, 2, 2 }, grey);
    // Next to nothing, but where there are lamps, texels are small.
    scene.AddPolygon({ { 0.01, 0.01, 0.02 }, { 0.02, 0.01, 0.02 }, { 0.02, 0.02, 0.02 } },
      AddMaterial(scene, Color(0.0), Color(1e-9), false));
    scene.AddPolygon(plate, grey);
    for (const std::vector<Vec3>& other : others)
    {
      scene.AddPolygon(other, grey);
    }
    return scene;
  }
};

} // namespace vantage::test
