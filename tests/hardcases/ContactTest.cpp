#include "hardcases/HardCase.h"
#include "support/TestScenes.h"

namespace vantage
{
namespace
{

/// Half of the light is reflected, to and fro between two patches; the second one glows as well.
Scene MakeTwoPatches(const std::vector<Vec3>& first, const std::vector<Vec3>& second)
{
  Scene scene;
  scene.materials = { test::MakeMaterial(Color(0.7)), test::MakeMaterial(Color(0.7), Color(1.0)) };
  scene.AddPolygon(first, 0);
  scene.AddPolygon(second, 1);
  return scene;
}

const std::vector<Vec3> Floor = { Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(1, 1, 0), Vec3(0, 1, 0) };

/// A unit square that leans at the edge x = 0 of the floor, or beside it.
std::vector<Vec3> Leaning(double degrees, double beside = 0.0, double along = 0.0)
{
  const double t = degrees * Pi / 180.0;
  const Vec3 low(-beside, along, 0.0);
  const Vec3 up(std::cos(t), 0.0, std::sin(t));
  return { low, low + Vec3(0, 1, 0), low + Vec3(0, 1, 0) + up, low + up };
}

void LookFrom(Scene& scene, const Vec3& eye, const Vec3& lookAt)
{
  Camera camera;
  camera.eye = eye;
  camera.lookAt = lookAt;
  camera.up = Vec3(0.0, 1.0, 0.0);
  camera.fieldOfView = 60.0;
  scene.cameras = { camera };
}

/// Oracle: the slow twin. Noise of its mean: 0.8 % at 1 degree, else 0.3 %.
TEST(HardCase, SquaresThatShareAnEdgeAtAnyAngle)
{
  for (const double degrees : { 1.0, 30.0, 179.0 })
  {
    Scene scene = MakeTwoPatches(Floor, Leaning(degrees));
    // From between the two, or where both are seen from above.
    const double t = 0.5 * degrees * Pi / 180.0;
    LookFrom(scene,
      (degrees < 90.0 ? 0.95 : 1.4) * Vec3(std::cos(t), 0.0, std::sin(t)) + Vec3(0.0, 0.5, 0.0),
      Vec3(0.0, 0.5, 0.0));
    EXPECT_NEAR(test::RelativeToTraced(scene, 0.02, 256), 1.0, 0.02) << degrees;
  }
}

TEST(HardCase, SquaresThatNearlyShareAnEdge)
{
  Scene scene = MakeTwoPatches(Floor, Leaning(90.0));
  LookFrom(scene, Vec3(0.7, 0.5, 1.5), Vec3(0.3, 0.5, 0.0));
  const Image expected = test::CasePicture(scene, 0.01);
  for (const double gap : { 1e-3, 1e-7 })
  {
    // The light through a gap is of its order.
    const Scene open = MakeTwoPatches(Floor, Leaning(90.0, gap));
    scene.vertices = open.vertices;
    EXPECT_LT(Compare(test::CasePicture(scene, 0.01), expected).relativeL1, 0.015) << gap;
  }
}

TEST(HardCase, SquaresThatShareACornerOnly)
{
  Scene scene = MakeTwoPatches(Floor, Leaning(90.0, 0.0, 1.0));
  LookFrom(scene, Vec3(0.9, 0.5, 1.5), Vec3(0.3, 0.8, 0.0));
  EXPECT_NEAR(test::RelativeToTraced(scene, 0.02, 256), 1.0, 0.02);
}

/// Parallel squares that all but lie on each other. Between them light goes to and fro as between
/// infinite planes; what escapes at the border is of the order of the gap.
TEST(HardCase, ParallelSquaresThatNearlyTouch)
{
  for (const double gap : { 1e-2, 1e-6 })
  {
    Scene scene =
      MakeTwoPatches(Floor, { Vec3(0, 0, gap), Vec3(0, 1, gap), Vec3(1, 1, gap), Vec3(1, 0, gap) });
    LookFrom(scene, Vec3(0.5, 0.5, 0.5 * gap), Vec3(0.5, 0.5, 0.0));
    const Image picture = test::CasePicture(scene, 0.01);
    const double lower = 0.7 / (1.0 - 0.49);
    EXPECT_NEAR(test::MeanRadiance(picture) / lower, 1.0, 0.01 + 10.0 * gap) << gap;
  }
}

/// A wall of two one-sided polygons back to back is a thin slab.
TEST(HardCase, CoincidentFacesBackToBack)
{
  const auto pictureOf = [](double thickness)
  {
    Scene scene = test::MakeLitBox();
    const double x = 0.5;
    const double y = x + thickness;
    scene.AddPolygon({ Vec3(x, 0, 0), Vec3(x, 0, .5), Vec3(x, .4, .5), Vec3(x, .4, 0) }, 1);
    scene.AddPolygon({ Vec3(y, 0, 0), Vec3(y, .4, 0), Vec3(y, .4, .5), Vec3(y, 0, .5) }, 2);
    return test::CasePicture(scene, 0.01);
  };
  const Image expected = pictureOf(1e-4);
  for (const double thickness : { 0.0, 1e-7 })
  {
    EXPECT_LT(Compare(pictureOf(thickness), expected).relativeL1, 0.02) << thickness;
  }
}

/// The lit box with its walls cut so that corners lie in the middle of edges, or in one piece.
TEST(HardCase, TJunctions)
{
  const Scene whole = test::MakeLitBox();
  Scene cut;
  cut.materials = whole.materials;
  cut.cameras = whole.cameras;
  for (std::size_t p = 0; p < whole.PolygonCount(); ++p)
  {
    const std::vector<Vec3> c = test::CornersOf(whole, p);
    const auto at = [&](double u, double v)
    { return (1 - u) * ((1 - v) * c[0] + v * c[3]) + u * ((1 - v) * c[1] + v * c[2]); };
    const auto add = [&](double u0, double u1, double v0, double v1) {
      cut.AddPolygon(
        { at(u0, v0), at(u1, v0), at(u1, v1), at(u0, v1) }, whole.materialOfPolygon[p]);
    };
    if (p >= 6)
    {
      add(0, 1, 0, 1);
      continue;
    }
    add(0, 1.0 / 3.0, 0, 0.47); // each half in parts that do not meet those of the other
    add(1.0 / 3.0, 1, 0, 0.47);
    add(0, 0.61, 0.47, 1);
    add(0.61, 1, 0.47, 1);
  }
  EXPECT_LT(Compare(test::CasePicture(cut, 0.01), test::CasePicture(whole, 0.01)).relativeL1, 0.02);
}

} // namespace
} // namespace vantage
