#include "hardcases/HardCase.h"
#include "support/TestScenes.h"

#include <gtest/gtest.h>

namespace vantage
{
namespace
{

/// A closed box where nearly all light is reflected, again and again. Oracle: closed form.
TEST(HardCase, AlbedoNearOneInAClosedBox)
{
  for (const double albedo : { 0.99, 0.999 })
  {
    const Scene scene = test::MakeFurnace(Color(albedo));
    const Solver solver = test::SolvedCase(scene, 0.3);
    for (const Color& radiance : solver.Elements().radiance)
    {
      // Rows are closed to 1e-5, which a hundred reflections make 1e-3, and sweeps leave some.
      ASSERT_NEAR(Mean(radiance) * (1.0 - albedo), 1.0, 1e-2) << albedo;
    }
  }
}

/// The lit box with a lamp of another size and the same power.
Scene MakeBoxWithLamp(double size, double distance)
{
  Scene scene;
  const double emission = 1.0 / (size * size);
  scene.materials = { test::MakeMaterial(Color(0.6, 0.5, 0.4)),
    test::MakeMaterial(Color(0.5), Color(emission)) };
  test::AddBox(scene, Vec3(0.0), Vec3(1.0), true, { 0, 0, 0, 0, 0, 0 });
  const double z = 1.0 - distance;
  const double a = 0.5 - 0.5 * size;
  const double b = 0.5 + 0.5 * size;
  scene.AddPolygon({ Vec3(a, a, z), Vec3(a, b, z), Vec3(b, b, z), Vec3(b, a, z) }, 1);
  scene.cameras.push_back(test::InsideCamera());
  return scene;
}

/// Below the horizon of a lamp that is far smaller than its distance, its size does not matter.
TEST(HardCase, ALampOfATenThousandthOfTheRoom)
{
  const Image small = test::CasePicture(MakeBoxWithLamp(1e-2, 0.05), 0.01);
  const Image tiny = test::CasePicture(MakeBoxWithLamp(1e-4, 0.05), 0.01);
  EXPECT_LT(Compare(tiny, small).relativeL1, 0.015); // both errors together
}

/// A lamp that all but lies in the ceiling lights the room like one that lies in it.
TEST(HardCase, ALampThatTouchesTheCeiling)
{
  const Image apart = test::CasePicture(MakeBoxWithLamp(0.2, 1e-3), 0.01);
  for (const double distance : { 1e-5, 1e-7, 0.0 })
  {
    const Image near = test::CasePicture(MakeBoxWithLamp(0.2, distance), 0.01);
    EXPECT_LT(Compare(near, apart).relativeL1, 0.02) << distance;
  }
}

TEST(HardCase, ALampAMillionTimesBrighterThanAnother)
{
  Scene scene = MakeBoxWithLamp(0.1, 0.05);
  scene.materials.push_back(test::MakeMaterial(Color(0.5), Color(1e-6 * 100.0)));
  scene.AddPolygon(
    { Vec3(0.1, 0.1, 0.9), Vec3(0.1, 0.2, 0.9), Vec3(0.2, 0.2, 0.9), Vec3(0.2, 0.1, 0.9) }, 2);
  Scene dark = scene;
  dark.materials[2].emission = Color(0.0);
  EXPECT_LT(
    Compare(test::CasePicture(scene, 0.01), test::CasePicture(dark, 0.01)).relativeL1, 0.015);
}

TEST(HardCase, FiveHundredLamps)
{
  Scene scene;
  scene.materials = { test::MakeMaterial(Color(0.5)), test::MakeMaterial(Color(0.5), Color(10.0)) };
  test::AddBox(scene, Vec3(0.0), Vec3(1.0), true, { 0, 0, 0, 0, 0, 0 });
  for (int i = 0; i < 500; ++i)
  {
    const Vec3 c(0.02 + 0.04 * (i % 25), 0.025 + 0.05 * (i / 25), 0.97);
    scene.AddPolygon({ c + Vec3(-.01, -.01, 0), c + Vec3(-.01, .01, 0), c + Vec3(.01, .01, 0),
                       c + Vec3(.01, -.01, 0) },
      1);
  }
  scene.cameras.push_back(test::InsideCamera());
  // Noise of the slow twin: 0.3 %.
  EXPECT_NEAR(test::RelativeToTraced(scene, 0.02, 256), 1.0, 0.02);
}

/// Two rooms that share a wall with a gap. The lamp is in one, the camera in the other one.
Scene MakeRoomsWithGap(double width)
{
  Scene scene;
  scene.materials = { test::MakeMaterial(Color(0.7)), test::MakeMaterial(Color(0.5), Color(50.0)),
    test::MakeMaterial(Color(0.7), Color(0.0), true) };
  test::AddBox(scene, Vec3(0.0), Vec3(2.0, 1.0, 1.0), true, { 0, 0, 0, 0, 0, 0 });
  scene.AddPolygon(
    { Vec3(1, 0, 0), Vec3(1, 1.0 - width, 0), Vec3(1, 1.0 - width, 1), Vec3(1, 0, 1) }, 2);
  scene.AddPolygon(
    { Vec3(.4, .4, .95), Vec3(.4, .6, .95), Vec3(.6, .6, .95), Vec3(.6, .4, .95) }, 1);
  Camera camera = test::InsideCamera();
  camera.eye = Vec3(1.9, 0.2, 0.5);
  camera.lookAt = Vec3(1.4, 0.6, 0.3);
  scene.cameras.push_back(camera);
  return scene;
}

/// A box with nine globes below its ceiling, and no other lamp.
Scene MakeBoxWithGlobes(int rings)
{
  Scene scene;
  scene.materials = { test::MakeMaterial(Color(0.6, 0.5, 0.4)),
    test::MakeMaterial(Color(0.0), Color(2.0), false) };
  test::AddBox(scene, Vec3(0.0), Vec3(1.0), true, { 0, 0, 0, 0, 0, 0 });
  for (int i = 0; i < 9; ++i)
  {
    const Vec3 centre(0.25 * (1.0 + i % 3), 0.25 * (1.0 + i / 3), 0.85);
    test::AddBall(scene, centre, 0.03, rings, 1);
  }
  scene.cameras.push_back(test::InsideCamera());
  return scene;
}

/// 3,240 facets that shine. Oracles: not many more interactions than with 756; path tracing, at
/// errors that stop at whole globes, at parts of them and at facets.
TEST(HardCase, LampsOfHundredsOfFacets)
{
  const Scene fine = MakeBoxWithGlobes(10);
  for (const double error : { 0.05, 0.01 })
  {
    EXPECT_LT(test::SolvedCase(fine, error).Interactions().size(),
      1.5 * test::SolvedCase(MakeBoxWithGlobes(6), error).Interactions().size());
  }
  const double traced = test::TracedMean(fine, 512);
  for (const double error : { 0.05, 0.02, 0.014, 0.01 })
  {
    EXPECT_NEAR(
      test::MeanRadiance(test::CasePicture(fine, error)) / traced, 1.0, 0.5 * error + 0.003)
      << error;
  }
}

/// Neither a leak nor none. Oracle: the slow twin, of whose paths one of thousands finds the gap.
TEST(HardCase, ADoorOpenedByAMillimetre)
{
  // Light through a gap is what estimates of the error know least: it lies in spots beside the gap,
  // smaller than the elements. Half as much again as was asked, and three times that at 2 %.
  constexpr double Missed = 1.5;
  constexpr double MissedAtTwo = 3.0;
  // Standard deviations of the slow twin over seeds.
  constexpr double NoiseOfOne = 0.025;
  constexpr double NoiseOfTen = 0.010;
  const Scene one = MakeRoomsWithGap(1e-3);
  const Scene ten = MakeRoomsWithGap(1e-2);
  EXPECT_NEAR(test::RelativeToTraced(one, 0.05, 1024), 1.0, Missed * 0.05 + 2.0 * NoiseOfOne);
  EXPECT_NEAR(test::RelativeToTraced(ten, 0.05, 512), 1.0, Missed * 0.05 + 2.0 * NoiseOfTen);
  EXPECT_NEAR(test::RelativeToTraced(ten, 0.02, 512), 1.0, MissedAtTwo * 0.02 + 2.0 * NoiseOfTen);
}

/// Two rooms with a door between them: a black one with a lamp, and a grey one with the camera.
Scene MakeBlackRoomNextDoor(double width)
{
  Scene scene;
  scene.materials = { test::MakeMaterial(Color(0.01), Color(0.0), true),
    test::MakeMaterial(Color(0.7), Color(0.0), true), test::MakeMaterial(Color(0.5), Color(50.0)) };
  for (const std::uint32_t room : { 0u, 1u })
  {
    const double a = room;
    const double b = a + 1.0;
    const double end = 2.0 * a;
    scene.AddPolygon({ Vec3(a, 0, 0), Vec3(b, 0, 0), Vec3(b, 1, 0), Vec3(a, 1, 0) }, room);
    scene.AddPolygon({ Vec3(a, 0, 1), Vec3(b, 0, 1), Vec3(b, 1, 1), Vec3(a, 1, 1) }, room);
    scene.AddPolygon({ Vec3(a, 0, 0), Vec3(b, 0, 0), Vec3(b, 0, 1), Vec3(a, 0, 1) }, room);
    scene.AddPolygon({ Vec3(a, 1, 0), Vec3(b, 1, 0), Vec3(b, 1, 1), Vec3(a, 1, 1) }, room);
    scene.AddPolygon({ Vec3(end, 0, 0), Vec3(end, 1, 0), Vec3(end, 1, 1), Vec3(end, 0, 1) }, room);
  }
  scene.AddPolygon(
    { Vec3(1, 0, 0), Vec3(1, 1.0 - width, 0), Vec3(1, 1.0 - width, 1), Vec3(1, 0, 1) }, 0);
  scene.AddPolygon(
    { Vec3(.4, .4, .95), Vec3(.4, .6, .95), Vec3(.6, .6, .95), Vec3(.6, .4, .95) }, 2);
  Camera camera = test::InsideCamera();
  camera.eye = Vec3(1.2, 0.2, 0.5);
  camera.lookAt = Vec3(2.0, 0.6, 0.4);
  scene.cameras.push_back(camera);
  return scene;
}

/// The view does not need to know what the lamp does in its own room, so next to nothing is known
/// of that; what the lamp sends through the door is known all the same.
TEST(HardCase, ALampInABlackRoomNextDoor)
{
  constexpr double Missed = 1.5; // as above
  constexpr double Noise = 0.02; // standard deviation of the slow twin over seeds
  for (const double error : { 0.05, 0.02 })
  {
    EXPECT_NEAR(test::RelativeToTraced(MakeBlackRoomNextDoor(0.05), error, 256), 1.0,
      Missed * error + 2.0 * Noise)
      << "asked " << error;
  }
}

/// A dark room beside a lit one: nothing can be known relative to no light at all.
TEST(HardCase, AClosedDoor)
{
  const Scene scene = MakeRoomsWithGap(0.0);
  Solver solver(scene);
  solver.SetCamera(scene.cameras[0]);
  Budget budget;
  budget.error = 0.01;
  const RunEnd end =
    solver.Run(budget, [](const StepReport& report) { return report.work.Evaluations() < 100000; });
  EXPECT_EQ(end, RunEnd::Converged);
  const double lit = test::MeanRadiance(test::CasePicture(MakeRoomsWithGap(0.1), 0.05));
  EXPECT_LT(Mean(solver.ViewFluxOfRadiance()), 1e-6 * lit);
}

TEST(HardCase, NoLightAtAll)
{
  const Image black = test::CasePicture(test::MakeFurnace(Color(0.5), Color(0.0)), 0.01);
  EXPECT_EQ(test::MeanRadiance(black), 0.0);
}

TEST(HardCase, AllBlackSurfacesShowTheirEmissionOnly)
{
  const Image picture = test::CasePicture(test::MakeFurnace(Color(0.0), Color(2.0)), 0.01);
  for (const Color& pixel : picture.pixels)
  {
    ASSERT_EQ(pixel, Color(2.0));
  }
}

} // namespace
} // namespace vantage
