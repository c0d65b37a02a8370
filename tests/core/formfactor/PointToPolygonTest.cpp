#include "core/formfactor/FormFactor.h"
#include "core/formfactor/Shapes.h"

#include <gtest/gtest.h>

namespace vantage
{
namespace
{

const Vec3 Up(0, 0, 1);

/// From a point in the plane of one corner, facing a rectangle a x b at distance c (Howell, B-3),
/// times pi.
double CornerRectangle(double a, double b, double c)
{
  const double x = a / c, y = b / c;
  const double rx = std::sqrt(1 + x * x), ry = std::sqrt(1 + y * y);
  return 0.5 * (x / rx * std::atan(y / rx) + y / ry * std::atan(x / ry));
}

TEST(PointToPolygon, RectangleAboveItsCorner)
{
  for (const double c : { 1e-6, 0.1, 1.0, 30.0 })
  {
    const double seen = PointToPolygon(Vec3(0.0), Up, Ceiling(c, 1.0, 2.0));
    EXPECT_NEAR(seen / CornerRectangle(1.0, 2.0, c), 1.0, 1e-13) << c; // rounding
  }
}

TEST(PointToPolygon, FarPolygonsKeepTheirDigits)
{
  // The relative error of the centre's value is of order (size / distance)^2; what is lost to
  // cancellation is 1e-16 times the distance in sizes.
  const Polygon far = Ceiling(1e4);
  EXPECT_NEAR(PointToPolygon(Vec3(0.5, 0.5, 0), Up, far) * 1e8, 1.0, 1e-8);
}

TEST(PointToPolygon, AWidePlaneFillsTheHemisphere)
{
  const Polygon sky = Reversed(Floor(2e6, 2e6, 1.0));
  EXPECT_NEAR(PointToPolygon(Vec3(1e6, 1e6, 0), Up, sky), Pi, 1e-11); // pi (1 - 1/R^2)
}

TEST(PointToPolygon, OnlyTheFrontIsSeen)
{
  EXPECT_GT(PointToPolygon(Vec3(0.5, 0.5, 0), Up, Ceiling(1)), 0.0);
  EXPECT_EQ(PointToPolygon(Vec3(0.5, 0.5, 0), Up, Floor(1, 1, 1)), 0.0);
  EXPECT_EQ(PointToPolygon(Vec3(0.5, 0.5, 0), -Up, Ceiling(1)), 0.0);
}

TEST(PointToPolygon, TheHorizonCuts)
{
  // A wall from -1 to 1 seen from the ground is as its upper half.
  const Vec3 x(1.0, 0.3, 0.0);
  const Polygon whole{ { 0, 0, -1 }, { 0, 1, -1 }, { 0, 1, 1 }, { 0, 0, 1 } };
  const Polygon upper{ { 0, 0, 0 }, { 0, 1, 0 }, { 0, 1, 1 }, { 0, 0, 1 } };
  EXPECT_NEAR(PointToPolygon(x, Up, whole), PointToPolygon(x, Up, upper), 1e-15);
  EXPECT_GT(PointToPolygon(x, Up, whole), 0.1);
}

TEST(PointToPolygon, PointsOnThePolygonAreFinite)
{
  const Polygon p = Ceiling(0);
  for (const Vec3& x : { p[0], 0.5 * (p[0] + p[1]), Vec3(0.5, 0.5, 0.0), Vec3(2, 0, 0) })
  {
    EXPECT_EQ(PointToPolygon(x, Up, p), 0.0);
  }
  const double below = PointToPolygon(Vec3(0.5, 0.5, -1e-12), Up, p);
  EXPECT_NEAR(below, Pi, 1e-10);
}

} // namespace
} // namespace vantage
