#include "core/formfactor/FormFactor.h"
#include "core/formfactor/Shapes.h"

#include <gtest/gtest.h>

#include <array>

namespace vantage
{
namespace
{

using Real = long double;
/// Of the quadratures, where they give 13 digits of the exact values.
constexpr Real Step = 1.0L / 20;
constexpr Real LongPi = 3.14159265358979323846264338327950288L;

struct Point
{
  Real x, y, z;
};

Point operator-(const Point& a, const Point& b)
{
  return { a.x - b.x, a.y - b.y, a.z - b.z };
}
Point Cross(const Point& a, const Point& b)
{
  return { a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x };
}
Real Dot(const Point& a, const Point& b)
{
  return a.x * b.x + a.y * b.y + a.z * b.z;
}

using Square = std::array<Point, 4>;

/// What the point (x, y) of the floor sees of a square that lies above it and faces it: Lambert's
/// sum over the edges. The angle between two directions by its tangent, which is exact for small
/// and for large ones.
Real SeenFrom(Real x, Real y, const Square& square)
{
  Real sum = 0;
  for (int k = 0; k < 4; ++k)
  {
    const Point a = square[k] - Point{ x, y, 0 };
    const Point b = square[(k + 1) % 4] - Point{ x, y, 0 };
    const Point normal = Cross(a, b);
    const Real sine = std::sqrt(Dot(normal, normal));
    sum += sine > 0 ? normal.z / sine * std::atan2(sine, Dot(a, b)) : 0;
  }
  return std::abs(sum) / (2 * LongPi);
}

using Rule = std::vector<std::pair<Real, Real>>;

/// Double exponential quadrature over [0, 1] (Takahasi and Mori 1974): its points crowd at the
/// ends, down to 1e-20, where the integrand changes.
Rule DoubleExponential(Real step)
{
  Rule rule;
  for (Real t = -3.3L; t < 3.3L; t += step)
  {
    const Real u = LongPi / 2 * std::sinh(t);
    const Real weight = step * LongPi / 4 * std::cosh(t) / (std::cosh(u) * std::cosh(u));
    rule.emplace_back(1 / (1 + std::exp(-2 * u)), weight);
  }
  return rule;
}

/// The form factor from the unit floor. Gaps at the edge x = 0 ask for finer steps along x.
Real FactorFromFloor(const Square& square, Real step)
{
  const Rule alongY = DoubleExponential(step);
  Real sum = 0;
  for (const auto& [x, xWeight] : DoubleExponential(step / 3))
  {
    for (const auto& [y, yWeight] : alongY)
    {
      sum += xWeight * yWeight * SeenFrom(x, y, square);
    }
  }
  return sum;
}

/// What both accuracies promise. What the quadrature leaves is known from another step.
void ExpectAsIntegrated(const Square& square)
{
  const Real factor = FactorFromFloor(square, Step);
  ASSERT_NEAR(FactorFromFloor(square, 1.4L * Step) / factor, 1.0, 1e-9);
  Polygon polygon;
  for (const Point& p : square)
  {
    polygon.Add(Vec3(p.x, p.y, p.z));
  }
  const double expected = Pi * static_cast<double>(factor);
  // Rounding the corners to 1e-16 turns a plane that far, which a grazing view feels.
  EXPECT_NEAR(Throughput(Floor(), polygon) / expected, 1.0, 1e-5);
  EXPECT_NEAR(Throughput(Floor(), polygon, Accuracy::Reference) / expected, 1.0, 1e-8);
}

/// A unit square that leans at the edge x = 0 of the floor, or above and beside it.
Square Leaning(Real degrees, Real beside = 0, Real above = 0, Real along = 0)
{
  const Real t = degrees * LongPi / 180;
  const Real x = std::cos(t), z = std::sin(t);
  return { Point{ -beside, along, above }, Point{ -beside, along + 1, above },
    Point{ x - beside, along + 1, z + above }, Point{ x - beside, along, z + above } };
}

TEST(Contact, TheQuadratureKnowsTheExactValues)
{
  EXPECT_NEAR(FactorFromFloor(Leaning(30), Step), 0.619028323090803, 1e-13);
  EXPECT_NEAR(FactorFromFloor(Leaning(90), Step), 0.200043776075403, 1e-13);
  EXPECT_NEAR(FactorFromFloor(Leaning(120), Step), 0.086615001118276, 1e-13);
}

TEST(Contact, SquaresThatShareAnEdgeAtAnyAngle)
{
  for (const double degrees : { 1.0, 5.0, 30.0, 90.0, 150.0, 175.0, 179.0 })
  {
    SCOPED_TRACE(degrees);
    ExpectAsIntegrated(Leaning(degrees));
  }
}

TEST(Contact, SquaresThatNearlyShareAnEdge)
{
  for (const double gap : { 1e-2, 1e-3, 1e-4, 1e-5, 1e-6, 1e-7 })
  {
    SCOPED_TRACE(gap);
    ExpectAsIntegrated(Leaning(90, gap));
    ExpectAsIntegrated(Leaning(30, 0, gap));
    ExpectAsIntegrated(Leaning(179, gap));
  }
}

TEST(Contact, SquaresThatShareACornerOrNearlyDo)
{
  for (const double gap : { 0.0, 1e-2, 1e-4, 1e-7 })
  {
    SCOPED_TRACE(gap);
    ExpectAsIntegrated(Leaning(90, 0, gap, 1));
    ExpectAsIntegrated(Leaning(60, gap, 0, 1 + gap));
  }
}

/// Three squares on one side of an edge, one on the other: their corners lie on it.
TEST(Contact, TheFactorsOfPartsThatMeetInAJunctionAddUp)
{
  for (const double degrees : { 1.0, 90.0, 179.0 })
  {
    SCOPED_TRACE(degrees);
    const double t = degrees * Pi / 180.0;
    const auto leaf = [&](double y0, double y1)
    {
      const Vec3 along(std::cos(t), 0.0, std::sin(t));
      return Polygon{ Vec3(0, y0, 0), Vec3(0, y1, 0), Vec3(0, y1, 0) + along,
        Vec3(0, y0, 0) + along };
    };
    const double whole = Throughput(Floor(), leaf(0, 1), Accuracy::Reference);
    const double parts = Throughput(Floor(), leaf(0, 0.2)) + Throughput(Floor(), leaf(0.2, 0.7)) +
                         Throughput(Floor(), leaf(0.7, 1));
    EXPECT_NEAR(parts / whole, 1.0, 1e-5);
  }
}

} // namespace
} // namespace vantage
