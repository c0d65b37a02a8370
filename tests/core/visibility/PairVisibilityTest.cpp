#include "core/visibility/PairVisibility.h"

#include "core/visibility/TestScenes.h"

#include <gtest/gtest.h>

#include <cmath>

namespace vantage
{
namespace
{

using namespace testing;

/// Unit floor and ceiling at distance 1, facing each other, with something in between.
struct Pair
{
  FacetSet set;
  OccluderScene occluders;
  VisibilityEnd floor, ceiling;

  explicit Pair(const std::vector<std::vector<Vec3>>& between, const Placement& place = {})
    : set(FacetsOf(WithEnds(between), place))
    , occluders(this->set)
    , floor(this->End(place({ 0.01, 0.02, 0 })))
    , ceiling(this->End(place({ 0.01, 0.02, 1 })))
  {
  }

  static std::vector<std::vector<Vec3>> WithEnds(std::vector<std::vector<Vec3>> polygons)
  {
    polygons.push_back({ { 0, 0, 0 }, { 1, 0, 0 }, { 1, 1, 0 }, { 0, 1, 0 } });
    polygons.push_back({ { 0, 0, 1 }, { 0, 1, 1 }, { 1, 1, 1 }, { 1, 0, 1 } });
    return polygons;
  }
  VisibilityEnd End(const Vec3& point) const
  {
    const std::uint32_t facet = FacetAt(this->set, point);
    return { this->set.facets[facet].shape, facet };
  }
  PairVisibility Estimate(std::uint32_t rays = 16, std::uint64_t shift = 1) const
  {
    return EstimateVisibility(this->occluders, this->floor, this->ceiling, rays, shift);
  }
};

std::vector<Vec3> Pane(double x0, double y0, double x1, double y1, double z)
{
  return { { x0, y0, z }, { x1, y0, z }, { x1, y1, z }, { x0, y1, z } };
}

TEST(PairVisibility, EmptyShaftIsCertainlyVisible)
{
  // Walls that close the box touch the shaft; a pane outside comes close to it.
  std::vector<std::vector<Vec3>> around = BoxFaces({ 0, 0, 0 }, { 1, 1, 1 });
  around.erase(around.begin(), around.begin() + 2);
  around.push_back(Pane(1.001, 0, 2, 1, 0.5));
  for (const Placement& place : { Placement{}, Placement{ 1e-3, Vec3(1e3) }, Placement{ 1e3, {} } })
  {
    const PairVisibility seen = Pair(around, place).Estimate();
    EXPECT_EQ(seen.fraction, 1.0);
    EXPECT_TRUE(seen.isCertain);
    EXPECT_LE(seen.rays, 1u);
  }
}

TEST(PairVisibility, OnePaneThatHidesAllIsCertain)
{
  const PairVisibility exact = Pair({ Pane(0, 0, 1, 1, 0.5) }).Estimate();
  EXPECT_EQ(exact.fraction, 0.0);
  EXPECT_TRUE(exact.isCertain);
  const PairVisibility tilted =
    Pair({ { { -1, -1, 0.2 }, { 2, -1, 0.8 }, { 2, 2, 0.8 }, { -1, 2, 0.2 } } }).Estimate();
  EXPECT_EQ(tilted.fraction, 0.0);
  EXPECT_TRUE(tilted.isCertain);
}

TEST(PairVisibility, APaneThatHidesAllIsFoundBehindOthers)
{
  const std::vector<Vec3> whole = Pane(0, 0, 1, 1, 0.5);
  for (const double side : { -0.1, 0.1 })
  {
    std::vector<std::vector<Vec3>> panes{ whole };
    for (int k = 1; k <= 2; ++k)
    {
      panes.push_back(Pane(0.4, 0.4, 0.6, 0.6, 0.5 + k * side));
    }
    const PairVisibility seen = Pair(panes).Estimate();
    EXPECT_EQ(seen.fraction, 0.0);
    EXPECT_TRUE(seen.isCertain);
    EXPECT_LE(seen.rays, 3u);
  }
}

TEST(PairVisibility, TwoPanesThatHideAllTogetherAreFoundByRays)
{
  const PairVisibility seen = Pair({ Pane(0, 0, 0.6, 1, 0.5), Pane(0.6, 0, 1, 1, 0.5) }).Estimate();
  EXPECT_EQ(seen.fraction, 0.0);
  EXPECT_FALSE(seen.isCertain);
  EXPECT_EQ(seen.rays, 18u); // two for the proof that fails
}

TEST(PairVisibility, ACornerThatReachesIntoTheShaftIsNeverOverlooked)
{
  const PairVisibility seen = Pair({ Pane(0.999, 0.999, 2, 2, 0.5) }).Estimate();
  EXPECT_FALSE(seen.isCertain);
  EXPECT_GE(seen.fraction, 15.0 / 16.0);
}

TEST(PairVisibility, BackSidesSeeNothing)
{
  Pair pair({});
  pair.floor.shape = Reversed(pair.floor.shape);
  const PairVisibility seen = pair.Estimate();
  EXPECT_EQ(seen.fraction, 0.0);
  EXPECT_TRUE(seen.isCertain);
  EXPECT_EQ(seen.rays, 0u);
}

/// An end that reaches behind the other one: only the part in front counts.
TEST(PairVisibility, WhatLiesBehindTheOtherEndTakesNoPart)
{
  const FacetSet set = FacetsOf({ { { -1, 0, 0 }, { 1, 0, 0 }, { 1, 1, 0 }, { -1, 1, 0 } },
    { { 0, 0, 0 }, { 0, 1, 0 }, { 0, 1, 1 }, { 0, 0, 1 } }, // faces +x
    { { -1, 0, 0.5 }, { -0.01, 0, 0.5 }, { -0.01, 1, 0.5 }, { -1, 1, 0.5 } } });
  const OccluderScene occluders(set);
  const auto end = [&](const Vec3& x)
  {
    const std::uint32_t f = FacetAt(set, x);
    return VisibilityEnd{ set.facets[f].shape, f };
  };
  const PairVisibility seen =
    EstimateVisibility(occluders, end({ 0.5, 0.5, 0 }), end({ 0, 0.5, 0.7 }), 16, 1);
  EXPECT_EQ(seen.fraction, 1.0);
  EXPECT_TRUE(seen.isCertain);
}

TEST(PairVisibility, SwappingTheEndsChangesNothing)
{
  const FacetSet set = FacetsOf(TriangleSoup(120, 0.6, 4));
  const OccluderScene occluders(set);
  int partial = 0;
  for (std::uint64_t i = 0; i < 3000; ++i)
  {
    RandomStream random(17, i);
    const auto f = static_cast<std::uint32_t>(random.Next() * set.facets.size());
    const auto g = static_cast<std::uint32_t>(random.Next() * set.facets.size());
    const VisibilityEnd a{ set.facets[f].shape, f };
    const VisibilityEnd b{ Reversed(set.facets[g].shape), g };
    const PairVisibility one = EstimateVisibility(occluders, a, b, 16, i);
    const PairVisibility two = EstimateVisibility(occluders, b, a, 16, i);
    ASSERT_EQ(one.fraction, two.fraction) << i;
    ASSERT_EQ(one.rays, two.rays) << i;
    ASSERT_EQ(one.isCertain, two.isCertain) << i;
    partial += one.fraction > 0.0 && one.fraction < 1.0 ? 1 : 0;
  }
  EXPECT_GT(partial, 100);
}

/// What is proved must hold for many random segments.
TEST(PairVisibility, CertainMeansCertain)
{
  auto triangles = TriangleSoup(40, 0.15, 8);
  const auto large = TriangleSoup(5, 2.0, 9);
  triangles.insert(triangles.end(), large.begin(), large.end());
  const FacetSet set = FacetsOf(triangles);
  const OccluderScene occluders(set);
  int proved = 0;
  int hidden = 0;
  for (std::uint64_t i = 0; i < 3000; ++i)
  {
    SCOPED_TRACE("pair " + std::to_string(i));
    RandomStream random(23, i);
    const auto f = static_cast<std::uint32_t>(random.Next() * set.facets.size());
    const auto g = static_cast<std::uint32_t>(random.Next() * set.facets.size());
    const Polygon a = set.facets[f].shape;
    const Polygon b = set.facets[g].shape;
    const PairVisibility seen = EstimateVisibility(occluders, { a, f }, { b, g }, 4, 1);
    if (!seen.isCertain || seen.rays == 0)
    {
      continue;
    }
    ++(seen.fraction > 0.0 ? proved : hidden);
    for (int k = 0; k < 200; ++k)
    {
      const Vec3 p = PointAt(a, random.Next2());
      const Vec3 q = PointAt(b, random.Next2());
      if (SupportingPlane(a).Distance(q) > 0.0 && SupportingPlane(b).Distance(p) > 0.0)
      {
        ASSERT_EQ(occluders.IsOccluded({ p, f }, { q, g }), seen.fraction == 0.0);
      }
    }
  }
  EXPECT_GT(proved, 100);
  EXPECT_GT(hidden, 3);
}

/// Halfway between two equal facing squares a half-plane with its edge at c parallel to a side lets
/// through the segments with (u + v) / 2 > c: for c = 1/2 one half of them, for c = 1/4 seven
/// eighths.
TEST(PairVisibility, HalfPlanesHideTheExactFraction)
{
  struct Case
  {
    double edge, visible;
  };
  for (const Case& c : { Case{ 0.5, 0.5 }, Case{ 0.25, 0.875 }, Case{ 0.75, 0.125 } })
  {
    const Pair pair({ Pane(-1, -1, c.edge, 2, 0.5) });
    double sum = 0.0;
    double squares = 0.0;
    const int trials = 500;
    for (int k = 0; k < trials; ++k)
    {
      const double error = pair.Estimate(16, 100 + k).fraction - c.visible;
      sum += error;
      squares += error * error;
    }
    const double rms = std::sqrt(squares / trials);
    const double independent = std::sqrt(c.visible * (1.0 - c.visible) / 16.0);
    // Unbiased: within four standard errors of the mean, fixed seeds.
    EXPECT_NEAR(sum / trials, 0.0, 4.0 * rms / std::sqrt(trials));
    // Stratified: independent segments would leave more than 1.5 times the error.
    EXPECT_LT(rms, independent / 1.5) << c.edge;
  }
}

TEST(PairVisibility, ShadowEdgesAtAnEndAreResolvedToOnePartInRays)
{
  // A pane close above the floor with a hole in it for x > c: visible is what has x > c, up to
  // one part in n for the samples and the height of the pane.
  const double height = 1e-6;
  for (const double c : { 0.2, 0.5, 0.83 })
  {
    const Pair pair({ Pane(-1, -1, c, 2, height) });
    for (const std::uint32_t rays : { 16u, 17u, 100u, 1000u, 4096u })
    {
      // A power of two has one sample in each part; others are a sum of blocks of powers of two.
      const bool isPowerOfTwo = (rays & (rays - 1)) == 0;
      const double parts = isPowerOfTwo ? 1.0 : 1.0 + std::log2(rays);
      for (std::uint64_t shift = 0; shift < 20; ++shift)
      {
        const PairVisibility seen = pair.Estimate(rays, shift);
        ASSERT_NEAR(seen.fraction, 1.0 - c, parts / rays + 10.0 * height) << c << " " << rays;
      }
    }
  }
}

TEST(PairVisibility, DifferentShiftsGiveIndependentEstimates)
{
  const Pair pair({ Pane(0.2, 0.3, 0.9, 0.8, 0.3) });
  const int trials = 400;
  double product = 0.0;
  double squares = 0.0;
  const double mean = pair.Estimate(4096, 5).fraction;
  for (int k = 0; k < trials; ++k)
  {
    const double one = pair.Estimate(4, 2 * k).fraction - mean;
    const double two = pair.Estimate(4, 2 * k + 1).fraction - mean;
    product += one * two;
    squares += 0.5 * (one * one + two * two);
  }
  // The correlation of independent numbers has the standard deviation 1 / sqrt(trials); four of
  // them, fixed seeds.
  EXPECT_NEAR(product / squares, 0.0, 4.0 / std::sqrt(trials));
}

TEST(PairVisibility, AnyNumberOfRaysIsTraced)
{
  const Pair pair({ Pane(0.2, 0.3, 0.9, 0.8, 0.3) });
  for (std::uint32_t rays = 1; rays <= 70; ++rays)
  {
    EXPECT_EQ(pair.Estimate(rays).rays, rays + 2); // for the proof that fails
  }
}

} // namespace
} // namespace vantage
