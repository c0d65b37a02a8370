#include "core/goal/HiddenLight.h"

#include "core/goal/GoalScenes.h"
#include "core/math/Sampling.h"

#include <gtest/gtest.h>

namespace vantage
{
namespace
{

/// A hidden link of clusters after so many rays, which could carry 1 m^2 sr.
Link Hidden(std::uint32_t rays)
{
  Link link;
  link.ends = { 0, 1 };
  link.visibility = 0.0;
  link.agreeingRays = rays;
  link.uncertainty = 1.0 / (rays + 2.0);
  return link;
}

double Expected(const HiddenLight& light, std::uint32_t rays)
{
  return light.Doubt(Hidden(rays)) * Hidden(rays).uncertainty;
}

TEST(HiddenLight, ConcernsLinksOfClustersThatNoRayGotThrough)
{
  test::Stage stage{ test::MakeLitBox() };
  OpenTree tree = stage.MakeOpenTree();
  test::OpenTo(tree, 0);
  OpenId surface = 0;
  while (tree[surface].IsCluster())
  {
    ++surface;
  }
  ASSERT_TRUE(tree[0].IsCluster());
  ASSERT_TRUE(tree[1].IsCluster());
  Link link = Hidden(10);
  EXPECT_TRUE(HiddenLight::Concerns(tree, link));
  link.ends = { 0, surface };
  EXPECT_TRUE(HiddenLight::Concerns(tree, link));
  link.ends = { surface, surface + 1 };
  EXPECT_EQ(HiddenLight::Concerns(tree, link), tree[surface + 1].IsCluster());
  link.ends = { 0, 0 };
  EXPECT_FALSE(HiddenLight::Concerns(tree, link)); // of itself, neighbours see each other
  link = Hidden(10);
  link.visibility = 0.1;
  EXPECT_FALSE(HiddenLight::Concerns(tree, link));
}

TEST(HiddenLight, NothingLearntLeavesTheRule)
{
  for (const std::uint32_t rays : { 0u, 1u, 16u, 1000u, 4000000000u })
  {
    EXPECT_DOUBLE_EQ(HiddenLight().Doubt(Hidden(rays)), 1.0) << rays;
  }
}

TEST(HiddenLight, LinksThatCarriedNothingTakeDoubtAway)
{
  HiddenLight light;
  for (int i = 0; i < 96; ++i)
  {
    light.Learn(Hidden(20), 0.0);
  }
  // The rule counts as 32 links, of 128.
  EXPECT_NEAR(light.Doubt(Hidden(20)), 0.25, 1e-15);
  EXPECT_NEAR(light.Doubt(Hidden(15)), 0.25, 1e-15);   // much the same number of rays
  EXPECT_EQ(light.Doubt(Hidden(5)), 1.0);              // says nothing of fewer rays ...
  EXPECT_LE(Expected(light, 40), Expected(light, 20)); // ... but bounds what more can leave
}

TEST(HiddenLight, LinksThatCarriedMuchKeepTheRule)
{
  HiddenLight light;
  for (int i = 0; i < 50; ++i)
  {
    light.Learn(Hidden(20), 2.0); // counts as all that is possible
  }
  EXPECT_EQ(light.Doubt(Hidden(20)), 1.0);
  for (int i = 0; i < 1000; ++i)
  {
    light.Learn(Hidden(20), 0.01);
  }
  // The mean over 50 that carried all, 1000 a hundredth and 32 of the rule is above that.
  EXPECT_EQ(light.Doubt(Hidden(20)), 1.0);
  for (int i = 0; i < 1000; ++i)
  {
    light.Learn(Hidden(20), 0.01);
  }
  EXPECT_NEAR(Expected(light, 20), (50.0 + 20.0 + 32.0 / 22.0) / 2082.0, 1e-15); // round-off
}

TEST(HiddenLight, MoreRaysNeverLeaveMore)
{
  for (std::uint64_t seed = 1; seed <= 50; ++seed)
  {
    RandomStream random(seed);
    HiddenLight light;
    for (int i = 0; i < 200; ++i)
    {
      const auto rays = static_cast<std::uint32_t>(300.0 * random.Next() * random.Next());
      light.Learn(Hidden(rays), random.Next() < 0.1 ? 0.1 * random.Next() : 0.0);
    }
    double last = 1.0;
    for (std::uint32_t rays = 0; rays < 1000; ++rays)
    {
      const double expected = Expected(light, rays);
      EXPECT_GT(expected, 0.0);
      EXPECT_LE(expected, last * (1.0 + 1e-12)) << "seed " << seed << ", " << rays << " rays";
      last = expected;
    }
  }
}

} // namespace
} // namespace vantage
