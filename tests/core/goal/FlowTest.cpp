#include "core/goal/Flow.h"

#include "core/goal/GoalOrientedTransport.h"
#include "core/goal/GoalScenes.h"
#include "core/goal/SolvedLinks.h"
#include "properties/RandomScene.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace vantage
{
namespace
{

/// Links between clusters, patches and elements as they come after a few rounds, with factors of a
/// closure that are as good as any.
struct Graph
{
  explicit Graph(const Scene& scene, int rounds = 8)
    : stage(scene)
    , transport(stage.MakeTree(), stage.occluders, stage.optics, stage.facets.meanArea,
        GoalOrientedSettings())
  {
    transport.SetView(stage.View());
    transport.Solve();
    for (int round = 0; round < rounds; ++round)
    {
      transport.Refine(0.5);
      transport.Solve();
    }
    for (OpenId id = 0; id < this->Tree().Size(); ++id)
    {
      closure[BetweenSurfaces].push_back(0.8 + 0.4 * ToUnit(Hash(id)));
      closure[WithCluster].push_back(0.5 + ToUnit(Hash(id, 1)));
    }
  }

  const OpenTree& Tree() const { return this->transport.Tree(); }
  std::vector<Link> Links() const { return this->transport.Links(); }

  std::vector<Color> Emission() const
  {
    std::vector<Color> sources;
    for (OpenId id = 0; id < this->Tree().Size(); ++id)
    {
      sources.push_back(this->Tree()[id].emission);
    }
    return sources;
  }

  /// albedo / pi V of the exposed leaves.
  std::vector<Color> ReflectedView() const
  {
    std::vector<Color> sources;
    for (OpenId id = 0; id < this->Tree().Size(); ++id)
    {
      const OpenNode& node = this->Tree()[id];
      sources.push_back(node.IsExposed() ? node.albedo / Pi * (node.view / node.area) : Color(0.0));
    }
    return sources;
  }

  Flow Swept(const std::vector<Color>& sources, int sweeps) const
  {
    const LinkMatrix matrix(this->Tree(), this->Links());
    Flow flow;
    flow.Follow(this->Tree());
    for (OpenId id = 0; id < this->Tree().Size(); ++id)
    {
      if (this->Tree()[id].IsLeaf())
      {
        flow.SetSource(id, sources[id]);
      }
    }
    for (int sweep = 0; sweep < sweeps; ++sweep)
    {
      flow.Sweep(matrix, closure);
    }
    flow.FindSpreads(this->Tree(), matrix, this->Links());
    return flow;
  }

  test::Stage stage;
  GoalOrientedTransport transport;
  Closure closure;
};

TEST(Flow, ConvergesToTheDirectSolutionOfTheSameLinks)
{
  for (std::uint64_t seed = 1; seed <= 3; ++seed)
  {
    SCOPED_TRACE("seed " + std::to_string(seed));
    const Graph graph(test::MakeRandomScene(seed));
    const std::vector<Color> sources = graph.Emission();
    const Flow flow = graph.Swept(sources, 400);
    for (int channel = 0; channel < 3; ++channel)
    {
      const std::vector<double> expected =
        test::SolveLeaves(graph.Tree(), graph.Links(), graph.closure, sources, channel);
      for (const OpenId leaf : test::LeavesOf(graph.Tree()))
      {
        ASSERT_NEAR(flow.Value(leaf)[channel], expected[leaf], 1e-9) << "node " << leaf;
        ASSERT_NEAR(flow.Received(leaf)[channel], expected[leaf] - sources[leaf][channel], 1e-9);
      }
    }
  }
}

TEST(Flow, RadianceAndImportanceAreDual)
{
  for (std::uint64_t seed = 1; seed <= 5; ++seed)
  {
    SCOPED_TRACE("seed " + std::to_string(seed));
    const Graph graph(test::MakeRandomScene(seed));
    const Flow radiance = graph.Swept(graph.Emission(), 400);
    const Flow importance = graph.Swept(graph.ReflectedView(), 400);
    Color ofRadiance(0.0);
    Color ofImportance(0.0);
    for (const OpenId leaf : test::LeavesOf(graph.Tree()))
    {
      const OpenNode& node = graph.Tree()[leaf];
      ofRadiance += node.view * radiance.Value(leaf);
      ofImportance += node.emission * (Color(node.view) + node.area * importance.Arriving(leaf));
    }
    ASSERT_GT(Mean(ofRadiance), 0.0);
    for (int channel = 0; channel < 3; ++channel)
    {
      EXPECT_NEAR(ofImportance[channel] / ofRadiance[channel], 1.0, 1e-9);
    }
  }
}

TEST(Flow, IsLinearInItsSource)
{
  const Graph graph(test::MakeRandomScene(4));
  const std::vector<Color> once = graph.Emission();
  std::vector<Color> twice = once;
  for (Color& source : twice)
  {
    source *= 2.0;
  }
  const Flow one = graph.Swept(once, 7);
  const Flow two = graph.Swept(twice, 7);
  for (OpenId id = 0; id < graph.Tree().Size(); ++id)
  {
    ASSERT_EQ(two.Value(id), 2.0 * one.Value(id));
    ASSERT_EQ(two.Spread(id), 2.0 * one.Spread(id));
    ASSERT_EQ(two.Arriving(id), 2.0 * one.Arriving(id));
  }
}

TEST(Flow, SweepTellsTheRelativeChange)
{
  const Graph graph(test::MakeRandomScene(5));
  Flow flow = graph.Swept(graph.Emission(), 3);
  std::vector<Color> before;
  for (OpenId id = 0; id < graph.Tree().Size(); ++id)
  {
    before.push_back(flow.Value(id));
  }
  const double told = flow.Sweep(LinkMatrix(graph.Tree(), graph.Links()), graph.closure);
  double change = 0.0;
  double total = 0.0;
  for (const OpenId leaf : test::LeavesOf(graph.Tree()))
  {
    change += graph.Tree()[leaf].area * std::abs(Mean(flow.Value(leaf) - before[leaf]));
    total += graph.Tree()[leaf].area * Mean(flow.Value(leaf));
  }
  EXPECT_NEAR(told, change / total, 1e-12);
  EXPECT_GT(told, 0.0);
}

TEST(Flow, InnerNodesHaveTheMeansOfTheirLeaves)
{
  const Graph graph(test::MakeRandomScene(6));
  const Flow flow = graph.Swept(graph.Emission(), 5);
  const OpenTree& tree = graph.Tree();
  for (OpenId id = 0; id < tree.Size(); ++id)
  {
    Color sum(0.0);
    double square = 0.0;
    double area = 0.0;
    for (const OpenId leaf : test::LeavesOf(tree))
    {
      if (test::IsBelow(tree, leaf, id))
      {
        const double mean = Mean(flow.Value(leaf));
        area += tree[leaf].area;
        sum += tree[leaf].area * flow.Value(leaf);
        square += tree[leaf].area * (mean * mean + flow.Spread(leaf) * flow.Spread(leaf));
      }
    }
    ASSERT_NEAR(glm::length(flow.Value(id) - sum / area), 0.0, 1e-10);
    const double mean = Mean(sum) / area;
    if (!tree[id].IsLeaf())
    {
      ASSERT_NEAR(flow.Spread(id), std::sqrt(square / area - mean * mean), 1e-6 * (1.0 + mean));
    }
  }
}

/// Two panels that face each other and are all there is.
Scene MakePair()
{
  Scene scene;
  scene.materials = { test::MakeMaterial(Color(0.5)) };
  test::AddPanel(scene, Vec3(0.0), Vec2(1.0, 1.0), true, 0);
  test::AddPanel(scene, Vec3(0.0, 0.0, 1.0), Vec2(1.0, 1.0), false, 0);
  return scene;
}

TEST(Flow, SpreadIsThatOfTheLeavesAndWithinThem)
{
  const test::Stage stage(MakePair());
  OpenTree tree = stage.MakeOpenTree();
  tree.Open(0);
  tree.Open(1);
  Flow flow;
  flow.Follow(tree);
  const double values[] = { 1.0, 2.0, 3.0, 6.0 };
  for (int c = 0; c < 4; ++c)
  {
    flow.SetSource(tree[1].firstChild + c, Color(values[c]));
  }
  const Closure closure = test::NoClosure(tree);
  const LinkMatrix none(tree, {});
  flow.Sweep(none, closure);
  flow.FindSpreads(tree, none, {});
  EXPECT_EQ(flow.Value(1), Color(3.0));
  // Squares 1, 4, 9, 36 of mean 12.5.
  EXPECT_NEAR(flow.Spread(1), std::sqrt(3.5), 1e-12);
  EXPECT_NEAR(flow.Spread(0), std::sqrt(0.5 * 12.5 - 1.5 * 1.5), 1e-12);
  EXPECT_EQ(flow.Spread(2), 0.0);

  // What a link brings may differ over its end as its variation says.
  Link link;
  link.ends = { 1, 2 };
  link.throughput = 0.2;
  link.variation = 0.1;
  const LinkMatrix matrix(tree, { link });
  flow.Sweep(matrix, closure);
  flow.FindSpreads(tree, matrix, { link });
  EXPECT_NEAR(flow.Value(2).x, 0.5 / Pi * 0.2 * 3.0, 1e-12);
  EXPECT_NEAR(flow.Spread(2), 0.5 / Pi * 0.1 * 3.0, 1e-12);
  EXPECT_EQ(flow.Arriving(tree[1].firstChild), Color(0.0));
}

TEST(Flow, LeavesThatRestKeepTheirValuesAndAreReadByOthers)
{
  for (std::uint64_t seed = 1; seed <= 3; ++seed)
  {
    SCOPED_TRACE("seed " + std::to_string(seed));
    const Graph graph(test::MakeRandomScene(seed));
    const OpenTree& tree = graph.Tree();
    std::vector<Color> sources = graph.Emission();
    Flow flow = graph.Swept(sources, 400);
    std::vector<bool> rests(tree.Size(), false);
    std::vector<double> right(tree.Size(), 0.0);
    for (const OpenId leaf : test::LeavesOf(tree))
    {
      rests[leaf] = Hash(leaf, seed) % 2 == 0;
      sources[leaf] += rests[leaf] ? 0.0 : 1.0;
      flow.SetSource(leaf, sources[leaf]);
      right[leaf] = rests[leaf] ? flow.Value(leaf).x : sources[leaf].x;
    }
    const LinkMatrix matrix(tree, graph.Links(), rests);
    for (int sweep = 0; sweep < 400; ++sweep)
    {
      flow.Sweep(matrix, graph.closure);
    }
    // The same equation with the rows of what rests replaced by what is known of it.
    const auto factors = test::LeafFactors(tree, graph.Links(), graph.closure);
    std::vector<std::vector<double>> system(tree.Size(), std::vector<double>(tree.Size(), 0.0));
    for (OpenId i = 0; i < tree.Size(); ++i)
    {
      system[i][i] = 1.0;
      for (OpenId k = 0; k < tree.Size() && !rests[i]; ++k)
      {
        system[i][k] -= tree[i].albedo.x / Pi * factors[i][k];
      }
    }
    const std::vector<double> expected = test::SolveSystem(std::move(system), right);
    for (const OpenId leaf : test::LeavesOf(tree))
    {
      ASSERT_NEAR(flow.Value(leaf).x, expected[leaf], 1e-9) << "node " << leaf;
    }
  }
}

TEST(Flow, ABalancedSweepTakesAwayWhatIsTheSameEverywhere)
{
  // Where all have the same light, it is solved at once, however much of it is reflected.
  const test::Stage stage(test::MakeFurnace(Color(0.999), Color(2.0)));
  OpenTree tree = stage.MakeOpenTree();
  test::OpenTo(tree, 0);
  Link self;
  self.ends = { 0, 0 };
  self.throughput = Pi * tree[0].area; // all see all: rows sum up to pi
  const Closure closure = test::NoClosure(tree);
  Flow flow;
  flow.Follow(tree);
  for (OpenId id = 0; id < tree.Size(); ++id)
  {
    if (tree[id].IsLeaf())
    {
      flow.SetSource(id, Color(2.0));
    }
  }
  const LinkMatrix matrix(tree, { self });
  flow.Sweep(matrix, closure);
  flow.Sweep(matrix, closure);
  flow.FindSpreads(tree, matrix, { self });
  EXPECT_LT(flow.Value(0).x, 10.0);
  for (int sweep = 0; sweep < 5; ++sweep)
  {
    flow.Sweep(matrix, closure, true);
  }
  flow.FindSpreads(tree, matrix, { self });
  EXPECT_NEAR(flow.Value(0).x, 2000.0, 1e-6);
  EXPECT_LT(flow.Sweep(matrix, closure), 1e-12);
}

TEST(Flow, AClusterThatNobodyLookedIntoSpreadsAsItsSourceDoes)
{
  const test::Stage stage(test::MakeFurnishedRoom());
  const OpenTree tree = stage.MakeOpenTree();
  Flow flow;
  flow.Follow(tree);
  // All of it comes from a lamp on a hundredth of the area.
  flow.SetSource(0, Color(0.1), 1.0);
  const LinkMatrix matrix(tree, {});
  flow.Sweep(matrix, test::NoClosure(tree));
  flow.FindSpreads(tree, matrix, {});
  EXPECT_GE(flow.Spread(0), std::sqrt(1.0 - 0.1 * 0.1) - 1e-12);
}

/// What a ball receives is as uneven as it is round: half of the bend, an agreed measure.
TEST(Flow, PartOfACurvedSurfaceSpreadsAsItBends)
{
  const test::Stage stage(test::MakeBallOverFloor());
  OpenTree tree = stage.MakeOpenTree();
  OpenId part = 0;
  for (; !tree[part].IsCluster() || tree.Geometry(part).Bend() > 0.4; ++part)
  {
    if (tree[part].IsCluster())
    {
      tree.Open(part);
    }
  }
  const OpenId floor = test::PatchAt(tree, { 0.0, 0.0, -1.0 }, { 0.0, 0.0, 1.0 });
  ASSERT_TRUE(tree[part].IsLeaf() && floor != None);
  Flow flow;
  flow.Follow(tree);
  flow.SetSource(floor, Color(1.0));
  Link link;
  link.ends = { part, floor };
  link.throughput = 0.01;
  const LinkMatrix matrix(tree, { link });
  flow.Sweep(matrix, test::NoClosure(tree));
  flow.Sweep(matrix, test::NoClosure(tree));
  flow.FindSpreads(tree, matrix, { link });
  ASSERT_GT(flow.Received(part).x, 0.0);
  const double ofBend = 0.5 * tree.Geometry(part).Bend() * flow.Received(part).x;
  EXPECT_NEAR(flow.Spread(part), ofBend, 1e-12);
  // What its links vary by comes to that.
  link.variation = 0.008;
  flow.FindSpreads(tree, matrix, { link });
  const double ofLink = 0.8 * flow.Received(part).x;
  EXPECT_NEAR(flow.Spread(part), std::hypot(ofBend, ofLink), 1e-12);
}

TEST(Flow, NewNodesStartWithTheValueOfTheirParentAndClearForgets)
{
  Graph graph(test::MakeRandomScene(7), 2);
  Flow flow = graph.Swept(graph.Emission(), 5);
  const OpenId size = graph.Tree().Size();
  graph.transport.Refine(1.0);
  const OpenTree& tree = graph.Tree();
  ASSERT_GT(tree.Size(), size);
  flow.Follow(tree);
  for (OpenId id = size; id < tree.Size(); ++id)
  {
    EXPECT_EQ(flow.Value(id), flow.Value(tree[id].parent));
  }
  flow.Clear();
  for (const OpenId leaf : test::LeavesOf(tree))
  {
    EXPECT_EQ(flow.Received(leaf), Color(0.0));
  }
}

} // namespace
} // namespace vantage
