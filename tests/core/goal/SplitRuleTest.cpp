#include "core/goal/SplitRule.h"

#include "core/goal/GoalScenes.h"

#include <gtest/gtest.h>

#include <array>
#include <tuple>

namespace vantage
{
namespace
{

using Ends = std::array<bool, 2>;

/// A cube with an edge of 1, opened to elements that are a quarter of its faces.
struct OpenedCube
{
  test::Stage stage{ test::MakeFurnace(Color(0.5)) };
  OpenTree tree = stage.MakeOpenTree();

  OpenedCube() { test::OpenTo(this->tree, 1); }

  /// The first node for which that is true, after `skipped` of them.
  template <typename Test>
  OpenId Find(const Test& test, int skipped = 0) const
  {
    for (OpenId id = 0; id < this->tree.Size(); ++id)
    {
      if (test(this->tree[id]) && skipped-- == 0)
      {
        return id;
      }
    }
    return None;
  }
  OpenId Surface(int level, int skipped = 0) const
  {
    return this->Find(
      [&](const OpenNode& n) { return !n.IsCluster() && n.level == level; }, skipped);
  }
};

Link Between(OpenId a, OpenId b)
{
  Link link;
  link.ends = { a, b };
  return link;
}

TEST(SplitRule, TheLargerOfTwoSurfacesIsSplitAndBothOfOneSize)
{
  const OpenedCube cube;
  SplitRule rule(0.01, 10);
  rule.Follow(cube.tree);
  const OpenId face = cube.Surface(0);
  const OpenId part = cube.Surface(1, 4);
  EXPECT_EQ(rule.EndsToSplit(cube.tree, Between(face, part)), (Ends{ true, false }));
  EXPECT_EQ(rule.EndsToSplit(cube.tree, Between(part, face)), (Ends{ false, true }));
  EXPECT_EQ(rule.EndsToSplit(cube.tree, Between(face, cube.Surface(0, 1))), (Ends{ true, true }));
}

TEST(SplitRule, AClusterIsSplitBeforeASurface)
{
  const OpenedCube cube;
  SplitRule rule(0.01, 10);
  rule.Follow(cube.tree);
  const OpenId face = cube.Surface(0);
  EXPECT_EQ(rule.EndsToSplit(cube.tree, Between(0, face)), (Ends{ true, false }));
  EXPECT_EQ(rule.EndsToSplit(cube.tree, Between(face, 0)), (Ends{ false, true }));
  EXPECT_EQ(rule.EndsToSplit(cube.tree, Between(0, 0)), (Ends{ true, true }));
}

TEST(SplitRule, PartsKeepTheMinimumLengthAndTheMaximumLevel)
{
  const OpenedCube cube;
  const Link faces = Between(cube.Surface(0), cube.Surface(0, 1));
  const Link parts = Between(cube.Surface(1), cube.Surface(1, 4));
  const Link mixed = Between(cube.Surface(0), cube.Surface(1, 8));
  const Link clusters = Between(0, 0);
  // A face has edges of 1, its parts of a half, theirs of a quarter.
  for (const auto& [length, level, mayFaces, mayParts] : { std::tuple(0.24, 10, true, true),
         std::tuple(0.26, 10, true, false), std::tuple(0.51, 10, false, false),
         std::tuple(0.01, 1, true, false), std::tuple(0.01, 0, false, false) })
  {
    SplitRule rule(length, level);
    rule.Follow(cube.tree);
    EXPECT_EQ(rule.MayRefine(faces), mayFaces) << length << ' ' << level;
    EXPECT_EQ(rule.MayRefine(parts), mayParts) << length << ' ' << level;
    EXPECT_EQ(rule.MayRefine(mixed), mayFaces) << length << ' ' << level;
    EXPECT_TRUE(rule.MayRefine(clusters));
  }
  SplitRule rule(0.26, 10);
  rule.Follow(cube.tree);
  EXPECT_EQ(rule.EndsToSplit(cube.tree, mixed), (Ends{ true, false }));
}

} // namespace
} // namespace vantage
