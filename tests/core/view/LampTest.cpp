#include "core/formfactor/FormFactor.h"
#include "core/formfactor/Shadows.h"
#include "core/math/Sampling.h"
#include "core/view/LampCutter.h"
#include "core/view/LampKernel.h"

#include "support/TestScenes.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>

namespace vantage
{
namespace
{

const Vec3 Up(0.0, 0.0, 1.0);

/// A quadrilateral or triangle around a point, turned anyhow.
Polygon RandomPolygon(const Vec3& centre, double size, RandomStream& random)
{
  const double height = 2.0 * random.Next() - 1.0;
  const double turn = 2.0 * Pi * random.Next();
  const double radius = std::sqrt(1.0 - height * height);
  const Frame frame(Vec3(radius * std::cos(turn), radius * std::sin(turn), height));
  Polygon p;
  const int corners = random.Next() < 0.5 ? 3 : 4;
  for (int i = 0; i < corners; ++i)
  {
    const double angle = 2.0 * Pi * (i + 0.6 * random.Next()) / corners;
    p.Add(centre + size * frame.ToWorld({ std::cos(angle), std::sin(angle), 0.0 }));
  }
  return p;
}

Polygon RandomLamp(RandomStream& random)
{
  const Vec3 centre(random.Next() - 0.5, random.Next() - 0.5, 0.3 + random.Next());
  return ClipToFront(RandomPolygon(centre, 0.1 + 0.5 * random.Next(), random), Plane());
}

Vec3 RandomPoint(RandomStream& random)
{
  return { 2.0 * random.Next() - 1.0, 2.0 * random.Next() - 1.0, 0.0 };
}

TEST(LampKernel, IsLambertsFormula)
{
  RandomStream random(5);
  for (int i = 0; i < 20000; ++i)
  {
    const Polygon lamp = RandomLamp(random);
    if (lamp.Empty())
    {
      continue;
    }
    const Vec3 x = RandomPoint(random);
    ASSERT_NEAR(LampKernel(lamp).At(x), PointToPolygon(x, Up, lamp), 1e-12) << "lamp " << i;
  }
}

TEST(LampKernel, KeepsItsDigitsWhenTheLampIsSmallAndFar)
{
  const Polygon lamp{ { 40.0, 0.0, 30.0 }, { 40.0, 0.01, 30.0 }, { 40.01, 0.01, 30.0 },
    { 40.01, 0.0, 30.0 } };
  const double expected = PointToPolygon(Vec3(0.0), Up, lamp);
  EXPECT_GT(expected, 1e-8);
  EXPECT_NEAR(LampKernel(lamp).At(Vec2(0.0)) / expected, 1.0, 1e-9);
}

TEST(LampKernel, IsNothingBehindTheLampAndPiRightBelowAHugeOne)
{
  Polygon lamp{ { -1e3, -1e3, 1e-3 }, { -1e3, 1e3, 1e-3 }, { 1e3, 1e3, 1e-3 },
    { 1e3, -1e3, 1e-3 } };
  EXPECT_NEAR(LampKernel(lamp).At(Vec2(0.0)), Pi, 1e-9);
  EXPECT_EQ(LampKernel(Reversed(lamp)).At(Vec2(0.0)), 0.0);
}

/// Occluders anywhere between the plane and the lamp: crossing, overlapping, hiding all.
TEST(LampCutter, SeesWhatPointToVisiblePolygonSees)
{
  RandomStream random(11);
  int cuts = 0;
  int hidden = 0;
  for (int i = 0; i < 4000; ++i)
  {
    const Polygon lamp = RandomLamp(random);
    if (lamp.Empty() || Area(lamp) < 1e-3)
    {
      continue;
    }
    const Plane front = SupportingPlane(lamp);
    const LampSurface surface({ lamp });
    LampCutter cutter(surface);
    std::vector<Polygon> occluders;
    std::vector<LampCutter::Suspect> all;
    for (int k = 0; k < 5; ++k)
    {
      const Vec3 centre(random.Next() - 0.5, random.Next() - 0.5, 0.6 * random.Next());
      const Polygon whole = RandomPolygon(centre, 0.6 * random.Next(), random);
      const Polygon part = ClipToFront(ClipToFront(whole, Plane(), 1e-10), front, 1e-10);
      if (!part.Empty())
      {
        occluders.push_back(part);
        all.push_back({ cutter.Occluders().AddPlate(part) });
      }
    }
    const Vec3 x = RandomPoint(random);
    if (front.Distance(x) <= 0.0)
    {
      continue;
    }
    LampCutter::Shadows shadows;
    const auto seen = cutter.Seen(x, all, shadows);
    ASSERT_TRUE(seen);
    ASSERT_NEAR(*seen, PointToVisiblePolygon(x, Up, lamp, occluders), 1e-11) << "lamp " << i;
    cuts += shadows.Any() ? 1 : 0;
    hidden += *seen == 0.0 ? 1 : 0;
  }
  EXPECT_GT(cuts, 300);
  EXPECT_GT(hidden, 20);
}

/// Who is outside of a closed body needs the faces by which one enters it only.
TEST(LampCutter, FromOutsideABodyCastsItsShadowByHalfOfItsFaces)
{
  RandomStream random(12);
  const Polygon lamp{ { -0.3, -0.3, 1.0 }, { -0.3, 0.3, 1.0 }, { 0.3, 0.3, 1.0 },
    { 0.3, -0.3, 1.0 } };
  int cuts = 0;
  for (int i = 0; i < 2000; ++i)
  {
    const Vec3 centre(0.6 * random.Next() - 0.3, 0.6 * random.Next() - 0.3, 0.5);
    const Vec3 half = 0.02 + 0.2 * Vec3(random.Next(), random.Next(), random.Next());
    Scene body;
    test::AddBox(body, centre - half, centre + half, i % 2 == 0, { 0, 0, 0, 0, 0, 0 });
    const auto inside = i % 2 == 0 ? Side::Front : Side::Back;
    const LampSurface surface({ lamp });
    LampCutter cutter(surface);
    std::vector<Polygon> faces;
    std::vector<LampCutter::Suspect> suspects;
    for (std::size_t p = 0; p < body.PolygonCount(); ++p)
    {
      Polygon face;
      for (const Vec3& corner : test::CornersOf(body, p))
      {
        face.Add(corner);
      }
      faces.push_back(face);
      suspects.push_back({ cutter.Occluders().AddPlate(face, inside), true });
    }
    const Vec2 x(random.Next() - 0.5, random.Next() - 0.5);
    LampCutter::Shadows shadows;
    const auto seen = cutter.Seen(x, suspects, shadows);
    ASSERT_TRUE(seen);
    ASSERT_NEAR(*seen, PointToVisiblePolygon(Vec3(x, 0.0), Up, lamp, faces), 1e-11) << i;
    cuts += shadows.Any() ? 1 : 0;
  }
  EXPECT_GT(cuts, 500);
}

TEST(LampCutter, AnOccluderHidesAllOnlyIfFromEveryPoint)
{
  const Polygon lamp{ { -0.1, -0.1, 1.0 }, { -0.1, 0.1, 1.0 }, { 0.1, 0.1, 1.0 },
    { 0.1, -0.1, 1.0 } };
  const LampSurface surface({ lamp });
  LampCutter cutter(surface);
  const std::uint32_t pane = cutter.Occluders().AddPlate(
    { { -0.3, -0.3, 0.5 }, { 0.3, -0.3, 0.5 }, { 0.3, 0.3, 0.5 }, { -0.3, 0.3, 0.5 } });
  // The shadow core is 0.5 from the middle on.
  const auto square = [](double h) {
    return Polygon{ { -h, -h, 0.0 }, { h, -h, 0.0 }, { h, h, 0.0 }, { -h, h, 0.0 } };
  };
  EXPECT_TRUE(cutter.Occluders().HidesAll(pane, square(0.49)));
  EXPECT_FALSE(cutter.Occluders().HidesAll(pane, square(0.51)));
}

/// Points on both sides of a wall, those on the lamp's side in the plane of the lamp: the wall is
/// beyond the lamp from there, and leaves it to some of those on the other side.
TEST(LampCutter, AWallBetweenThePointsDoesNotHideAllFromThem)
{
  const Polygon lamp{ { 1.1348, 1.0765, 0.9 }, { 1.1207, 1.0707, 0.8235 },
    { 1.0914, 1.1414, 0.9 } };
  const Plane front = SupportingPlane(lamp);
  const LampSurface surface({ lamp });
  LampCutter cutter(surface);
  const std::uint32_t wall = cutter.Occluders().AddPlate(ClipToFront(
    { { 1.25, 0.5, 0.5 }, { 1.25, 1.5, 0.5 }, { 1.25, 1.5, 1.1 }, { 1.25, 0.5, 1.1 } }, front));
  const Polygon points = ClipToFront(
    { { 0.02, 0.02, 0.0 }, { 1.98, 0.02, 0.0 }, { 1.98, 1.98, 0.0 }, { 0.02, 1.98, 0.0 } }, front);
  LampCutter::Shadows shadows;
  EXPECT_GT(cutter.Seen({ 1.38, 1.34 }, { { wall } }, shadows).value(), 1e-3);
  EXPECT_FALSE(cutter.Occluders().HidesAll(wall, points));
}

TEST(LampCutter, AShadowIsSharpWhereItsEdgeFallsBetweenPoints)
{
  const Polygon lamp{ { -0.1, -0.1, 1.0 }, { -0.1, 0.1, 1.0 }, { 0.1, 0.1, 1.0 },
    { 0.1, -0.1, 1.0 } };
  const LampSurface surface({ lamp });
  LampCutter cutter(surface);
  const std::uint32_t pane = cutter.Occluders().AddPlate(
    { { -0.3, -0.3, 0.5 }, { 0.3, -0.3, 0.5 }, { 0.3, 0.3, 0.5 }, { -0.3, 0.3, 0.5 } });
  const std::uint32_t upright = cutter.Occluders().AddPlate(
    { { 0.6, -0.1, 0.1 }, { 0.6, 0.1, 0.1 }, { 0.6, 0.1, 0.3 }, { 0.6, -0.1, 0.3 } });
  const auto strip = [](double from, double to) {
    return Polygon{ { from, -0.1, 0.0 }, { to, -0.1, 0.0 }, { to, 0.1, 0.0 }, { from, 0.1, 0.0 } };
  };
  EXPECT_FALSE(cutter.Occluders().IsSharp(pane, strip(0.51, 0.69))); // in the penumbra, 0.2 wide
  EXPECT_FALSE(cutter.Occluders().IsSharp(pane, strip(0.51, 0.9)));
  EXPECT_FALSE(cutter.Occluders().IsSharp(pane, strip(-0.4, 0.69)));
  EXPECT_TRUE(cutter.Occluders().IsSharp(pane, strip(0.49, 0.71)));
  EXPECT_FALSE(cutter.Occluders().IsSharp(upright, strip(0.75, 0.79)));
  EXPECT_TRUE(cutter.Occluders().IsSharp(upright, strip(0.59, 0.79))); // its plane passes between
}

} // namespace
} // namespace vantage
