#include "hardcases/HardCase.h"
#include "support/TestScenes.h"

#include <gtest/gtest.h>

namespace vantage
{
namespace
{

/// The lit box with a wall that is cut into slivers, 1e4 times as long as wide and less.
TEST(HardCase, Slivers)
{
  const Scene whole = test::MakeLitBox();
  Scene cut;
  cut.materials = whole.materials;
  cut.cameras = whole.cameras;
  for (std::size_t p = 0; p < whole.PolygonCount(); ++p)
  {
    const std::vector<Vec3> points = test::CornersOf(whole, p);
    if (p != 0)
    {
      cut.AddPolygon(points, whole.materialOfPolygon[p]);
      continue;
    }
    double from = 0.0;
    for (const double to : { 0.4, 0.4001, 0.41, 0.7, 0.7001, 0.7002, 1.0 })
    {
      const auto at = [&](double t, int a, int b) { return (1.0 - t) * points[a] + t * points[b]; };
      cut.AddPolygon(
        { at(from, 0, 3), at(from, 1, 2), at(to, 1, 2), at(to, 0, 3) }, whole.materialOfPolygon[p]);
      from = to;
    }
  }
  EXPECT_LT(Compare(test::CasePicture(cut, 0.01), test::CasePicture(whole, 0.01)).relativeL1, 0.02);
}

/// Oracle: nothing changes.
TEST(HardCase, DuplicateAndDegenerateFaces)
{
  const Scene scene = test::MakeLitBox();
  Scene more = scene;
  for (std::size_t p = 0; p < scene.PolygonCount(); p += 2)
  {
    const std::vector<Vec3> points = test::CornersOf(scene, p);
    more.AddPolygon(points, scene.materialOfPolygon[p]);
  }
  more.AddPolygon({ Vec3(0.1), Vec3(0.5), Vec3(0.9) }, 0);
  more.AddPolygon({ Vec3(0.2), Vec3(0.2), Vec3(0.2) }, 0);
  more.AddPolygon({ Vec3(.1, .1, .1), Vec3(.2, .1, .1), Vec3(.3, .1, .1), Vec3(.2, .1, .1) }, 0);
  EXPECT_EQ(test::CasePicture(more, 0.05).pixels, test::CasePicture(scene, 0.05).pixels);
}

/// A hundred thin slats in front of a lamp. Oracle: the slow twin.
TEST(HardCase, ALouvreOfAHundredSlats)
{
  Scene scene;
  scene.materials = { test::MakeMaterial(Color(0.5)), test::MakeMaterial(Color(0.5), Color(20.0)),
    test::MakeMaterial(Color(0.7), Color(0.0), true) };
  test::AddBox(scene, Vec3(0.0), Vec3(1.0), true, { 0, 0, 0, 0, 0, 0 });
  scene.AddPolygon(
    { Vec3(.2, .2, .98), Vec3(.2, .8, .98), Vec3(.8, .8, .98), Vec3(.8, .2, .98) }, 1);
  for (int i = 0; i < 100; ++i)
  {
    const double x = 0.005 + 0.01 * i;
    scene.AddPolygon({ Vec3(x, 0, .88), Vec3(x, 1, .88), Vec3(x, 1, .9), Vec3(x, 0, .9) }, 2);
  }
  scene.cameras.push_back(test::InsideCamera());
  scene.cameras[0].eye.z = 0.7;
  EXPECT_NEAR(test::RelativeToTraced(scene, 0.05, 256), 1.0, 0.05);
}

/// Light through a hole of a hundredth of the wall. Oracle: the slow twin.
TEST(HardCase, APinhole)
{
  Scene scene;
  scene.materials = { test::MakeMaterial(Color(0.6)), test::MakeMaterial(Color(0.5), Color(500.0)),
    test::MakeMaterial(Color(0.6), Color(0.0), true) };
  test::AddBox(scene, Vec3(0.0), Vec3(2.0, 1.0, 1.0), true, { 0, 0, 0, 0, 0, 0 });
  const double a = 0.49;
  const double b = 0.51;
  for (const auto& [y0, y1, z0, z1] :
    { std::array{ 0.0, a, 0.0, 1.0 }, { b, 1.0, 0.0, 1.0 }, { a, b, 0.0, a }, { a, b, b, 1.0 } })
  {
    scene.AddPolygon({ Vec3(1, y0, z0), Vec3(1, y1, z0), Vec3(1, y1, z1), Vec3(1, y0, z1) }, 2);
  }
  scene.AddPolygon({ Vec3(.1, .4, .4), Vec3(.1, .6, .4), Vec3(.1, .6, .6), Vec3(.1, .4, .6) }, 1);
  Camera camera = test::InsideCamera();
  camera.eye = Vec3(1.1, 0.2, 0.5);
  camera.lookAt = Vec3(1.9, 0.6, 0.4);
  scene.cameras.push_back(camera);
  const double traced = test::TracedMean(scene, 1024);
  constexpr int Seeds = 5;
  struct Held
  {
    double asked, one, mean;
  };
  // One picture: three times the spread over twenty seeds. The mean of five: three times its own,
  // and the noise of the slow twin, about 2 %, at 2 %.
  for (const Held& held : { Held{ 0.05, 0.15, 0.07 }, Held{ 0.02, 0.12, 0.06 } })
  {
    double mean = 0.0;
    for (int seed = 1; seed <= Seeds; ++seed)
    {
      const double one =
        test::MeanRadiance(test::CasePicture(scene, held.asked, test::CasePixels, seed)) / traced;
      EXPECT_NEAR(one, 1.0, held.one) << "asked " << held.asked << ", seed " << seed;
      mean += one / Seeds;
    }
    EXPECT_NEAR(mean, 1.0, held.mean) << "asked " << held.asked;
  }
}

} // namespace
} // namespace vantage
