#include "accuracy/References.h"
#include "core/formfactor/FormFactor.h"
#include "hardcases/HardCase.h"
#include "support/TestScenes.h"

#include <gtest/gtest.h>

#include <cmath>

namespace vantage
{
namespace
{

/// Cases with closed forms, in the manner of CIE 171:2006, which separates the aspects of light:
/// direct light of an area, flux that is conserved, light that is reflected within a room.

/// Configuration factor from a point to a parallel rectangle a x b at distance c, one of whose
/// corners stands above the point (Howell, configuration B-3).
double ToParallelRectangle(double a, double b, double c)
{
  const double p = std::hypot(a, c);
  const double q = std::hypot(b, c);
  return (a / p * std::atan(b / p) + b / q * std::atan(a / q)) / (2.0 * Pi);
}

/// The same to a perpendicular rectangle at distance c, b wide and a high, one of whose lower
/// corners is the foot of the perpendicular (Howell, configuration B-4).
double ToPerpendicularRectangle(double a, double b, double c)
{
  const double q = std::hypot(a, c);
  return (std::atan(b / c) - c / q * std::atan(b / q)) / (2.0 * Pi);
}

/// Between opposed rectangles a x b at distance c (Howell, configuration C-11).
double BetweenOpposed(double a, double b, double c)
{
  const double x = a / c, y = b / c;
  const double p = std::hypot(1.0, x), q = std::hypot(1.0, y);
  const double logarithm = std::log(p * q / std::sqrt(1.0 + x * x + y * y));
  return 2.0 / (Pi * x * y) *
         (logarithm + x * q * std::atan(x / q) + y * p * std::atan(y / p) - x * std::atan(x) -
           y * std::atan(y));
}

/// From a rectangle l x w to one of height h that stands on its edge l (configuration C-14).
double BetweenAdjacent(double l, double w, double h)
{
  const double x = h / l, y = w / l, r = std::hypot(x, y);
  const double xx = x * x, yy = y * y, rr = xx + yy;
  const double logarithm = std::log((1 + xx) * (1 + yy) / (1 + rr)) +
                           yy * std::log(yy * (1 + rr) / ((1 + yy) * rr)) +
                           xx * std::log(xx * (1 + rr) / ((1 + xx) * rr));
  return (y * std::atan(1 / y) + x * std::atan(1 / x) - r * std::atan(1 / r) + 0.25 * logarithm) /
         (Pi * y);
}

TEST(AnalyticLight, FactorsFromAPointToARectangle)
{
  const Vec3 up(0, 0, 1);
  for (const double a : { 0.1, 1.0, 7.0 })
  {
    for (const double b : { 0.3, 2.0 })
    {
      for (const double c : { 0.01, 0.5, 4.0 })
      {
        SCOPED_TRACE(testing::Message() << a << " x " << b << " at " << c);
        const Polygon parallel{ { 0, 0, c }, { 0, b, c }, { a, b, c }, { a, 0, c } };
        const Polygon upright{ { c, 0, 0 }, { c, 0, a }, { c, b, a }, { c, b, 0 } };
        const double corner = Pi * ToParallelRectangle(a, b, c);
        // Closed forms both: round-off, and what the sums lose to cancellation.
        EXPECT_NEAR(PointToPolygon(Vec3(0), up, parallel) / corner, 1.0, 1e-12);
        const double centre = 4.0 * Pi * ToParallelRectangle(0.5 * a, 0.5 * b, c);
        EXPECT_NEAR(PointToPolygon(Vec3(.5 * a, .5 * b, 0), up, parallel) / centre, 1.0, 1e-12);
        const double wall = Pi * ToPerpendicularRectangle(a, b, c);
        EXPECT_NEAR(PointToPolygon(Vec3(0), up, upright) / wall, 1.0, 1e-11);
      }
    }
  }
}

TEST(AnalyticLight, FactorsBetweenRectangles)
{
  for (const double w : { 0.1, 1.0, 3.0, 10.0 })
  {
    for (const double h : { 0.1, 1.0, 10.0 })
    {
      SCOPED_TRACE(testing::Message() << "1 x " << w << " and " << h);
      const Polygon floor{ { 0, 0, 0 }, { w, 0, 0 }, { w, 1, 0 }, { 0, 1, 0 } };
      const Polygon ceiling{ { 0, 0, h }, { 0, 1, h }, { w, 1, h }, { w, 0, h } };
      const Polygon wall{ { 0, 0, 0 }, { 0, 1, 0 }, { 0, 1, h }, { 0, 0, h } };
      // What the default accuracy promises.
      EXPECT_NEAR(Throughput(floor, ceiling) / (Pi * w * BetweenOpposed(1, w, h)), 1.0, 1e-5);
      EXPECT_NEAR(Throughput(floor, wall) / (Pi * w * BetweenAdjacent(1, w, h)), 1.0, 1e-5);
    }
  }
}

constexpr int Pixels = 48;

/// What the solver makes of a black lamp and one patch that it lights, against closed forms at the
/// pixels: the rectangle is cut in four at the foot of the perpendicular.
TEST(AnalyticLight, DirectLightOfARectangleAtThePixels)
{
  constexpr double Albedo = 0.8, Emission = 5.0, Width = 2.0, Depth = 1.0, Height = 0.7;
  Scene scene;
  scene.materials = { test::MakeMaterial(Color(Albedo)),
    test::MakeMaterial(Color(0.0), Color(Emission)) };
  scene.AddPolygon({ Vec3(-9, -9, 0), Vec3(9, -9, 0), Vec3(9, 9, 0), Vec3(-9, 9, 0) }, 0);
  scene.AddPolygon({ Vec3(0, 0, Height), Vec3(0, Depth, Height), Vec3(Width, Depth, Height),
                     Vec3(Width, 0, Height) },
    1);
  Camera camera;
  camera.eye = Vec3(-0.9, -0.8, 0.6); // below the plane of the lamp, which is not in the picture
  camera.lookAt = Vec3(1.0, 0.6, 0.0);
  camera.up = Vec3(0, 0, 1);
  camera.fieldOfView = 20.0;
  scene.cameras = { camera };
  const ImagePlane plane(camera);
  const auto corner = [](double a, double b)
  { return std::copysign(1.0, a * b) * ToParallelRectangle(std::abs(a), std::abs(b), Height); };
  Image expected(Pixels, Pixels);
  for (int y = 0; y < Pixels; ++y)
  {
    for (int x = 0; x < Pixels; ++x)
    {
      const Vec3 d =
        plane.Direction((2.0 * x + 1.0) / Pixels - 1.0, (2.0 * y + 1.0) / Pixels - 1.0);
      const Vec3 p = plane.eye - plane.eye.z / d.z * d;
      ASSERT_LT(d.z, 0.0);
      const double factor = corner(Width - p.x, Depth - p.y) + corner(p.x, Depth - p.y) +
                            corner(Width - p.x, p.y) + corner(p.x, p.y);
      expected.At(x, y) = Color(Albedo * Emission * factor);
    }
  }
  const double error = Compare(test::CasePicture(scene, 0.02, Pixels), expected).relativeL1;
  test::Record("direct light of a rectangle, relative L1 at the pixels", error);
  EXPECT_LT(error, 1e-12); // closed forms both: round-off
}

/// Area times radiance that is reflected, all elements, times pi: the flux that leaves the surfaces
/// of a scene again.
double ReflectedFlux(const Solver& solver)
{
  const ElementSolution elements = solver.Elements();
  double flux = 0.0;
  for (std::size_t k = 0; k < elements.radiance.size(); ++k)
  {
    Polygon shape;
    Vec3 area(0.0);
    const ElementSurface& surface = elements.surface;
    const Vec3 first = surface.points[surface.indices[surface.offsets[k]]];
    for (std::uint32_t i = surface.offsets[k] + 1; i + 1 < surface.offsets[k + 1]; ++i)
    {
      area += 0.5 * glm::cross(surface.points[surface.indices[i]] - first,
                      surface.points[surface.indices[i + 1]] - first);
    }
    flux += Pi * glm::length(area) * Mean(elements.radiance[k] - elements.emission[k]);
  }
  return flux;
}

constexpr double Albedos[] = { 0.05, 0.15, 0.35, 0.50, 0.65, 0.80, 0.95 };
constexpr double LampRadiance = 30.0;
constexpr double LampArea = 0.2 * 0.2;

/// A closed room of one albedo with a lamp below its ceiling and a block that floats: what lies on
/// another surface would cover a part of it, which then is no surface.
Scene MakeRoomWithLamp(double albedo)
{
  Scene scene;
  scene.materials = { test::MakeMaterial(Color(albedo)),
    test::MakeMaterial(Color(albedo), Color(LampRadiance), true) };
  test::AddBox(scene, Vec3(0.0), Vec3(1.0), true, { 0, 0, 0, 0, 0, 0 });
  test::AddBox(scene, Vec3(0.55, 0.5, 0.1), Vec3(0.85, 0.8, 0.4), false, { 0, 0, 0, 0, 0, 0 });
  scene.AddPolygon(
    { Vec3(0.4, 0.4, 0.95), Vec3(0.4, 0.6, 0.95), Vec3(0.6, 0.6, 0.95), Vec3(0.6, 0.4, 0.95) }, 1);
  scene.cameras = { test::InsideCamera() };
  return scene;
}

/// A closed scene of one albedo, whatever its shape: of the flux Phi that lamps give, surfaces
/// receive I = Phi + albedo I, as all of it arrives somewhere. So the mean indirect irradiance is
/// Phi / S * albedo / (1 - albedo), S the area of all surfaces, both sides of those within. Oracle:
/// that closed form, the integrating sphere's, for the total; the distribution is another matter.
TEST(AnalyticLight, TheFluxThatAClosedSceneReflects)
{
  double worst = 0.0;
  for (const double albedo : Albedos)
  {
    const double expected = Pi * LampArea * LampRadiance * albedo / (1.0 - albedo);
    const Solver solver = test::SolvedCase(MakeRoomWithLamp(albedo), 0.05);
    worst = std::max(worst, std::abs(ReflectedFlux(solver) / expected - 1.0));
  }
  test::Record("flux reflected in a closed room, albedo .05 to .95, worst", worst);
  // However coarse the elements: rows are closed to 1e-5, and the last sweep balances the sum.
  EXPECT_LT(worst, 1e-4);
}

/// Where all walls give the same, the form holds at each of them, to the pixel.
TEST(AnalyticLight, TheInterreflectionOfACubeThatGlows)
{
  double worst = 0.0;
  for (const double albedo : Albedos)
  {
    const double direct = 1.0; // Phi / S = pi times this
    const Image picture =
      test::CasePicture(test::MakeFurnace(Color(albedo), Color(direct)), 0.05, Pixels);
    for (const Color& pixel : picture.pixels)
    {
      const double reflected = Mean(pixel) - direct;
      worst = std::max(worst, std::abs(reflected * (1.0 - albedo) / (albedo * direct) - 1.0));
    }
  }
  test::Record("internal reflection of a glowing cube, albedo .05 to .95, worst pixel", worst);
  EXPECT_LT(worst, 1e-3);
}

} // namespace
} // namespace vantage
