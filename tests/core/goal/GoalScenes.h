#pragma once

#include "core/goal/OpenTree.h"
#include "core/math/Sampling.h"
#include "core/view/ViewImportance.h"
#include "support/TestScenes.h"

#include <cmath>
#include <vector>

/// \file GoalScenes.h
/// What the tests of the goal-oriented layer work on: a scene, made ready for it.

namespace vantage::test
{

/// Optics of both sides of each facet; only fronts emit.
inline std::vector<PatchOptics> OpticsOf(const Scene& scene, const FacetSet& facets)
{
  std::vector<PatchOptics> optics(2 * facets.facets.size());
  for (std::uint32_t f = 0; f < facets.facets.size(); ++f)
  {
    for (const Side side : { Side::Front, Side::Back })
    {
      const Facet& facet = facets.facets[f];
      const Material& material = scene.materials[facet.MaterialOf(side)];
      optics[PatchOf(f, side)] = { material.albedo,
        facet.IsPolygonFront(side) ? material.emission : Color(0.0) };
    }
  }
  return optics;
}

struct Stage
{
  explicit Stage(const Scene& theScene)
    : scene(theScene)
    , facets(BuildFacets(scene))
    , occluders(facets)
    , optics(OpticsOf(scene, facets))
  {
  }

  ElementTree MakeTree() const { return ElementTree(facets, scene.materials); }
  OpenTree MakeOpenTree() const { return OpenTree(this->MakeTree(), occluders, optics); }

  /// What the first camera of the scene sees.
  std::vector<ViewSample> View(std::uint32_t rays = 4096) const
  {
    return SampleView(occluders, this->MakeTree(), scene.cameras[0], rays, 1);
  }

  Scene scene;
  FacetSet facets;
  OccluderScene occluders;
  std::vector<PatchOptics> optics;
};

/// Opens all clusters, and patches and elements above a level.
inline void OpenTo(OpenTree& tree, int level)
{
  for (OpenId id = 0; id < tree.Size(); ++id)
  {
    if (tree[id].IsCluster() || tree[id].level < level)
    {
      tree.Open(id);
    }
  }
}

inline std::vector<OpenId> LeavesOf(const OpenTree& tree)
{
  std::vector<OpenId> leaves;
  for (OpenId id = 0; id < tree.Size(); ++id)
  {
    if (tree[id].IsLeaf())
    {
      leaves.push_back(id);
    }
  }
  return leaves;
}

/// Whether `id` is `ancestor` or lies below it.
inline bool IsBelow(const OpenTree& tree, OpenId id, OpenId ancestor)
{
  while (id != None && id > ancestor)
  {
    id = tree[id].parent;
  }
  return id == ancestor;
}

/// The open patch with that normal that holds the point; None where there is none.
inline OpenId PatchAt(const OpenTree& tree, const Vec3& point, const Vec3& normal)
{
  for (OpenId id = 0; id < tree.Size(); ++id)
  {
    if (tree[id].IsCluster() || tree[id].level > 0 ||
        glm::dot(tree.PatchOf(id).normal, normal) < 0.99)
    {
      continue;
    }
    const Polygon shape = tree.Shape(id);
    bool holds = std::abs(glm::dot(normal, point - shape[0])) < 1e-9;
    for (int i = 0; i < shape.Size(); ++i)
    {
      const Vec3 edge = shape[(i + 1) % shape.Size()] - shape[i];
      holds = holds && glm::dot(glm::cross(normal, edge), point - shape[i]) > -1e-9;
    }
    if (holds)
    {
      return id;
    }
  }
  return None;
}

/// The open leaf below a patch that holds a point of it.
inline OpenId LeafAt(const OpenTree& tree, OpenId patch, const Vec3& point)
{
  OpenId id = patch;
  while (!tree[id].IsLeaf())
  {
    const NodeId child = tree.Tree().ChildContaining(tree[id].node, point);
    id = tree[id].firstChild + (child - tree.Tree()[tree[id].node].firstChild);
  }
  return id;
}

/// A closed unit room with one-sided walls.
inline Scene MakeRoom(const Color& albedo = Color(0.5), const Color& emission = Color(0.0))
{
  Scene scene;
  scene.materials = { MakeMaterial(albedo, emission) };
  AddBox(scene, Vec3(0.0), Vec3(1.0), true, { 0, 0, 0, 0, 0, 0 });
  scene.cameras.push_back(InsideCamera());
  return scene;
}

/// The same without its ceiling.
inline Scene MakeOpenBox(const Color& albedo = Color(0.5), const Color& emission = Color(0.0))
{
  const Scene room = MakeRoom(albedo, emission);
  Scene scene;
  scene.materials = room.materials;
  scene.cameras = room.cameras;
  for (std::size_t p = 0; p < room.PolygonCount(); ++p)
  {
    const std::vector<Vec3> points = CornersOf(room, p);
    if (p != 1)
    {
      scene.AddPolygon(points, 0);
    }
  }
  return scene;
}

/// A solid crate that stands on z = 0: four sides and a top, seen from outside only.
inline void AddCrate(
  Scene& scene, const Vec2& low, const Vec2& high, double height, std::uint32_t material)
{
  Scene box;
  AddBox(box, Vec3(low, 0.0), Vec3(high, height), false, { 0, 0, 0, 0, 0, 0 });
  for (std::size_t p = 1; p < box.PolygonCount(); ++p) // 0 is the bottom
  {
    const std::vector<Vec3> points = CornersOf(box, p);
    scene.AddPolygon(points, material);
  }
}

/// A horizontal rectangle about a centre, facing up or down.
inline void AddPanel(
  Scene& scene, const Vec3& centre, const Vec2& size, bool facesUp, std::uint32_t material)
{
  const double x = 0.5 * size.x;
  const double y = facesUp ? 0.5 * size.y : -0.5 * size.y;
  scene.AddPolygon({ centre + Vec3(-x, -y, 0.0), centre + Vec3(x, -y, 0.0),
                     centre + Vec3(x, y, 0.0), centre + Vec3(-x, y, 0.0) },
    material);
}

/// A ball of 960 triangles over a floor at z = -1.
inline Scene MakeBallOverFloor()
{
  Scene scene;
  scene.materials = { MakeMaterial(Color(0.5)) };
  AddPanel(scene, Vec3(0.0, 0.0, -1.0), Vec2(4.0, 4.0), true, 0);
  AddBall(scene, Vec3(0.0), 0.4, 16, 0);
  return scene;
}

/// A closed room with a crate and a lamp below the ceiling, all one-sided but the lamp.
inline Scene MakeFurnishedRoom()
{
  Scene scene = MakeRoom(Color(0.6, 0.5, 0.4));
  scene.materials.push_back(MakeMaterial(Color(0.3)));
  scene.materials.push_back(MakeMaterial(Color(0.2), Color(30.0, 25.0, 20.0), true));
  AddCrate(scene, Vec2(0.5, 0.55), Vec2(0.85, 0.8), 0.35, 1);
  AddPanel(scene, Vec3(0.45, 0.5, 0.95), Vec2(0.2, 0.25), false, 2);
  return scene;
}

/// Two rooms that join at a slit along a wall. The lamp is in the first one, with its back to the
/// slit; the camera is in the second one.
inline Scene MakeRoomsWithASlit(double width)
{
  Scene scene;
  scene.materials = { MakeMaterial(Color(0.7)), MakeMaterial(Color(0.5), Color(50.0)),
    MakeMaterial(Color(0.7), Color(0.0), true) };
  AddBox(scene, Vec3(0.0), Vec3(2.0, 1.0, 1.0), true, { 0, 0, 0, 0, 0, 0 });
  scene.AddPolygon({ Vec3(1.0, 0.0, 0.0), Vec3(1.0, 1.0 - width, 0.0), Vec3(1.0, 1.0 - width, 1.0),
                     Vec3(1.0, 0.0, 1.0) },
    2);
  scene.AddPolygon(
    { Vec3(0.5, 0.3, 0.4), Vec3(0.5, 0.3, 0.6), Vec3(0.5, 0.5, 0.6), Vec3(0.5, 0.5, 0.4) }, 1);
  Camera camera = InsideCamera();
  camera.eye = Vec3(1.9, 0.2, 0.5);
  camera.lookAt = Vec3(1.5, 0.2, 0.3);
  scene.cameras.push_back(camera);
  return scene;
}

} // namespace vantage::test
