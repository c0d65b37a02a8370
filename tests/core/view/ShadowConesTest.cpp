#include "core/view/ShadowCones.h"

#include "core/formfactor/Shadows.h"
#include "core/math/Sampling.h"
#include "core/view/LampCutter.h"
#include "support/TestScenes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>

namespace vantage
{
namespace
{

const Vec3 Up(0.0, 0.0, 1.0);

std::vector<Polygon> Ball(const Vec3& centre, double radius, int rings)
{
  Scene scene;
  test::AddBall(scene, centre, radius, rings, 0);
  return test::FacesOf(scene);
}

std::vector<Polygon> Box(const Vec3& low, const Vec3& high)
{
  Scene scene;
  test::AddBox(scene, low, high, false, { 0, 0, 0, 0, 0, 0 });
  return test::FacesOf(scene);
}

ConvexBody BodyOf(const std::vector<Polygon>& faces)
{
  const auto isBefore = [](const Vec3& a, const Vec3& b)
  { return std::tie(a.x, a.y, a.z) < std::tie(b.x, b.y, b.z); };
  std::map<Vec3, std::uint32_t, decltype(isBefore)> numberOf(isBefore);
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::size_t> known;
  ConvexBody body;
  for (std::uint32_t f = 0; f < faces.size(); ++f)
  {
    const Polygon& face = faces[f];
    body.planes.push_back(SupportingPlane(face));
    for (int i = 0; i < face.Size(); ++i)
    {
      const Vec3& from = face[i];
      const Vec3& to = face[(i + 1) % face.Size()];
      body.corners.push_back(from);
      const auto count = static_cast<std::uint32_t>(numberOf.size());
      const std::uint32_t a = numberOf.try_emplace(from, count).first->second;
      const auto countNow = static_cast<std::uint32_t>(numberOf.size());
      const std::uint32_t b = numberOf.try_emplace(to, countNow).first->second;
      if (const auto other = known.find({ b, a }); other != known.end())
      {
        body.edges[other->second].second = f;
        continue;
      }
      known[{ a, b }] = body.edges.size();
      body.edges.push_back({ from, to, f, f });
    }
  }
  return body;
}

/// What x sees of convex polygons that do not hide each other, past others.
double SeenPast(
  const std::vector<Polygon>& lamp, const std::vector<Polygon>& occluders, const Vec3& x)
{
  double sum = 0.0;
  for (const Polygon& face : lamp)
  {
    const Plane front = SupportingPlane(face);
    std::vector<Polygon> before;
    for (const Polygon& occluder : occluders)
    {
      const Polygon part = ClipToFront(ClipToFront(occluder, Plane(), 1e-10), front, 1e-10);
      if (!part.Empty())
      {
        before.push_back(part);
      }
    }
    sum += front.Distance(x) > 0.0 ? PointToVisiblePolygon(x, Up, face, before) : 0.0;
  }
  return sum;
}

Vec3 RandomVector(RandomStream& random)
{
  return 2.0 * Vec3(random.Next(), random.Next(), random.Next()) - 1.0;
}

std::vector<Polygon> RandomBody(RandomStream& random, double reach)
{
  const Vec3 centre = Vec3(0.0, 0.0, 0.45) + reach * RandomVector(random);
  if (random.Next() < 0.5)
  {
    return Ball(centre, 0.05 + 0.25 * random.Next(), 3);
  }
  const Vec3 half = 0.03 + 0.25 * Vec3(random.Next(), random.Next(), random.Next());
  return Box(centre - half, centre + half);
}

const Polygon Panel{ { -0.3, -0.3, 1.0 }, { -0.3, 0.3, 1.0 }, { 0.3, 0.3, 1.1 },
  { 0.3, -0.3, 1.1 } };

/// Bodies below, beside and above a lamp, through its plane and through that of the points, which
/// may be inside of them.
TEST(ShadowCones, ABodyHidesOfAFlatLampWhatItsFacesHide)
{
  RandomStream random(1);
  const LampSurface lamp({ Panel });
  int cuts = 0;
  int hidden = 0;
  for (int k = 0; k < 3000; ++k)
  {
    const std::vector<Polygon> first = RandomBody(random, 0.6);
    const std::vector<Polygon> second = RandomBody(random, 0.6);
    LampCutter cutter(lamp);
    std::vector<LampCutter::Suspect> suspects;
    for (const std::vector<Polygon>& faces : { first, second })
    {
      const auto added = cutter.Occluders().AddBody(BodyOf(faces));
      ASSERT_TRUE(added);
      suspects.push_back({ *added });
    }
    std::vector<Polygon> all = first;
    all.insert(all.end(), second.begin(), second.end());
    const Vec3 x(0.8 * RandomVector(random).x, 0.8 * RandomVector(random).y, 0.0);
    LampCutter::Shadows shadows;
    const auto seen = cutter.Seen(x, suspects, shadows);
    ASSERT_TRUE(seen);
    ASSERT_NEAR(*seen, SeenPast({ Panel }, all, x), 1e-10) << k; // round-off of other cuts
    cuts += shadows.Any() ? 1 : 0;
    hidden += *seen == 0.0 ? 1 : 0;
  }
  EXPECT_GT(cuts, 700);
  EXPECT_GT(hidden, 50);
}

std::vector<Polygon> InTriangles(const std::vector<Polygon>& faces)
{
  std::vector<Polygon> triangles;
  for (const Polygon& face : faces)
  {
    for (int i = 2; i < face.Size(); ++i)
    {
      triangles.push_back({ face[0], face[i - 1], face[i] });
    }
  }
  return triangles;
}

/// Bodies that reach as high as the lamp: triangles of them touch its plane in one corner, to the
/// bit and nearly so.
TEST(ShadowCones, ABodyMayTouchThePlaneOfTheLampInACorner)
{
  RandomStream random(3);
  const Polygon panel{ { -0.3, -0.3, 1.0 }, { -0.3, 0.3, 1.0 }, { 0.3, 0.3, 1.0 },
    { 0.3, -0.3, 1.0 } };
  const LampSurface lamp({ panel });
  int cuts = 0;
  for (int k = 0; k < 900; ++k)
  {
    const double top = 1.0 + (k % 3 - 1) * 5e-11;
    const Vec2 place(1.4 * random.Next() - 0.7, 1.4 * random.Next() - 0.7);
    const std::vector<Polygon> faces =
      k % 2 == 0 ? InTriangles(Box(Vec3(place - 0.1, 0.2), Vec3(place + 0.2, top)))
                 : Ball(Vec3(place, top - 0.3), 0.3, 4);
    LampCutter cutter(lamp);
    const std::uint32_t body = cutter.Occluders().AddBody(BodyOf(faces)).value();
    for (int i = 0; i < 10; ++i)
    {
      const Vec3 x(RandomVector(random).x, RandomVector(random).y, 0.0);
      LampCutter::Shadows shadows;
      const auto seen = cutter.Seen(x, { { body } }, shadows);
      ASSERT_TRUE(seen);
      ASSERT_NEAR(*seen, SeenPast({ panel }, faces, x), 1e-9) << k << ", " << i; // what touches
      cuts += shadows.Any() ? 1 : 0;
    }
  }
  EXPECT_GT(cuts, 1000);
}

/// The same of a globe: bodies before, behind and beside it. Those that may touch it are refused.
TEST(ShadowCones, ABodyHidesOfAGlobeWhatItsFacesHide)
{
  RandomStream random(2);
  int cuts = 0;
  int hidden = 0;
  int refused = 0;
  for (int k = 0; k < 1500; ++k)
  {
    const std::vector<Polygon> globe =
      Ball(Vec3(0.0, 0.0, 0.8) + 0.2 * RandomVector(random), 0.15, 4);
    const std::vector<Polygon> faces = RandomBody(random, 0.7);
    const LampSurface lamp(globe);
    LampCutter cutter(lamp);
    const auto added = cutter.Occluders().AddBody(BodyOf(faces));
    if (!added)
    {
      ++refused;
      continue;
    }
    const Vec3 x(RandomVector(random).x, RandomVector(random).y, 0.0);
    LampCutter::Shadows shadows;
    const auto seen = cutter.Seen(x, { { *added } }, shadows);
    ASSERT_TRUE(seen);
    ASSERT_NEAR(*seen, SeenPast(globe, faces, x), 1e-9) << k; // slivers along the outlines
    cuts += shadows.Any() ? 1 : 0;
    hidden += *seen == 0.0 ? 1 : 0;
  }
  EXPECT_GT(cuts, 100);
  EXPECT_GT(hidden, 20);
  EXPECT_GT(refused, 20);
  EXPECT_LT(refused, 400);
}

Polygon Square(double x, double h)
{
  return { { x - h, -h, 0.0 }, { x + h, -h, 0.0 }, { x + h, h, 0.0 }, { x - h, h, 0.0 } };
}

TEST(ShadowCones, ABodyHidesAllThoughNoFaceDoes)
{
  const LampSurface lamp(
    { Polygon{ { -0.1, -0.1, 1.0 }, { -0.1, 0.1, 1.0 }, { 0.1, 0.1, 1.0 }, { 0.1, -0.1, 1.0 } } });
  ShadowCones cones(lamp);
  // A ball of so many facets that it is one of radius 0.3, nearly: its shadow core is one of 0.5.
  const std::vector<Polygon> ball = Ball({ 0.0, 0.0, 0.5 }, 0.3, 24);
  const std::uint32_t body = cones.AddBody(BodyOf(ball)).value();
  for (const Polygon& face : ball)
  {
    EXPECT_FALSE(cones.HidesAll(cones.AddPlate(face), Square(0.0, 0.2)));
  }
  EXPECT_TRUE(cones.HidesAll(body, Square(0.0, 0.2)));
  EXPECT_FALSE(cones.HidesAll(body, Square(0.0, 0.6)));
  EXPECT_FALSE(cones.HidesAll(body, Square(2.0, 0.2)));
  const std::uint32_t around = cones.AddBody(BodyOf(Ball(Vec3(0.0), 0.4, 4))).value();
  EXPECT_TRUE(cones.HidesAll(around, Square(0.0, 0.1))); // inside of it
}

TEST(ShadowCones, TheShadowOfABodyIsSharpWhereItFallsBetweenPoints)
{
  const LampSurface lamp(
    { Polygon{ { -0.1, -0.1, 1.0 }, { -0.1, 0.1, 1.0 }, { 0.1, 0.1, 1.0 }, { 0.1, -0.1, 1.0 } } });
  ShadowCones cones(lamp);
  const std::uint32_t ball = cones.AddBody(BodyOf(Ball({ 0.0, 0.0, 0.5 }, 0.03, 8))).value();
  const std::uint32_t box =
    cones.AddBody(BodyOf(Box({ 0.5, -0.2, 0.0 }, { 0.8, 0.2, 0.1 }))).value();
  EXPECT_TRUE(cones.IsSharp(ball, Square(0.0, 0.4))); // all of it lies within
  EXPECT_FALSE(cones.IsSharp(ball, Square(0.1, 0.02)));
  EXPECT_TRUE(cones.IsSharp(box, Square(0.8, 0.1))); // its border passes between
  EXPECT_FALSE(cones.IsSharp(box, Square(0.3, 0.05)));
}

} // namespace
} // namespace vantage
