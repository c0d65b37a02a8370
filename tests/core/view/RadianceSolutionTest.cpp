#include "core/math/Sampling.h"
#include "core/transport/ExtractRadianceSolution.h"
#include "core/transport/Schedule.h"
#include "core/view/GatherStage.h"
#include "support/TestScenes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>

namespace vantage
{
namespace
{

using test::AddMaterial;
using test::AddRoom;

/// A triangle, a parallelogram and two quadrilaterals without parallel edges, both sides active.
Scene MakeShapes()
{
  Scene scene;
  const std::uint32_t white = AddMaterial(scene, Color(0.5));
  scene.AddPolygon({ { 0, 0, 0 }, { 2, 0.2, 0 }, { 0.4, 1.5, 0 } }, white);
  scene.AddPolygon({ { 0, 0, 1 }, { 2, 0.5, 1 }, { 2.5, 1.5, 1 }, { 0.5, 1, 1 } }, white);
  scene.AddPolygon({ { 0, 0, 2 }, { 2, 0.3, 2 }, { 1.4, 1.8, 2 }, { 0.1, 0.9, 2 } }, white);
  scene.AddPolygon({ { 3, 0, 0 }, { 3, 1, 0 }, { 3, 0.6, 1.9 }, { 3, 0.5, 2 } }, white);
  return scene;
}

/// A solution with the elements of the tree, numbered like its nodes.
RadianceSolution SolutionOf(const ElementTree& tree, const std::vector<PatchOptics>& optics)
{
  RadianceSolution solution;
  solution.SetPatches(optics);
  solution.elements.resize(tree.Size());
  for (NodeId id = 0; id < tree.Size(); ++id)
  {
    if (!tree[id].IsCluster())
    {
      solution.elements[id].firstChild = tree[id].firstChild;
      solution.elements[id].childCount = tree[id].childCount;
    }
  }
  for (PatchId p = 0; p < tree.Patches().size(); ++p)
  {
    const NodeId node = tree.Patches()[p].node;
    solution.StartAt(p, tree.Shape(node), node);
  }
  return solution;
}

TEST(RadianceSolution, FindsTheLeavesOfTheElementTree)
{
  test::GatherStage stage(MakeShapes(), [](PatchId) { return Color(0.0); });
  ElementTree tree = stage.tree;
  RandomStream random(17);
  const NodeId patches = tree.Size();
  for (NodeId id = 0; id < tree.Size() && tree.Size() < 3000; ++id)
  {
    if (!tree[id].IsCluster() && (id < patches || random.Next() < 0.7))
    {
      tree.Split(id);
    }
  }
  const RadianceSolution solution = SolutionOf(tree, stage.Optics());
  int deep = 0;
  for (int i = 0; i < 20000; ++i)
  {
    const PatchId patch = i % tree.Patches().size();
    const NodeId root = tree.Patches()[patch].node;
    const Vec3 point = PointAt(tree.Shape(root), random.Next2());
    const NodeId leaf = tree.LeafContaining(root, point);
    ASSERT_EQ(solution.LeafAt(patch, point), leaf) << "point " << i << " on patch " << patch;
    deep += tree[leaf].level > 2 ? 1 : 0;
  }
  EXPECT_GT(deep, 5000);
}

TEST(RadianceSolution, AnInactiveSideHasNoElements)
{
  Scene scene;
  const std::uint32_t oneSided = AddMaterial(scene, Color(0.5), Color(0.0), false);
  scene.AddPolygon({ { 0, 0, 0 }, { 1, 0, 0 }, { 0, 1, 0 } }, oneSided);
  const test::GatherStage stage(scene, [](PatchId) { return Color(3.0); });
  EXPECT_TRUE(stage.solution.IsActive(0));
  EXPECT_FALSE(stage.solution.IsActive(1));
}

/// Two rooms without a door, a lamp in each.
Scene MakeTwoRooms()
{
  Scene scene;
  const std::uint32_t white = AddMaterial(scene, Color(0.5));
  const std::uint32_t lamp = AddMaterial(scene, Color(0.2), Color(7.0, 5.0, 3.0), false);
  AddRoom(scene, { 0, 0, 0 }, { 1, 1, 1 }, white);
  AddRoom(scene, { 1, 0, 0 }, { 2, 1, 1 }, white);
  for (const double x : { 0.4, 1.4 })
  {
    scene.AddPolygon(
      { { x, 0.4, 0.9 }, { x, 0.6, 0.9 }, { x + 0.2, 0.6, 0.9 }, { x + 0.2, 0.4, 0.9 } }, lamp);
  }
  return scene;
}

TEST(ExtractRadianceSolution, TakesReflectedRadianceAndTheLampsThatShine)
{
  const test::GatherStage stage(MakeTwoRooms(), [](PatchId) { return Color(0.0); });
  Transport transport(stage.tree, stage.occluders, stage.Optics(), stage.facets.meanArea, {});
  const auto schedule = MakeSchedule(Method::ProgressiveShooting, Granularity::Patch, transport);
  for (std::uint32_t step = 1; step <= 30; ++step)
  {
    const auto next = schedule->Next(transport, step);
    ASSERT_TRUE(next);
    schedule->Perform(transport, *next, step);
  }
  const RadianceSolution solution = ExtractRadianceSolution(transport);
  const ElementTree& tree = transport.Tree();
  for (PatchId p = 0; p < tree.Patches().size(); ++p)
  {
    ASSERT_EQ(solution.IsActive(p), tree.Patches()[p].IsActive());
    EXPECT_EQ(solution.emission[p], transport.OpticsOf(p).emission);
    EXPECT_EQ(solution.albedo[p], transport.OpticsOf(p).albedo);
    if (!solution.IsActive(p))
    {
      continue;
    }
    // Not the centre: there, elements meet.
    const Polygon shape = tree.Shape(tree.Patches()[p].node);
    const Vec3 centre = 0.6 * Centroid(shape) + 0.27 * shape[0] + 0.13 * shape[1];
    const auto& leaf = solution.elements[solution.LeafAt(p, centre)];
    EXPECT_EQ(leaf.node, tree.LeafContaining(tree.Patches()[p].node, centre));
    EXPECT_EQ(leaf.reflected, transport.Radiance(leaf.node) - transport.OpticsOf(p).emission);
    EXPECT_EQ(leaf.unnamedDirect, Color(0.0));
    // In front of a floor or a wall is one room, with one lamp, which does not light the ceiling.
    const Vec3 air = centre + 0.3 * tree.Patches()[p].normal;
    const bool isInside =
      air.y > 0.0 && air.y < 1.0 && air.z > 0.0 && air.z < 0.9 && air.x > 0.0 && air.x < 2.0;
    if (isInside && tree.Patches()[p].normal.z > -0.5)
    {
      ASSERT_EQ(leaf.lastLamp - leaf.firstLamp, 1u) << "patch " << p;
      const PatchId lamp = solution.lamps[leaf.firstLamp];
      const Vec3 ofLamp = Centroid(tree.Shape(tree.Patches()[lamp].node));
      EXPECT_EQ(ofLamp.x < 1.0, air.x < 1.0) << "patch " << p;
    }
  }
}

/// However few of its facets an element interacts with.
TEST(ExtractRadianceSolution, OfALampThatWasCutAllIsNamedOrNothing)
{
  Scene scene = MakeTwoRooms();
  test::AddBall(scene, { 1.5, 0.5, 0.4 }, 0.1, 6, 1);
  const test::GatherStage stage(scene, [](PatchId) { return Color(0.0); });
  Transport transport(stage.tree, stage.occluders, stage.Optics(), stage.facets.meanArea, {});
  const auto schedule = MakeSchedule(Method::ProgressiveShooting, Granularity::Patch, transport);
  for (std::uint32_t step = 1; step <= 150; ++step)
  {
    schedule->Perform(transport, *schedule->Next(transport, step), step);
  }
  const RadianceSolution solution = ExtractRadianceSolution(transport);
  std::map<std::uint32_t, int> leaves; // by how many lamps they name
  for (const RadianceSolution::Element& element : solution.elements)
  {
    if (element.childCount == 0 && element.node != None)
    {
      ++leaves[element.lastLamp - element.firstLamp];
    }
  }
  for (const auto& [lamps, count] : leaves)
  {
    EXPECT_TRUE(lamps <= 2 || lamps >= 120) << count << " elements name " << lamps;
  }
  EXPECT_GT(leaves.rbegin()->first, 119u);
}

} // namespace
} // namespace vantage
