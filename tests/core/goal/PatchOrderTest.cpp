#include "core/goal/PatchOrder.h"

#include "core/goal/GoalScenes.h"
#include "core/scene/Labyrinth.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace vantage
{
namespace
{

Scene TwoRooms()
{
  LabyrinthSettings size;
  size.rows = 1;
  size.columns = 2;
  return MakeLabyrinth(size);
}

struct Ordered
{
  explicit Ordered(const Scene& scene)
    : stage(scene)
    , tree(stage.MakeTree())
    , order(tree, stage.optics)
  {
  }

  test::Stage stage;
  ElementTree tree;
  PatchOrder order;
};

/// The patches below a node, by walking there.
std::vector<PatchId> PatchesBelow(const ElementTree& tree, NodeId node)
{
  if (!tree[node].IsCluster())
  {
    return { tree[node].patch };
  }
  std::vector<PatchId> patches = PatchesBelow(tree, tree[node].firstChild);
  const std::vector<PatchId> second = PatchesBelow(tree, tree[node].firstChild + 1);
  patches.insert(patches.end(), second.begin(), second.end());
  return patches;
}

TEST(PatchOrder, KnowsTheLampsOfEveryNode)
{
  const Ordered o(TwoRooms());
  ASSERT_GT(o.order.LampCount(o.order.RangeOf(o.tree.Root())), 1u);
  for (NodeId node = 0; node < o.tree.Size(); ++node)
  {
    if (!o.tree[node].IsCluster() && !o.tree.Patches()[o.tree[node].patch].IsActive())
    {
      continue;
    }
    std::vector<PatchId> expected = PatchesBelow(o.tree, node);
    const auto isDark = [&](PatchId patch)
    { return MaxChannel(o.stage.optics[patch].emission) == 0.0; };
    expected.erase(std::remove_if(expected.begin(), expected.end(), isDark), expected.end());
    EXPECT_EQ(o.order.LampsIn(o.order.RangeOf(node)), expected);
    EXPECT_EQ(o.order.LampCount(o.order.RangeOf(node)), expected.size());
  }
}

TEST(PatchOrder, ALampThatWasCutDoesNotCountByItsFacets)
{
  Scene scene = TwoRooms();
  const auto lamps = [](const Scene& of)
  {
    const Ordered o(of);
    const PatchRange all = o.order.RangeOf(o.tree.Root());
    return std::pair<std::size_t, std::uint32_t>(
      o.order.LampsIn(all).size(), o.order.LampCount(all));
  };
  const auto [facets, count] = lamps(scene);
  scene.materials.push_back(test::MakeMaterial(Color(0.5), Color(8.0), false));
  const auto shining = static_cast<std::uint32_t>(scene.materials.size() - 1);
  test::AddBall(scene, { 1.0, 1.0, 1.0 }, 0.1, 8, shining);
  test::AddBall(scene, { 1.5, 1.5, 1.0 }, 0.1, 12, shining);
  const auto [facetsWithBalls, countWithBalls] = lamps(scene);
  EXPECT_EQ(facetsWithBalls, facets + 224 + 528);
  // Once, or twice where clusters part a ball before they know that it is one.
  EXPECT_GE(countWithBalls, count + 2);
  EXPECT_LE(countWithBalls, count + 4);
}

TEST(PatchOrder, RangesOfChildrenPartitionThatOfTheirParent)
{
  const Ordered o(TwoRooms());
  const PatchRange all = o.order.RangeOf(o.tree.Root());
  EXPECT_EQ(all.first, 0u);
  const auto active = std::count_if(o.tree.Patches().begin(), o.tree.Patches().end(),
    [](const Patch& patch) { return patch.IsActive(); });
  EXPECT_EQ(all.last, active);
  for (NodeId node = 0; node < o.tree.Size(); ++node)
  {
    const PatchRange range = o.order.RangeOf(node);
    ASSERT_LT(range.first, range.last);
    if (!o.tree[node].IsCluster())
    {
      EXPECT_EQ(range.last, range.first + 1);
      EXPECT_EQ(o.order[range.first], o.tree[node].patch);
      EXPECT_EQ(o.order.PlaceOf(o.tree[node].patch), range.first);
      continue;
    }
    const PatchRange first = o.order.RangeOf(o.tree[node].firstChild);
    const PatchRange second = o.order.RangeOf(o.tree[node].firstChild + 1);
    EXPECT_EQ(first.first, range.first);
    EXPECT_EQ(first.last, second.first);
    EXPECT_EQ(second.last, range.last);
  }
}

TEST(PatchOrder, SumsAreThoseOfThePatchesBelow)
{
  const Ordered o(TwoRooms());
  const double allSquares = o.order.AreaTimesSquaredEmission(o.order.RangeOf(o.tree.Root()));
  ASSERT_GT(allSquares, 0.0);
  for (NodeId node = 0; node < o.tree.Size(); ++node)
  {
    double area = 0.0;
    double squares = 0.0;
    Color albedo(0.0);
    Color emission(0.0);
    for (const PatchId patch : PatchesBelow(o.tree, node))
    {
      const double size = o.tree[o.tree.Patches()[patch].node].area;
      const PatchOptics& optics = o.stage.optics[patch];
      area += size;
      albedo += size * optics.albedo;
      emission += size * optics.emission;
      squares += size * Mean(optics.emission) * Mean(optics.emission);
    }
    const PatchRange range = o.order.RangeOf(node);
    EXPECT_NEAR(o.order.Area(range), area, 1e-9);
    EXPECT_NEAR(glm::length(o.order.AreaTimesAlbedo(range) - albedo), 0.0, 1e-9);
    EXPECT_NEAR(glm::length(o.order.AreaTimesEmission(range) - emission), 0.0, 1e-9);
    EXPECT_NEAR(o.order.AreaTimesSquaredEmission(range), squares, 1e-12 * allSquares);
  }
}

/// The last cluster with a lamp and something else in it.
NodeId ClusterThatEmits(const Ordered& o)
{
  NodeId found = o.tree.Root();
  for (NodeId node = 0; node < o.tree.Size(); ++node)
  {
    const bool emits = Mean(o.order.AreaTimesEmission(o.order.RangeOf(node))) > 0.0;
    found = o.tree[node].IsCluster() && emits ? node : found;
  }
  return found;
}

TEST(PatchOrder, DrawsHaveTheDensityTheyClaim)
{
  const Ordered o(TwoRooms());
  constexpr int Draws = 100000;
  for (const NodeId node : { o.tree.Root(), ClusterThatEmits(o) })
  {
    const PatchRange range = o.order.RangeOf(node);
    std::vector<int> drawn(o.tree.Patches().size(), 0);
    std::vector<double> density(o.tree.Patches().size(), 0.0);
    double area = 0.0;
    int emitting = 0;
    for (int i = 0; i < Draws; ++i)
    {
      const PatchOrder::Draw draw = o.order.At(range, (i + 0.5) / Draws);
      ++drawn[draw.patch];
      density[draw.patch] = draw.density;
      area += 1.0 / draw.density / Draws;
      emitting += Mean(o.stage.optics[draw.patch].emission) > 0.0 ? 1 : 0;
    }
    EXPECT_NEAR(area / o.order.Area(range), 1.0, 1e-3);
    EXPECT_GT(emitting, Draws / 2 - 1);
    for (const PatchId patch : PatchesBelow(o.tree, node))
    {
      // Each half of the chances has two ends of an interval that may cut a stratum.
      const double size = o.tree[o.tree.Patches()[patch].node].area;
      EXPECT_NEAR(drawn[patch], Draws * size * density[patch], 4.0) << "patch " << patch;
    }
  }
}

TEST(PatchOrder, WhereNothingEmitsAllDrawsAreByArea)
{
  const Ordered o(test::MakeRoom());
  const PatchRange range = o.order.RangeOf(o.tree.Root());
  std::vector<int> drawn(o.tree.Patches().size(), 0);
  for (int i = 0; i < 600; ++i)
  {
    const PatchOrder::Draw draw = o.order.At(range, (i + 0.5) / 600.0);
    EXPECT_NEAR(draw.density, 1.0 / 6.0, 1e-15);
    ++drawn[draw.patch];
  }
  for (const PatchId patch : PatchesBelow(o.tree, o.tree.Root()))
  {
    EXPECT_EQ(drawn[patch], 100);
  }
}

TEST(PatchOrder, TheEndsOfTheUnitIntervalStayInTheRange)
{
  const Ordered o(TwoRooms());
  for (NodeId node = 0; node < o.tree.Size(); ++node)
  {
    const PatchRange range = o.order.RangeOf(node);
    for (const double u : { 0.0, 0.4999999, 0x1.fffffffffffffp-2, 0.5, 0x1.fffffffffffffp-1 })
    {
      const PatchOrder::Draw draw = o.order.At(range, u);
      const std::uint32_t place = o.order.PlaceOf(draw.patch);
      ASSERT_GE(place, range.first);
      ASSERT_LT(place, range.last);
      ASSERT_GT(draw.density, 0.0);
      const bool mustEmit = u < 0.4999999 + 1e-9 && Mean(o.order.AreaTimesEmission(range)) > 0.0;
      ASSERT_TRUE(!mustEmit || Mean(o.stage.optics[draw.patch].emission) > 0.0)
        << "node " << node << ", u " << u;
    }
  }
}

TEST(PatchOrder, DrawsByAreaWhateverIsEmitted)
{
  const Ordered o(TwoRooms());
  const PatchRange all = o.order.RangeOf(o.tree.Root());
  constexpr int Draws = 100000;
  std::vector<int> drawn(o.tree.Patches().size(), 0);
  for (int i = 0; i < Draws; ++i)
  {
    ++drawn[o.order.ByArea(all, (i + 0.5) / Draws)];
  }
  for (PatchId patch = 0; patch < drawn.size(); ++patch)
  {
    const NodeId node = o.tree.Patches()[patch].node;
    const double area = node == None ? 0.0 : o.tree[node].area;
    // Equidistant: one more or less at either border.
    EXPECT_NEAR(drawn[patch], Draws * area / o.order.Area(all), 1.0 + 1e-6) << "patch " << patch;
  }
}

} // namespace
} // namespace vantage
