#pragma once

#include "core/transport/RadianceSolution.h"
#include "core/view/ViewGather.h"

#include <functional>
#include <vector>

/// \file GatherStage.h
/// Scenes whose light is given, not solved.

namespace vantage::test
{

/// A scene and all that a gather needs, with one element a patch that names all lamps there are.
struct GatherStage
{
  Scene scene;
  FacetSet facets;
  OccluderScene occluders;
  ElementTree tree;
  RadianceSolution solution;

  /// \param indirect radiance of a patch, without its emission and without what it reflects of the
  /// lamps
  GatherStage(const Scene& givenScene, const std::function<Color(PatchId)>& indirect)
    : scene(givenScene)
    , facets(BuildFacets(this->scene))
    , occluders(this->facets)
    , tree(this->facets, this->scene.materials)
  {
    const std::vector<PatchOptics> optics = this->Optics();
    this->solution.SetPatches(optics);
    for (PatchId p = 0; p < optics.size(); ++p)
    {
      if (this->tree.Patches()[p].IsActive() && MaxChannel(optics[p].emission) > 0.0)
      {
        this->solution.lamps.push_back(p);
      }
    }
    for (PatchId p = 0; p < optics.size(); ++p)
    {
      if (this->tree.Patches()[p].IsActive())
      {
        RadianceSolution::Element element;
        element.node = this->tree.Patches()[p].node;
        element.area = this->tree[element.node].area;
        element.indirect = indirect(p);
        element.lastLamp = static_cast<std::uint32_t>(this->solution.lamps.size());
        this->solution.elementOfPatch[p] =
          static_cast<std::uint32_t>(this->solution.elements.size());
        this->solution.elements.push_back(element);
      }
    }
  }

  std::vector<PatchOptics> Optics() const
  {
    std::vector<PatchOptics> optics(2 * this->facets.facets.size());
    for (PatchId p = 0; p < optics.size(); ++p)
    {
      const Facet& facet = this->facets.facets[p / 2];
      const Side side = p % 2 == 0 ? Side::Front : Side::Back;
      const Material& material = this->scene.materials[facet.MaterialOf(side)];
      optics[p].albedo = material.albedo;
      optics[p].emission = facet.IsPolygonFront(side) ? material.emission : Color(0.0);
    }
    return optics;
  }

  Vec3 Normal(PatchId patch) const { return this->tree.Patches()[patch].normal; }

  /// What the centre of a pixel sees.
  std::optional<Hit> Centre(const Camera& camera, int width, int height, int x, int y) const
  {
    const ImagePlane plane(camera);
    return this->occluders.Intersect(
      plane.eye, plane.Direction(2.0 * (x + 0.5) / width - 1.0, 2.0 * (y + 0.5) / height - 1.0));
  }

  GatheredView Gather(const Camera& camera, const GatherSettings& settings) const
  {
    return GatherView(this->occluders, this->solution, camera, settings);
  }
};

inline GatherSettings Pixels(int width, int height, bool centres, double error = 0.01)
{
  GatherSettings settings;
  settings.width = width;
  settings.height = height;
  settings.pixelCentres = centres;
  settings.error = error;
  return settings;
}

inline std::uint32_t AddMaterial(
  Scene& scene, const Color& albedo, const Color& emission = Color(0.0), bool twoSided = true)
{
  Material material;
  material.albedo = albedo;
  material.emission = emission;
  material.twoSided = twoSided;
  scene.materials.push_back(material);
  return static_cast<std::uint32_t>(scene.materials.size() - 1);
}

/// An axis-aligned box, fronts towards the inside.
inline void AddRoom(Scene& scene, const Vec3& a, const Vec3& b, std::uint32_t material)
{
  const auto add = [&](const std::vector<Vec3>& points) { scene.AddPolygon(points, material); };
  add({ { a.x, a.y, a.z }, { b.x, a.y, a.z }, { b.x, b.y, a.z }, { a.x, b.y, a.z } });
  add({ { a.x, a.y, b.z }, { a.x, b.y, b.z }, { b.x, b.y, b.z }, { b.x, a.y, b.z } });
  add({ { a.x, a.y, a.z }, { a.x, a.y, b.z }, { b.x, a.y, b.z }, { b.x, a.y, a.z } });
  add({ { a.x, b.y, a.z }, { b.x, b.y, a.z }, { b.x, b.y, b.z }, { a.x, b.y, b.z } });
  add({ { a.x, a.y, a.z }, { a.x, b.y, a.z }, { a.x, b.y, b.z }, { a.x, a.y, b.z } });
  add({ { b.x, a.y, a.z }, { b.x, a.y, b.z }, { b.x, b.y, b.z }, { b.x, b.y, a.z } });
}

inline Camera CameraAt(
  const Vec3& eye, const Vec3& target, double fieldOfView, const Vec3& up = { 0.0, 0.0, 1.0 })
{
  Camera camera;
  camera.eye = eye;
  camera.lookAt = target;
  camera.up = up;
  camera.fieldOfView = fieldOfView;
  return camera;
}

} // namespace vantage::test
