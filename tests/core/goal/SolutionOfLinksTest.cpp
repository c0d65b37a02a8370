#include "core/goal/SolutionOfLinks.h"

#include "core/goal/GoalScenes.h"
#include "core/scene/Labyrinth.h"
#include "properties/RandomScene.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace vantage
{
namespace
{

struct Solved
{
  Solved(
    const Scene& scene, int rounds, double share = 0.5, const GoalOrientedSettings& settings = {})
    : stage(scene)
    , transport(stage.MakeTree(), stage.occluders, stage.optics, stage.facets.meanArea, settings)
  {
    transport.SetView(stage.View());
    transport.Solve();
    for (int round = 0; round < rounds; ++round)
    {
      transport.Refine(share);
      transport.Solve();
    }
    solution = SolutionOfLinks(transport);
  }

  const OpenTree& Tree() const { return this->transport.Tree(); }
  /// Whether the leaf names the lamp.
  bool Names(OpenId leaf, PatchId lamp) const
  {
    const RadianceSolution::Element& element = solution.elements[leaf];
    return std::binary_search(
      solution.lamps.begin() + element.firstLamp, solution.lamps.begin() + element.lastLamp, lamp);
  }

  test::Stage stage;
  GoalOrientedTransport transport;
  RadianceSolution solution;
};

TEST(SolutionOfLinks, HasTheRadianceOfEveryLeafWhereItLies)
{
  const Solved s(test::MakeFurnishedRoom(), 10);
  const OpenTree& tree = s.Tree();
  ASSERT_EQ(s.solution.elements.size(), tree.Size());
  for (const OpenId leaf : test::LeavesOf(tree))
  {
    const RadianceSolution::Element& element = s.solution.elements[leaf];
    EXPECT_EQ(element.node, tree[leaf].node);
    EXPECT_EQ(element.childCount, 0);
    EXPECT_EQ(element.reflected, s.transport.Radiance().Received(leaf));
    if (!tree[leaf].IsCluster())
    {
      const Vec3 point = Centroid(tree.Shape(leaf));
      EXPECT_EQ(s.solution.LeafAt(tree[leaf].patch, point), leaf);
    }
  }
  for (PatchId patch = 0; patch < tree.Tree().Patches().size(); ++patch)
  {
    EXPECT_EQ(s.solution.IsActive(patch), tree.Tree().Patches()[patch].IsActive());
    EXPECT_EQ(s.solution.emission[patch], s.stage.optics[patch].emission);
    EXPECT_EQ(s.solution.albedo[patch], s.stage.optics[patch].albedo);
  }
}

std::vector<PatchId> AllLamps(const Solved& s)
{
  std::vector<PatchId> lamps;
  for (PatchId patch = 0; patch < s.stage.optics.size(); ++patch)
  {
    if (MaxChannel(s.stage.optics[patch].emission) > 0.0)
    {
      lamps.push_back(patch);
    }
  }
  return lamps;
}

void ExpectOneElementForAll(const Solved& s)
{
  ASSERT_EQ(s.solution.elements.size(), 1u);
  for (PatchId patch = 0; patch < s.solution.elementOfPatch.size(); ++patch)
  {
    EXPECT_TRUE(
      !s.Tree().Tree().Patches()[patch].IsActive() || s.solution.elementOfPatch[patch] == 0u);
  }
}

TEST(SolutionOfLinks, BeforeAnythingWasLookedIntoManyLampsAreUnnamed)
{
  LabyrinthSettings size;
  size.rows = 5;
  size.columns = 5;
  const Solved s(MakeLabyrinth(size), 0);
  ASSERT_GT(AllLamps(s).size(), 16u);
  ExpectOneElementForAll(s);
  const Link link = s.transport.Links()[0];
  const Color expected = link.throughput / s.Tree()[0].area * s.Tree()[0].emission;
  EXPECT_NEAR(glm::length(s.solution.elements[0].unnamedDirect - expected), 0.0, 1e-12);
  EXPECT_TRUE(s.solution.lamps.empty());
}

TEST(SolutionOfLinks, FewLampsAreNamedBeforeAnythingWasLookedInto)
{
  const Solved s(test::MakeFurnishedRoom(), 0);
  ExpectOneElementForAll(s);
  EXPECT_EQ(s.solution.elements[0].unnamedDirect, Color(0.0));
  EXPECT_EQ(s.solution.lamps, AllLamps(s));
  // What they give is not indirect light as well.
  EXPECT_LT(Mean(s.solution.elements[0].indirect), Mean(s.solution.elements[0].reflected));
}

/// However many facets it has, and however little it gives.
TEST(SolutionOfLinks, ALampThatWasCutIsNamedAsAWhole)
{
  Scene scene = test::MakeFurnishedRoom();
  scene.materials.push_back(test::MakeMaterial(Color(0.0), Color(0.01), false));
  test::AddBall(
    scene, { 0.7, 0.7, 0.7 }, 0.1, 16, static_cast<std::uint32_t>(scene.materials.size() - 1));
  for (const int rounds : { 0, 2, 5 })
  {
    const Solved s(scene, rounds, 1.0);
    std::size_t names = 0;
    for (const OpenId leaf : test::LeavesOf(s.Tree()))
    {
      const RadianceSolution::Element& element = s.solution.elements[leaf];
      EXPECT_EQ(element.unnamedDirect, Color(0.0)) << "node " << leaf;
      names = std::max<std::size_t>(names, element.lastLamp - element.firstLamp);
    }
    EXPECT_GE(names, 960u) << rounds << " rounds";
  }
}

/// For each lamp and leaf: light is counted once, under a name or without.
TEST(SolutionOfLinks, LampsAreNamedOrTheirLightIsUnnamed)
{
  for (std::uint64_t seed = 1; seed <= 5; ++seed)
  {
    SCOPED_TRACE("seed " + std::to_string(seed));
    const Solved s(test::MakeRandomScene(seed), 14);
    std::size_t names = 0;
    const OpenTree& tree = s.Tree();
    for (const OpenId leaf : test::LeavesOf(tree))
    {
      Color unnamed(0.0);
      std::vector<PatchId> named;
      for (const Link& link : s.transport.Links())
      {
        for (int end = 0; end < (link.IsSelf() ? 1 : 2); ++end)
        {
          const OpenNode& lamp = tree[link.ends[1 - end]];
          if (!test::IsBelow(tree, leaf, link.ends[end]) || !(Mean(lamp.emission) > 0.0))
          {
            continue;
          }
          const OpenId to = link.ends[end];
          const Color irradiance = link.throughput / tree[to].area * lamp.emission;
          // The scene has few lamps: those of a cluster stay without names where they hardly count.
          if (lamp.IsCluster() && Mean(tree[to].albedo) / Pi * Mean(irradiance) <
                                    1e-3 * Mean(s.transport.Radiance().Received(to)))
          {
            unnamed += irradiance;
          }
          else if (link.throughput > 0.0)
          {
            const std::vector<PatchId> lamps =
              lamp.IsCluster() ? tree.Patches().LampsIn(tree.RangeOf(link.ends[1 - end]))
                               : std::vector<PatchId>{ lamp.patch };
            named.insert(named.end(), lamps.begin(), lamps.end());
          }
        }
      }
      const RadianceSolution::Element& element = s.solution.elements[leaf];
      ASSERT_NEAR(glm::length(element.unnamedDirect - unnamed), 0.0, 1e-9);
      names += named.size();
      for (const PatchId lamp : named)
      {
        EXPECT_TRUE(s.Names(leaf, lamp)) << "node " << leaf << ", lamp " << lamp;
      }
      EXPECT_TRUE(std::is_sorted(
        s.solution.lamps.begin() + element.firstLamp, s.solution.lamps.begin() + element.lastLamp));
    }
  }
}

TEST(SolutionOfLinks, WhatSeesALampNamesIt)
{
  // All links are refined to elements.
  GoalOrientedSettings settings;
  settings.maximumLevel = 1;
  const Solved s(test::MakeFurnishedRoom(), 16, 1.0, settings);
  const OpenTree& tree = s.Tree();
  const OpenId lamp = test::PatchAt(tree, Vec3(0.45, 0.5, 0.95), Vec3(0, 0, -1));
  ASSERT_NE(lamp, None);
  int seeing = 0;
  for (const OpenId leaf : test::LeavesOf(tree))
  {
    ASSERT_FALSE(tree[leaf].IsCluster());
    const Vec3 centre = Centroid(tree.Shape(leaf));
    const Vec3 way = Centroid(tree.Shape(lamp)) - centre;
    const bool sees = glm::dot(tree.PatchOf(leaf).normal, way) > 0.0 && way.z > 0.0 &&
                      !s.stage.occluders.IsOccluded({ centre, tree.PatchOf(leaf).facet },
                        { centre + way, tree.PatchOf(lamp).facet });
    seeing += sees ? 1 : 0;
    EXPECT_TRUE(!sees || s.Names(leaf, tree[lamp].patch)) << "node " << leaf;
    EXPECT_EQ(s.solution.elements[leaf].unnamedDirect, Color(0.0));
    // The ceiling sees nothing but the back of the lamp.
    EXPECT_FALSE(s.Names(leaf, tree[lamp].patch) && tree.PatchOf(leaf).normal.z < -0.5);
  }
  EXPECT_GT(seeing, 20);
}

} // namespace
} // namespace vantage
