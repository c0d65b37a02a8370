#pragma once

#include "core/math/Sampling.h"
#include "core/mesh/ElementTree.h"
#include "core/scene/Scene.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <tuple>
#include <vector>

/// \file MeshScenes.h
/// Small scenes that have what the mesh layer must cope with.

namespace vantage::test
{

inline Material Named(const char* name, bool twoSided = true)
{
  Material material;
  material.name = name;
  material.twoSided = twoSided;
  return material;
}

/// A parallelogram, its front where u x v points.
inline void AddQuad(
  Scene& scene, const Vec3& corner, const Vec3& u, const Vec3& v, std::uint32_t material = 0)
{
  scene.AddPolygon({ corner, corner + u, corner + u + v, corner + v }, material);
}

/// The six sides of a box with their fronts inside.
inline void AddRoom(Scene& scene, const Vec3& low, const Vec3& size, std::uint32_t material = 0)
{
  const Vec3 x(size.x, 0, 0);
  const Vec3 y(0, size.y, 0);
  const Vec3 z(0, 0, size.z);
  AddQuad(scene, low, x, y, material);
  AddQuad(scene, low, y, z, material);
  AddQuad(scene, low, z, x, material);
  AddQuad(scene, low + z, y, x, material);
  AddQuad(scene, low + x, z, y, material);
  AddQuad(scene, low + y, x, z, material);
}

inline Scene OneRoom(bool twoSided = true)
{
  Scene scene;
  scene.materials.push_back(Named("wall", twoSided));
  AddRoom(scene, { 0, 0, 0 }, { 4, 3, 2.5 });
  return scene;
}

/// Rooms of edge 1 in a grid over shared walls of no thickness. Floors, ceilings and walls meet
/// edge to edge, so that up to four facets meet in an edge.
inline Scene RoomGrid(int columns, int rows)
{
  Scene scene;
  scene.materials.push_back(Named("wall"));
  for (int r = 0; r <= rows; ++r)
  {
    for (int c = 0; c <= columns; ++c)
    {
      const Vec3 corner(c, r, 0);
      if (c < columns && r < rows)
      {
        AddQuad(scene, corner, { 1, 0, 0 }, { 0, 1, 0 });
        AddQuad(scene, corner + Vec3(0, 0, 1), { 0, 1, 0 }, { 1, 0, 0 });
      }
      if (c < columns)
      {
        AddQuad(scene, corner, { 1, 0, 0 }, { 0, 0, 1 });
      }
      if (r < rows)
      {
        AddQuad(scene, corner, { 0, 1, 0 }, { 0, 0, 1 });
      }
    }
  }
  return scene;
}

/// A floor of 3 x 3 squares with a wall that stands free on the edge (1,1)-(2,1).
inline Scene FloorWithFin()
{
  Scene scene;
  scene.materials.push_back(Named("floor"));
  for (int i = 0; i < 9; ++i)
  {
    AddQuad(scene, { i % 3, i / 3, 0 }, { 1, 0, 0 }, { 0, 1, 0 });
  }
  AddQuad(scene, { 1, 1, 0 }, { 1, 0, 0 }, { 0, 0, 1 });
  return scene;
}

/// A star-shaped polygon with random radii, concave nearly always, in a random plane.
inline std::vector<Vec3> RandomStar(RandomStream& random, int corners, double leastRadius)
{
  const double z = 2.0 * random.Next() - 1.0;
  const double phi = 2.0 * Pi * random.Next();
  const double r = std::sqrt(1.0 - z * z);
  const Frame frame(Vec3(r * std::cos(phi), r * std::sin(phi), z));
  const Vec3 centre(10.0 * random.Next(), 10.0 * random.Next(), 10.0 * random.Next());
  std::vector<Vec3> points;
  for (int i = 0; i < corners; ++i)
  {
    const double angle = 2.0 * Pi * (i + 0.8 * random.Next()) / corners;
    const double radius = leastRadius + (1.0 - leastRadius) * random.Next();
    points.push_back(
      centre + frame.ToWorld({ radius * std::cos(angle), radius * std::sin(angle), 0.0 }));
  }
  return points;
}

/// How often each number comes up, ascending: the sizes of what is numbered.
inline std::vector<int> SizesOf(const std::vector<std::uint32_t>& numbers)
{
  std::map<std::uint32_t, int> counts;
  for (const std::uint32_t number : numbers)
  {
    ++counts[number];
  }
  std::vector<int> sizes;
  for (const auto& [number, count] : counts)
  {
    sizes.push_back(count);
  }
  std::sort(sizes.begin(), sizes.end());
  return sizes;
}

template <typename T>
void Shuffle(std::vector<T>& items, RandomStream& random)
{
  for (std::size_t i = items.size(); i > 1; --i)
  {
    std::swap(items[i - 1], items[static_cast<std::size_t>(random.Next() * i)]);
  }
}

/// The same polygons in another order over renumbered vertices.
inline Scene Shuffled(const Scene& scene, RandomStream& random)
{
  Scene result;
  result.materials = scene.materials;
  std::vector<std::uint32_t> vertexAt(scene.vertices.size());
  std::iota(vertexAt.begin(), vertexAt.end(), 0u);
  Shuffle(vertexAt, random);
  std::vector<std::uint32_t> newIndex(vertexAt.size());
  for (std::uint32_t i = 0; i < vertexAt.size(); ++i)
  {
    newIndex[vertexAt[i]] = i;
    result.vertices.push_back(scene.vertices[vertexAt[i]]);
  }
  std::vector<std::uint32_t> polygons(scene.PolygonCount());
  std::iota(polygons.begin(), polygons.end(), 0u);
  Shuffle(polygons, random);
  for (const std::uint32_t p : polygons)
  {
    for (std::uint32_t i = scene.offsets[p]; i < scene.offsets[p + 1]; ++i)
    {
      result.indices.push_back(newIndex[scene.indices[i]]);
    }
    result.offsets.push_back(static_cast<std::uint32_t>(result.indices.size()));
    result.materialOfPolygon.push_back(scene.materialOfPolygon[p]);
  }
  return result;
}

/// Splits random leaves, not deeper than level 6.
inline void SplitAtRandom(ElementTree& tree, int count, RandomStream& random)
{
  std::vector<NodeId> leaves;
  for (NodeId id = 0; id < tree.Size(); ++id)
  {
    if (!tree[id].IsCluster() && tree[id].IsLeaf() && tree[id].level < 6)
    {
      leaves.push_back(id);
    }
  }
  for (int k = 0; k < count && !leaves.empty(); ++k)
  {
    const auto i = static_cast<std::size_t>(random.Next() * leaves.size());
    const NodeId first = tree.Split(leaves[i]);
    leaves.erase(leaves.begin() + static_cast<std::ptrdiff_t>(i));
    for (NodeId child = first; tree[first].level < 6 && child < first + 4; ++child)
    {
      leaves.push_back(child);
    }
  }
}

} // namespace vantage::test
