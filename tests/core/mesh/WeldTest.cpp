#include "core/mesh/Weld.h"

#include "core/mesh/MeshScenes.h"

#include <gtest/gtest.h>

namespace vantage
{
namespace
{

TEST(Weld, SharesEqualPositionsWithoutTolerance)
{
  const WeldedPoints welded = Weld({ { 1, 0, 0 }, { 0, 0, 0 }, { 1, 0, 0 }, { 1, 1e-15, 0 } }, 0.0);
  EXPECT_EQ(welded.points, (std::vector<Vec3>{ { 0, 0, 0 }, { 1, 0, 0 }, { 1, 1e-15, 0 } }));
  EXPECT_EQ(welded.indices, (std::vector<std::uint32_t>{ 1, 0, 1, 2 }));
  EXPECT_EQ(welded.moved, 0u);
}

TEST(Weld, JoinsWithinTheToleranceAndNotBeyond)
{
  const double tolerance = 1e-3;
  for (const Vec3& direction : { Vec3(1, 0, 0), Vec3(0, 1, 0), Vec3(0, 0, 1), Vec3(0.6, 0, -0.8) })
  {
    const Vec3 a(5.0, 7.0, 9.0);
    EXPECT_EQ(Weld({ a, a + 0.999 * tolerance * direction }, tolerance).points.size(), 1u);
    EXPECT_EQ(Weld({ a, a + 1.001 * tolerance * direction }, tolerance).points.size(), 2u);
  }
}

/// The cells of the grid must not matter: compares with all pairs.
TEST(Weld, AgreesWithAllPairs)
{
  for (std::uint64_t seed = 0; seed < 20; ++seed)
  {
    SCOPED_TRACE(seed);
    RandomStream random(seed);
    const double tolerance = 0.02;
    std::vector<Vec3> positions;
    for (int i = 0; i < 300; ++i)
    {
      positions.emplace_back(random.Next(), random.Next(), 0.1 * random.Next());
    }
    std::vector<std::size_t> setOf(positions.size());
    std::iota(setOf.begin(), setOf.end(), 0u);
    for (std::size_t i = 0; i < positions.size(); ++i)
    {
      for (std::size_t j = 0; j < i; ++j)
      {
        if (glm::length(positions[i] - positions[j]) <= tolerance)
        {
          std::replace(setOf.begin(), setOf.end(), setOf[i], setOf[j]);
        }
      }
    }
    const WeldedPoints welded = Weld(positions, tolerance);
    EXPECT_EQ(welded.points.size() + welded.moved, positions.size());
    for (std::size_t i = 0; i < positions.size(); ++i)
    {
      for (std::size_t j = 0; j < i; ++j)
      {
        ASSERT_EQ(welded.indices[i] == welded.indices[j], setOf[i] == setOf[j]) << i << " " << j;
      }
    }
  }
}

TEST(Weld, DoesNotDependOnTheOrder)
{
  RandomStream random(7);
  std::vector<Vec3> positions;
  for (int i = 0; i < 500; ++i)
  {
    positions.emplace_back(random.Next(), random.Next(), random.Next());
    positions.push_back(positions.back() + Vec3(0.0, 0.01 * random.Next(), 0.0));
  }
  const std::vector<Vec3> points = Weld(positions, 0.02).points;
  EXPECT_TRUE(std::is_sorted(points.begin(), points.end(),
    [](const Vec3& a, const Vec3& b)
    { return std::tie(a.x, a.y, a.z) < std::tie(b.x, b.y, b.z); }));
  for (int round = 0; round < 5; ++round)
  {
    test::Shuffle(positions, random);
    EXPECT_EQ(Weld(positions, 0.02).points, points);
  }
}

} // namespace
} // namespace vantage
