#include "core/math/Polygon.h"

#include <gtest/gtest.h>

namespace vantage
{
namespace
{

const Polygon UnitSquare{ { 0, 0, 0 }, { 1, 0, 0 }, { 1, 1, 0 }, { 0, 1, 0 } };
const Polygon Triangle{ { 0, 0, 2 }, { 3, 0, 2 }, { 0, 3, 2 } };

TEST(Polygon, AreaNormalAndCentroidOfKnownShapes)
{
  EXPECT_DOUBLE_EQ(Area(UnitSquare), 1.0);
  EXPECT_DOUBLE_EQ(Area(Triangle), 4.5);
  EXPECT_EQ(UnitNormal(UnitSquare), Vec3(0, 0, 1));
  EXPECT_EQ(UnitNormal(Reversed(UnitSquare)), Vec3(0, 0, -1));
  EXPECT_EQ(Centroid(UnitSquare), Vec3(0.5, 0.5, 0));
  EXPECT_EQ(Centroid(Triangle), Vec3(1, 1, 2));
}

TEST(Polygon, ClippingKeepsTheFrontPart)
{
  const Polygon half = ClipToFront(UnitSquare, { Vec3(1, 0, 0), 0.25 });
  EXPECT_DOUBLE_EQ(Area(half), 0.75);
  EXPECT_TRUE(ClipToFront(UnitSquare, { Vec3(1, 0, 0), 1.0 }).Empty());
  EXPECT_TRUE(ClipToFront(UnitSquare, { Vec3(1, 0, 0), 2.0 }).Empty());
  EXPECT_DOUBLE_EQ(Area(ClipToFront(UnitSquare, { Vec3(1, 0, 0), 0.0 })), 1.0);
}

TEST(Polygon, PointAtCoversTheShapeEvenly)
{
  EXPECT_EQ(PointAt(UnitSquare, { 0.25, 0.75 }), Vec3(0.25, 0.75, 0));
  Vec3 mean(0.0);
  const int n = 64;
  for (int i = 0; i < n * n; ++i)
  {
    mean += PointAt(Triangle, { (i % n + 0.5) / n, (i / n + 0.5) / n });
  }
  mean /= n * n;
  // Midpoint rule of a smooth map: discretisation error of order 1 / n^2, larger near u = 0.
  EXPECT_NEAR(glm::length(mean - Vec3(1, 1, 2)), 0.0, 1e-3);
}

} // namespace
} // namespace vantage
