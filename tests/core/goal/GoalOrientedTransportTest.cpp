#include "core/goal/GoalOrientedTransport.h"

#include "core/goal/GoalScenes.h"
#include "core/goal/SolvedLinks.h"
#include "core/scene/Labyrinth.h"
#include "core/transport/PairEvaluator.h"
#include "core/visibility/PairVisibility.h"
#include "properties/RandomScene.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace vantage
{
namespace
{

struct Transported
{
  explicit Transported(const Scene& scene, const GoalOrientedSettings& settings = {})
    : stage(scene)
    , transport(stage.MakeTree(), stage.occluders, stage.optics, stage.facets.meanArea, settings)
  {
  }

  void Run(int rounds, double share = 0.5)
  {
    transport.Solve();
    for (int round = 0; round < rounds; ++round)
    {
      transport.Refine(share);
      transport.Solve();
    }
  }

  test::Stage stage;
  GoalOrientedTransport transport;
};

/// How many links join each pair of leaves, row by row over all open nodes.
std::vector<int> LinksOfLeaves(const GoalOrientedTransport& transport)
{
  const OpenTree& tree = transport.Tree();
  const std::vector<OpenId> leaves = test::LeavesOf(tree);
  std::vector<int> counts(tree.Size() * tree.Size(), 0);
  for (const Link& link : transport.Links())
  {
    for (const OpenId i : leaves)
    {
      for (const OpenId k : leaves)
      {
        const bool isOne =
          test::IsBelow(tree, i, link.ends[0]) && test::IsBelow(tree, k, link.ends[1]);
        const bool isOther =
          test::IsBelow(tree, i, link.ends[1]) && test::IsBelow(tree, k, link.ends[0]);
        counts[i * tree.Size() + k] += isOne || isOther ? 1 : 0;
      }
    }
  }
  return counts;
}

TEST(GoalOrientedTransport, StartsWithOneLinkOfTheRootToItself)
{
  Transported t(test::MakeFurnishedRoom());
  ASSERT_EQ(t.transport.LinkCount(), 1u);
  EXPECT_TRUE(t.transport.Links()[0].IsSelf());
  EXPECT_EQ(t.transport.Links()[0].ends[0], 0u);
  EXPECT_EQ(t.transport.LeafCount(), 0u);
  t.transport.Solve();
  EXPECT_EQ(t.transport.LinkCount(), 1u);
  EXPECT_EQ(t.transport.Counters().clusterPairs, 1u);
}

TEST(GoalOrientedTransport, EachPairOfLeavesIsLinkedOnceOrSeesNothing)
{
  for (const double share : { 0.3, 1.0 })
  {
    Transported t(test::MakeRandomScene(2));
    t.transport.SetView(t.stage.View());
    t.transport.Solve();
    for (int round = 0; round < 40 && t.transport.LeafCount() < 40; ++round)
    {
      t.transport.Refine(share);
      t.transport.Solve();
    }
    const OpenTree& tree = t.transport.Tree();
    const std::vector<OpenId> leaves = test::LeavesOf(tree);
    ASSERT_GT(t.transport.LeafCount(), 20u);
    const std::vector<int> counts = LinksOfLeaves(t.transport);
    for (const OpenId i : leaves)
    {
      for (const OpenId k : leaves)
      {
        const int count = counts[i * tree.Size() + k];
        ASSERT_LE(count, 1) << i << " " << k;
        const bool areSurfaces = !tree[i].IsCluster() && !tree[k].IsCluster();
        if (count == 0 && areSurfaces && tree[i].patch != tree[k].patch && tree[i].IsExposed() &&
            tree[k].IsExposed() && FaceEachOther(tree.Shape(i), tree.Shape(k)))
        {
          ASSERT_EQ(EstimateVisibility(t.stage.occluders, { tree.Shape(i), tree.PatchOf(i).facet },
                      { tree.Shape(k), tree.PatchOf(k).facet }, 64, 1)
                      .fraction,
            0.0)
            << i << " " << k;
        }
        ASSERT_TRUE(count == 1 || areSurfaces) << i << " " << k;
      }
    }
  }
}

TEST(GoalOrientedTransport, CountersTellWhatWasDone)
{
  Transported t(test::MakeFurnishedRoom());
  t.transport.SetView(t.stage.View());
  t.transport.Solve();
  std::uint64_t refined = 0;
  for (std::uint32_t round = 1; round <= 6; ++round)
  {
    const GoalOrientedCounters before = t.transport.Counters();
    const std::size_t links = t.transport.LinkCount();
    const std::size_t count = t.transport.Refine(0.5);
    const GoalOrientedCounters after = t.transport.Counters();
    refined += count;
    EXPECT_GT(count, 0u);
    EXPECT_EQ(after.rounds, round);
    EXPECT_EQ(after.refined, refined);
    const std::uint64_t made = after.surfacePairs + after.clusterPairs - before.surfacePairs -
                               before.clusterPairs - (after.hidden - before.hidden);
    EXPECT_EQ(t.transport.LinkCount(), links - count + made);
    const auto isNew = [&](const Link& link) { return link.step == round; };
    const std::vector<Link> all = t.transport.Links();
    EXPECT_EQ(std::count_if(all.begin(), all.end(), isNew), made);
    t.transport.Solve();
  }
}

TEST(GoalOrientedTransport, BothSidesOfDualityAgree)
{
  for (std::uint64_t seed = 1; seed <= 5; ++seed)
  {
    SCOPED_TRACE("seed " + std::to_string(seed));
    Transported t(test::MakeRandomScene(seed));
    t.transport.SetView(t.stage.View());
    t.Run(8);
    const double once = Mean(t.transport.ViewFluxOfImportance()) / Mean(t.transport.ViewFlux());
    EXPECT_NEAR(once, 1.0, 0.01);
    // Solving goes on where it stopped; what is left is the tolerance of a sweep.
    for (int k = 0; k < 10; ++k)
    {
      t.transport.Solve();
    }
    const double solved = Mean(t.transport.ViewFluxOfImportance()) / Mean(t.transport.ViewFlux());
    EXPECT_NEAR(solved, 1.0, 1e-4);
  }
}

TEST(GoalOrientedTransport, SurfacesThatWereCutExchangeLightAsWholes)
{
  Transported t(test::CutIntoPieces(test::MakeFurnace(Color(0.3)), 12, true));
  t.transport.SetView(t.stage.View());
  t.Run(8);
  int wholes = 0;
  for (const Link& link : t.transport.Links())
  {
    for (const OpenId end : link.ends)
    {
      const Node& node = t.transport.Tree().Geometry(end);
      wholes += node.IsCluster() && node.HasShape() && node.area > 0.5 ? 1 : 0;
    }
  }
  EXPECT_GT(wholes, 0);
  EXPECT_LT(t.transport.LinkCount(), 1728u); // there are so many pieces
}

/// Clusters, what no view needs, and what is hidden from most of the scene are no exceptions.
void ExpectUniformFurnace(const Scene& furnace, double albedo)
{
  for (int rounds = 0; rounds <= 8; rounds += 2)
  {
    SCOPED_TRACE(std::to_string(rounds) + " rounds");
    Transported t(furnace);
    t.transport.SetView(t.stage.View());
    t.Run(rounds);
    // What is reflected 120 times is nothing.
    for (int k = 0; k < 10; ++k)
    {
      t.transport.Solve();
    }
    for (const OpenId leaf : test::LeavesOf(t.transport.Tree()))
    {
      const double radiance = Mean(t.transport.Radiance().Value(leaf));
      EXPECT_NEAR(radiance * (1.0 - albedo), 1.0, 1e-4) << "node " << leaf;
    }
  }
}

TEST(GoalOrientedTransport, AFurnaceIsUniformAfterAnyNumberOfRounds)
{
  ExpectUniformFurnace(test::MakeFurnace(Color(0.3)), 0.3);
  ExpectUniformFurnace(test::CutIntoPieces(test::MakeFurnace(Color(0.3)), 5, true), 0.3);
}

TEST(GoalOrientedTransport, AConcaveFurnaceIsUniformAfterAnyNumberOfRounds)
{
  const std::vector<Vec2> l{ { 0, 0 }, { 2, 0 }, { 2, 1 }, { 1, 1 }, { 1, 3 }, { 0, 3 } };
  ExpectUniformFurnace(test::MakeGlowingRoom(l, 1.0, 0.5), 0.5);
  ExpectUniformFurnace(test::MakeGlowingRoom(test::CombPlan(), 1.0, 0.5), 0.5);
}

TEST(GoalOrientedTransport, AnotherViewKeepsLinksAndRadiance)
{
  Transported t(test::MakeFurnishedRoom());
  t.transport.SetView(t.stage.View());
  t.Run(6);
  const std::size_t links = t.transport.LinkCount();
  const OpenId size = t.transport.Tree().Size();
  std::vector<Color> before;
  for (OpenId id = 0; id < size; ++id)
  {
    before.push_back(t.transport.Radiance().Value(id));
  }
  std::swap(t.stage.scene.cameras[0].eye.x, t.stage.scene.cameras[0].lookAt.x);
  t.transport.SetView(t.stage.View());
  EXPECT_EQ(t.transport.LinkCount(), links);
  for (OpenId id = 0; id < size; ++id)
  {
    EXPECT_EQ(t.transport.Radiance().Value(id), before[id]);
  }
  // The importance is that of the new view alone.
  t.transport.Solve();
  EXPECT_EQ(t.transport.LinkCount(), links);
  EXPECT_NEAR(Mean(t.transport.ViewFluxOfImportance()) / Mean(t.transport.ViewFlux()), 1.0, 0.01);
}

TEST(GoalOrientedTransport, ARoundFollowsWhatIsBadDownTheTree)
{
  Scene scene = MakeLabyrinth();
  scene.cameras.resize(1);
  Transported t(scene);
  t.transport.SetView(t.stage.View());
  t.transport.Solve();
  const auto made = [&t]
  {
    const GoalOrientedCounters& counters = t.transport.Counters();
    return counters.surfacePairs + counters.clusterPairs - counters.hidden;
  };
  int deepRounds = 0;
  while (t.transport.ErrorEstimate() > 0.02 && t.transport.Counters().rounds < 100)
  {
    const std::uint64_t before = made();
    ASSERT_GT(t.transport.Refine(0.45), 0u);
    const std::vector<Link> links = t.transport.Links();
    const auto isNew = [&](const Link& link) { return link.step == t.transport.Counters().rounds; };
    const auto left = static_cast<std::uint64_t>(std::count_if(links.begin(), links.end(), isNew));
    EXPECT_LE(left, made() - before);
    deepRounds += left < made() - before ? 1 : 0; // some were replaced at once
    t.transport.Solve();
  }
  EXPECT_GT(deepRounds, 10);
}

TEST(GoalOrientedTransport, AWalkSweepsOverWhatItsLastViewNeeds)
{
  LabyrinthSettings rooms;
  rooms.rows = 1;
  rooms.columns = 10;
  Scene scene = MakeLabyrinth(rooms);
  scene.cameras.resize(1);
  Transported t(scene);
  GoalOrientedCounters before;
  for (int room = 0; room < rooms.columns; ++room)
  {
    Camera& camera = t.stage.scene.cameras[0];
    camera.eye = Vec3(4.0 * room + 1.0, 1.0, 1.5);
    camera.lookAt = camera.eye + Vec3(1.0, 1.0, -0.2);
    t.transport.SetView(t.stage.View());
    before = t.transport.Counters();
    t.transport.Solve();
    for (int round = 0; round < 200 && t.transport.ErrorEstimate() > 0.05; ++round)
    {
      ASSERT_GT(t.transport.Refine(0.45), 0u);
      t.transport.Solve();
    }
  }
  const GoalOrientedCounters after = t.transport.Counters();
  const auto sweeps = static_cast<double>(after.sweeps - before.sweeps);
  const auto links = static_cast<double>(t.transport.LinkCount());
  EXPECT_LT(static_cast<double>(after.sweptLinks - before.sweptLinks) / sweeps, 0.5 * links);

  // What rested is as right as if it had been awake: within a part of what was asked.
  const double flux = Mean(t.transport.ViewFlux());
  const double estimate = t.transport.ErrorEstimate();
  t.transport.SetView(t.stage.View());
  t.transport.Solve();
  EXPECT_NEAR(Mean(t.transport.ViewFlux()) / flux, 1.0, 0.1 * 0.05);
  EXPECT_NEAR(t.transport.ErrorEstimate() / estimate, 1.0, 0.1);
}

TEST(GoalOrientedTransport, ItEndsOnlyWhenNothingThatRestsMayBeRefinedEither)
{
  // Elements that cannot be split: what is seen ends early, what rests has clusters still.
  LabyrinthSettings rooms;
  rooms.rows = 1;
  rooms.columns = 10;
  Scene scene = MakeLabyrinth(rooms);
  scene.cameras.resize(1);
  GoalOrientedSettings settings;
  settings.maximumLevel = 0;
  Transported t(scene, settings);
  t.transport.SetView(t.stage.View());
  t.transport.Solve();
  while (t.transport.Refine(0.45) > 0)
  {
    t.transport.Solve();
  }
  const OpenTree& tree = t.transport.Tree();
  const std::vector<Link> links = t.transport.Links();
  const LinkErrors errors(
    tree, links, t.transport.Radiance(), t.transport.Importance(), test::NoClosure(tree));
  for (std::size_t i = 0; i < links.size(); ++i)
  {
    if (KindOf(tree, links[i]) == WithCluster)
    {
      ASSERT_EQ(errors.OfLinks()[i], 0.0) << "link " << i;
    }
  }
}

TEST(GoalOrientedTransport, TwiceTheEmissionIsTwiceTheRadianceOnTheSameLinks)
{
  Transported t(test::MakeFurnishedRoom());
  t.transport.SetView(t.stage.View());
  t.Run(6);
  // From the beginning, as after other materials.
  t.transport.SetOptics(t.stage.optics);
  t.transport.Solve();
  std::vector<Color> once;
  for (OpenId id = 0; id < t.transport.Tree().Size(); ++id)
  {
    once.push_back(t.transport.Radiance().Value(id));
  }
  const double estimate = t.transport.ErrorEstimate();
  const std::size_t links = t.transport.LinkCount();
  std::vector<PatchOptics> brighter = t.stage.optics;
  for (PatchOptics& patch : brighter)
  {
    patch.emission *= 2.0;
  }
  t.transport.SetOptics(brighter);
  EXPECT_EQ(t.transport.LinkCount(), links);
  t.transport.Solve();
  ASSERT_EQ(t.transport.LinkCount(), links);
  for (OpenId id = 0; id < t.transport.Tree().Size(); ++id)
  {
    ASSERT_NEAR(glm::length(t.transport.Radiance().Value(id) - 2.0 * once[id]), 0.0,
      2e-3 * glm::length(once[id]))
      << "node " << id;
  }
  EXPECT_NEAR(t.transport.ErrorEstimate() / estimate, 1.0, 0.01);
}

TEST(GoalOrientedTransport, NoSplitGoesBelowTheSmallestSize)
{
  GoalOrientedSettings settings;
  settings.minimumElementSize = 0.3;
  Transported t(test::MakeFurnace(Color(0.5)), settings);
  t.transport.SetView(t.stage.View());
  t.transport.Solve();
  int rounds = 0;
  while (t.transport.Refine(1.0) > 0 && ++rounds < 50)
  {
    t.transport.Solve();
  }
  // Facets of area 1: sides of 1/2 are allowed, of 1/4 are not. All pairs are linked then.
  EXPECT_EQ(t.transport.LeafCount(), 6u * 4u);
  EXPECT_EQ(t.transport.LinkCount(), 15u * 16u);

  settings.minimumElementSize = 1e-3;
  settings.maximumLevel = 1;
  Transported byLevel(test::MakeFurnace(Color(0.5)), settings);
  byLevel.transport.SetView(byLevel.stage.View());
  byLevel.transport.Solve();
  for (rounds = 0; byLevel.transport.Refine(1.0) > 0 && rounds < 50; ++rounds)
  {
    byLevel.transport.Solve();
  }
  EXPECT_EQ(byLevel.transport.LeafCount(), 6u * 4u);
}

TEST(GoalOrientedTransport, WithoutAnyLightThereIsNothingToDo)
{
  Transported t(test::MakeRoom());
  t.transport.SetView(t.stage.View());
  t.transport.Solve();
  EXPECT_EQ(t.transport.ViewFlux(), Color(0.0));
  EXPECT_EQ(t.transport.ErrorEstimate(), 0.0);
  EXPECT_EQ(t.transport.Refine(1.0), 0u);
}

TEST(GoalOrientedTransport, ASinglePanelIsItsOwnWorld)
{
  Scene scene;
  scene.materials = { test::MakeMaterial(Color(0.5), Color(2.0)) };
  test::AddPanel(scene, Vec3(0.0), Vec2(1.0, 1.0), true, 0);
  scene.cameras.push_back(test::InsideCamera());
  Transported t(scene);
  t.transport.SetView(t.stage.View());
  t.transport.Solve();
  EXPECT_EQ(t.transport.LinkCount(), 0u);
  EXPECT_NEAR(Mean(t.transport.ViewFlux()), 2.0 * t.transport.Tree()[0].view, 1e-12);
  EXPECT_GT(t.transport.Tree()[0].view, 0.0);
  EXPECT_EQ(t.transport.Refine(1.0), 0u);
}

TEST(GoalOrientedTransport, AnEstimateIsNotZeroWhereLightMayStillCome)
{
  // What has been found dark by a few rays may be lit: as long as links could carry light, a view
  // that received none is not done.
  for (const double slit : { 0.1, 0.03, 0.01 })
  {
    Transported t(test::MakeRoomsWithASlit(slit));
    t.transport.SetView(t.stage.View());
    t.transport.Solve();
    for (int round = 0; round < 12; ++round)
    {
      EXPECT_GT(t.transport.ErrorEstimate(), 0.01) << "slit " << slit << ", round " << round;
      t.transport.Refine(0.5);
      t.transport.Solve();
    }
    EXPECT_GT(Mean(t.transport.ViewFlux()), 0.0) << "slit " << slit;
  }
}

} // namespace
} // namespace vantage
