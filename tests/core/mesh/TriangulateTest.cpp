#include "core/mesh/Triangulate.h"

#include "core/mesh/MeshScenes.h"

#include <gtest/gtest.h>

namespace vantage
{
namespace
{

double Area(const Vec2& a, const Vec2& b, const Vec2& c)
{
  return 0.5 * ((b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x));
}

double Area(const std::vector<Vec2>& polygon)
{
  double area = 0.0;
  for (std::size_t i = 2; i < polygon.size(); ++i)
  {
    area += Area(polygon[0], polygon[i - 1], polygon[i]);
  }
  return area;
}

/// All triangles are counter-clockwise and their areas add up to the polygon's. Diagonals cancel,
/// so together they wind around every point as often as the polygon does: they cover it once.
void ExpectPartition(const std::vector<Vec2>& polygon, std::size_t count)
{
  const std::vector<std::array<int, 3>> triangles = Triangulate(polygon);
  EXPECT_EQ(triangles.size(), count);
  double sum = 0.0;
  for (const auto& [a, b, c] : triangles)
  {
    const double area = Area(polygon[a], polygon[b], polygon[c]);
    EXPECT_GT(area, 0.0);
    sum += area;
  }
  EXPECT_NEAR(sum, Area(polygon), 1e-14 * polygon.size() * Area(polygon)); // round-off of the sums
}

TEST(Triangulate, CoversKnownShapesOnce)
{
  ExpectPartition({ { 0, 0 }, { 1, 0 }, { 0, 1 } }, 1);
  ExpectPartition({ { 0, 0 }, { 2, 0 }, { 2, 1 }, { 1, 1 }, { 1, 2 }, { 0, 2 } }, 4);
  ExpectPartition({ { 0, 0 }, { 4, 0 }, { 4, 3 }, { 3, 3 }, { 3, 1 }, { 2, 1 }, { 2, 3 }, { 1, 3 },
                    { 1, 1 }, { 0, 1 } },
    8);
}

TEST(Triangulate, CoversRandomStarsOnce)
{
  for (std::uint64_t seed = 0; seed < 200; ++seed)
  {
    SCOPED_TRACE(seed);
    RandomStream random(seed);
    const int n = 4 + static_cast<int>(40 * random.Next());
    std::vector<Vec2> polygon;
    for (int i = 0; i < n; ++i)
    {
      const double angle = 2.0 * Pi * (i + 0.8 * random.Next()) / n;
      const double radius = 0.2 + 0.8 * random.Next();
      polygon.emplace_back(radius * std::cos(angle), radius * std::sin(angle));
    }
    ExpectPartition(polygon, n - 2);
  }
}

TEST(Triangulate, KeepsAHoleOpenThatIsBridgedToTheOutside)
{
  // Unit hole in a square of edge 3, the bridge (0,0)-(1,1) walked in both directions.
  const std::vector<Vec2> polygon{ { 0, 0 }, { 3, 0 }, { 3, 3 }, { 0, 3 }, { 0, 0 }, { 1, 1 },
    { 1, 2 }, { 2, 2 }, { 2, 1 }, { 1, 1 } };
  ExpectPartition(polygon, 8);
}

TEST(Triangulate, ComesToAnEndOnWhatIsNoSimplePolygon)
{
  EXPECT_LE(Triangulate({ { 0, 0 }, { 1, 1 }, { 1, 0 }, { 0, 1 } }).size(), 2u); // bow tie
  EXPECT_EQ(Triangulate({ { 0, 0 }, { 1, 0 }, { 2, 0 }, { 3, 0 } }).size(), 0u); // line
  EXPECT_EQ(Triangulate({ { 0, 0 }, { 0, 0 }, { 0, 0 }, { 0, 0 } }).size(), 0u); // point
}

} // namespace
} // namespace vantage
