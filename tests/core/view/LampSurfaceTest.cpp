#include "core/view/LampSurface.h"

#include "core/formfactor/FormFactor.h"
#include "core/formfactor/Shadows.h"
#include "core/math/Sampling.h"
#include "core/view/LampCutter.h"
#include "support/TestScenes.h"

#include <gtest/gtest.h>

#include <cmath>

namespace vantage
{
namespace
{

const Vec3 Up(0.0, 0.0, 1.0);

/// The faces of a ball.
std::vector<Polygon> Ball(const Vec3& centre, double radius, int rings)
{
  Scene scene;
  scene.materials.resize(1);
  test::AddBall(scene, centre, radius, rings, 0);
  return test::FacesOf(scene);
}

Vec3 RandomVector(RandomStream& random)
{
  return 2.0 * Vec3(random.Next(), random.Next(), random.Next()) - 1.0;
}

double SumOver(const std::vector<Polygon>& faces, const Vec3& x, const Vec3& normal)
{
  double sum = 0.0;
  for (const Polygon& face : faces)
  {
    sum += PointToPolygon(x, normal, face);
  }
  return sum;
}

TEST(LampSurface, GivesWhatItsFacesGive)
{
  RandomStream random(1);
  const std::vector<Polygon> faces = Ball({ 0.2, 0.1, 0.8 }, 0.3, 8);
  const PatchFrame frame(Polygon{ { 0, 0, 0 }, { 1, 0, 0 }, { 0, 1, 0 } });
  const LampSurface whole(faces);
  const LampSurface lamp = whole.In(frame, 2.0);
  ASSERT_EQ(lamp.Size(), faces.size());
  LampSurface::Workspace room;
  for (int k = 0; k < 500; ++k)
  {
    const Vec3 x(RandomVector(random).x, RandomVector(random).y, 0.0);
    ASSERT_NEAR(lamp.At(Vec2(x) / 2.0, room), SumOver(faces, x, Up), 1e-11) << k; // round-off
    ASSERT_NEAR(whole.Onto(x, Up, room), SumOver(faces, x, Up), 1e-11) << k;
  }
}

/// Points and planes anywhere, the planes through the lamp among them.
TEST(LampSurface, IsCutAtTheHorizon)
{
  RandomStream random(2);
  const std::vector<Polygon> faces = Ball({ 0.0, 0.0, 0.0 }, 0.4, 6);
  const LampSurface whole(faces);
  LampSurface::Workspace room;
  int cut = 0;
  for (int k = 0; k < 1000; ++k)
  {
    const Vec3 x = 0.5 + 0.5 * glm::abs(RandomVector(random));
    const Vec3 normal = glm::normalize(RandomVector(random));
    const double expected = SumOver(faces, x, normal);
    ASSERT_NEAR(whole.Onto(x, normal, room), expected, 1e-11) << k;
    const Vec3 along = glm::normalize(glm::cross(normal, RandomVector(random)));
    const PatchFrame frame(Polygon{ x, x + along, x + glm::cross(normal, along) });
    const LampSurface lamp = whole.In(frame, 1.5);
    cut += lamp.Size() > 0 && lamp.Size() < faces.size() ? 1 : 0;
    ASSERT_NEAR(lamp.Size() > 0 ? lamp.At(Vec2(0.0), room) : 0.0, expected, 1e-11) << k;
  }
  EXPECT_GT(cut, 100);
}

TEST(LampSurface, KnowsWhatIsBehindAllOfIt)
{
  const LampSurface ball(Ball({ 0.0, 0.0, 0.0 }, 0.4, 6));
  const auto square = [](const Vec3& low, double edge)
  {
    return Polygon{ low, low + Vec3(edge, 0, 0), low + Vec3(edge, edge, 0),
      low + Vec3(0, edge, 0) };
  };
  EXPECT_TRUE(ball.IsInFrontOf(square({ -0.1, -0.1, 0.0 }, 0.2)));
  EXPECT_TRUE(ball.IsInFrontOf(Ball({ 0.0, 0.0, 0.0 }, 0.4, 6)[3])); // one of its own
  EXPECT_FALSE(ball.IsInFrontOf(square({ -0.1, -0.1, 0.0 }, 1.0)));
  EXPECT_FALSE(ball.IsInFrontOf(square({ -0.1, -0.1, 0.5 }, 0.2)));
  EXPECT_FALSE(ball.IsFlat());
  EXPECT_TRUE(LampSurface({ square({ 0, 0, 1 }, 1.0), square({ 1, 0, 1 }, 1.0) }).IsFlat());
  EXPECT_FALSE(
    LampSurface({ square({ 0, 0, 1 }, 1.0), Reversed(square({ 1, 0, 1 }, 1.0)) }).IsFlat());
}

/// A globe past polygons anywhere: before, behind, beside it, and reaching into it. Oracle: each of
/// its faces by itself, past what is in front of that.
TEST(LampCutter, SeesOfManyFacesWhatPointToVisiblePolygonSees)
{
  RandomStream random(4);
  int cuts = 0;
  int hidden = 0;
  for (int k = 0; k < 1500; ++k)
  {
    const std::vector<Polygon> faces =
      Ball(Vec3(0.0, 0.0, 0.8) + 0.2 * RandomVector(random), 0.3, 5);
    const LampSurface lamp(faces);
    LampCutter cutter(lamp);
    std::vector<Polygon> occluders;
    std::vector<LampCutter::Suspect> suspects;
    for (int i = 0; i < 4; ++i)
    {
      const Vec3 middle = Vec3(0.0, 0.0, 0.6) + RandomVector(random) * Vec3(0.5, 0.5, 0.8);
      const Vec3 u = 0.6 * RandomVector(random);
      const Vec3 v = 0.6 * RandomVector(random);
      const Polygon shape =
        ClipToFront(Polygon{ middle, middle + u, middle + u + v, middle + v }, Plane(), 1e-10);
      if (!shape.Empty())
      {
        occluders.push_back(shape);
        suspects.push_back({ cutter.Occluders().AddPlate(shape) });
      }
    }
    const Vec3 x(RandomVector(random).x, RandomVector(random).y, 0.0);
    double expected = 0.0;
    for (const Polygon& face : faces)
    {
      const Plane front = SupportingPlane(face);
      std::vector<Polygon> before;
      for (const Polygon& occluder : occluders)
      {
        const Polygon part = ClipToFront(occluder, front, 1e-10);
        if (!part.Empty())
        {
          before.push_back(part);
        }
      }
      expected += front.Distance(x) > 0.0 ? PointToVisiblePolygon(x, Up, face, before) : 0.0;
    }
    LampCutter::Shadows shadows;
    const auto seen = cutter.Seen(x, suspects, shadows);
    ASSERT_TRUE(seen);
    ASSERT_NEAR(*seen, expected, 1e-8) << k; // slivers along the outlines
    cuts += shadows.Any() ? 1 : 0;
    hidden += *seen == 0.0 ? 1 : 0;
  }
  EXPECT_GT(cuts, 500);
  EXPECT_GT(hidden, 20);
}

} // namespace
} // namespace vantage
