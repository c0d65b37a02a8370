#include "core/visibility/ConvexRegion.h"

#include "core/visibility/TestScenes.h"

#include <gtest/gtest.h>

namespace vantage
{
namespace
{

using namespace testing;

constexpr double Tolerance = 1e-9;

Polygon Square(const Vec3& corner, const Vec3& u, const Vec3& v)
{
  return { corner, corner + u, corner + u + v, corner + v };
}

bool Holds(const ConvexRegion& region, const Vec3& x)
{
  for (int k = 0; k < region.planeCount; ++k)
  {
    if (region.planes[k].Distance(x) < -Tolerance)
    {
      return false;
    }
  }
  return glm::all(glm::lessThanEqual(region.low - Tolerance, x)) &&
         glm::all(glm::lessThanEqual(x, region.high + Tolerance));
}

TEST(Shaft, OfFacingSquaresIsTheBoxBetweenThem)
{
  const Polygon floor = Square({ 0, 0, 0 }, { 1, 0, 0 }, { 0, 1, 0 });
  const Polygon ceiling = Square({ 0, 0, 2 }, { 0, 1, 0 }, { 1, 0, 0 });
  const auto shaft = Shaft(floor, ceiling, Tolerance);
  ASSERT_TRUE(shaft);
  EXPECT_EQ(shaft->planeCount, 6);
  EXPECT_EQ(shaft->high, Vec3(1, 1, 2));
  EXPECT_FALSE(Shaft(Reversed(floor), ceiling, Tolerance));
}

TEST(Shaft, HoldsAllSegmentsAndHasASupportingPlaneAtEveryEdge)
{
  int shafts = 0;
  for (std::uint64_t seed = 0; seed < 2000; ++seed)
  {
    SCOPED_TRACE("seed " + std::to_string(seed));
    RandomStream random(seed);
    const Polygon p{ RandomPoint(random), RandomPoint(random), RandomPoint(random) };
    const Polygon q{ RandomPoint(random), RandomPoint(random), RandomPoint(random) };
    const Polygon a = ClipToFront(p, SupportingPlane(q), Tolerance);
    const Polygon b = ClipToFront(q, SupportingPlane(p), Tolerance);
    if (a.Empty() || b.Empty())
    {
      continue;
    }
    const auto shaft = Shaft(a, b, Tolerance);
    ASSERT_TRUE(shaft);
    ++shafts;
    for (int i = 0; i < 20; ++i)
    {
      const Vec3 u = a[i % a.Size()];
      const Vec3 v = b[i / 4 % b.Size()];
      ASSERT_TRUE(Holds(*shaft, u + random.Next() * (v - u)));
    }
    // Outside of the hull: from the middle through a corner and beyond.
    const Vec3 middle = 0.5 * (Centroid(a) + Centroid(b));
    ASSERT_FALSE(Holds(*shaft, middle + 1.01 * (a[0] - middle)));
  }
  EXPECT_GT(shafts, 500);
}

TEST(Shaft, ToPointsHoldsAllSegmentsAndLeavesOutWhatIsBeside)
{
  for (std::uint64_t seed = 0; seed < 500; ++seed)
  {
    SCOPED_TRACE("seed " + std::to_string(seed));
    RandomStream random(seed);
    const Polygon base{ RandomPoint(random), RandomPoint(random), RandomPoint(random) };
    const Plane ground = SupportingPlane(base);
    std::vector<Vec3> points;
    for (int i = 0; i < 20; ++i)
    {
      const Vec3 point = RandomPoint(random);
      points.push_back(
        point + std::max(0.0, -2.0 * ground.Distance(point)) * ground.normal); // to the front
    }
    const ConvexRegion shaft = ShaftTo(base, points, Tolerance);
    double reach = 0.0;
    for (const Vec3& point : points)
    {
      reach = std::max(reach, ground.Distance(point));
      ASSERT_TRUE(Holds(shaft, base[0] + random.Next() * (point - base[0])));
      ASSERT_TRUE(Holds(shaft, Centroid(base) + random.Next() * (point - Centroid(base))));
    }
    // Beyond a corner of the base, below it, and above all points.
    const Vec3 middle = Centroid(base);
    ASSERT_FALSE(Holds(shaft, middle + 1.01 * (base[0] - middle)));
    ASSERT_FALSE(Holds(shaft, middle - 0.01 * ground.normal));
    ASSERT_FALSE(Holds(shaft, middle + 1.01 * reach * ground.normal));
  }
}

TEST(ReachesInto, TouchingIsNotEnough)
{
  ConvexRegion box = BoxRegion({ 0, 0, 0 }, { 1, 1, 1 }, -0.5 * Tolerance);
  EXPECT_FALSE(ReachesInto(Square({ 0, 0, 1 }, { 1, 0, 0 }, { 0, 1, 0 }), box, Tolerance));
  EXPECT_TRUE(ReachesInto(Square({ 0, 0, 1 - 1e-6 }, { 1, 0, 0 }, { 0, 1, 0 }), box, Tolerance));
  EXPECT_FALSE(ReachesInto(Square({ 1, 0, 0 }, { 1, 0, 0 }, { 0, 0, 1 }), box, Tolerance));
  // Larger than the region, through its middle and past its corner.
  EXPECT_TRUE(ReachesInto(Square({ -9, -9, 0.5 }, { 20, 0, 0 }, { 0, 20, 0 }), box, Tolerance));
  const Polygon pastCorner{ { 3.1, 0, 0 }, { 0, 3.1, 0 }, { 0, 0, 3.1 } };
  EXPECT_FALSE(ReachesInto(pastCorner, box, Tolerance));
}

TEST(BoxRegion, TouchingABoxIsEnough)
{
  const ConvexRegion box = BoxRegion({ 0, 0, 0 }, { 1, 1, 1 }, Tolerance);
  EXPECT_TRUE(ReachesInto(Square({ 0, 0, 1 }, { 1, 0, 0 }, { 0, 1, 0 }), box, Tolerance));
  EXPECT_FALSE(ReachesInto(Square({ 0, 0, 1.001 }, { 1, 0, 0 }, { 0, 1, 0 }), box, Tolerance));
}

} // namespace
} // namespace vantage
