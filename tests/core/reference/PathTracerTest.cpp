#include "core/reference/PathTracer.h"

#include "core/Error.h"
#include "core/reference/DenseSolve.h"
#include "core/reference/TestRooms.h"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <cmath>

namespace vantage
{
namespace
{

using namespace testing;

struct Stage
{
  Scene scene;
  FacetSet facets;
  OccluderScene occluders;
  PathTracer tracer;

  explicit Stage(const Scene& s)
    : scene(s)
    , facets(BuildFacets(this->scene))
    , occluders(this->facets)
    , tracer(this->scene, this->facets, this->occluders)
  {
  }
};

struct Statistics
{
  double mean = 0.0;
  double error = 0.0; ///< standard error of the mean
};

/// Of the pixels of an image, one channel. Pixels are independent, whatever the strata within.
Statistics StatisticsOf(const Image& image, int channel = 0)
{
  Statistics s;
  double squares = 0.0;
  const double n = static_cast<double>(image.pixels.size());
  for (const Color& pixel : image.pixels)
  {
    s.mean += pixel[channel] / n;
    squares += pixel[channel] * pixel[channel] / n;
  }
  s.error = std::sqrt(std::max(0.0, squares - s.mean * s.mean) / (n - 1.0));
  return s;
}

const Camera IntoTheFurnace = LookingAt({ 0.7, 0.4, 0.6 }, { 2, 0.8, 0.3 }, { 0, 0, 1 }, 70.0);

TEST(PathTracer, FurnaceIsEvenlyBright)
{
  const Stage stage(Furnace(Color(0.5, 0.7, 0.0), Color(1.0)));
  PathTracerSettings settings;
  settings.samplesPerPixel = 64;
  const Image image = stage.tracer.Render(IntoTheFurnace, 32, 32, settings);
  for (int channel = 0; channel < 2; ++channel)
  {
    const Statistics s = StatisticsOf(image, channel);
    const double expected = channel == 0 ? 2.0 : 1.0 / 0.3;
    // Four standard errors, fixed seed; the error itself must be small for the test to mean much.
    EXPECT_NEAR(s.mean, expected, 4.0 * s.error);
    EXPECT_LT(s.error, 0.01 * expected);
  }
  EXPECT_EQ(StatisticsOf(image, 2).mean, 1.0);
}

/// Both halves of the floor, one in the shade of the pane: a picture that is parallel to the floor
/// and holds just one half has the mean radiance of that half.
TEST(PathTracer, AgreesWithTheDenseSolutionOfAShadedRoom)
{
  const Stage stage(ShadedRoom());
  DenseSettings coarse;
  coarse.level = 1;
  DenseSettings fine;
  fine.level = 2;
  const auto floorMean = [](const DenseSolution& solution, double x0, double x1)
  {
    Color sum(0.0);
    double area = 0.0;
    for (std::size_t i = 0; i < solution.elements.size(); ++i)
    {
      const Node& node = solution.tree[solution.elements[i]];
      if (node.centre.z == 0.0 && node.centre.x > x0 && node.centre.x < x1 &&
          solution.tree.PatchOfNode(solution.elements[i]).normal.z > 0.0)
      {
        sum += node.area * solution.radiance[i];
        area += node.area;
      }
    }
    return sum / area;
  };
  const DenseSolution solution = SolveDense(stage.scene, coarse);
  const DenseSolution better = SolveDense(stage.scene, fine);
  PathTracerSettings settings;
  settings.samplesPerPixel = 64;
  settings.shadowRays = 2;
  for (const double x0 : { 0.0, 1.0 })
  {
    // Straight down from below the pane: a frustum that holds just one half of the floor.
    const double height = 0.5;
    Camera camera = LookingAt({ x0 + 0.5, 1.0, height }, { x0 + 0.5, 1.0, 0 }, { 0, 1, 0 },
      2.0 * std::atan(1.0 / height) * 180.0 / Pi);
    camera.aspect = 0.5;
    const Image image = stage.tracer.Render(camera, 16, 32, settings);
    for (int channel = 0; channel < 3; ++channel)
    {
      const Statistics s = StatisticsOf(image, channel);
      const double coarseMean = floorMean(solution, x0, x0 + 1.0)[channel];
      const double fineMean = floorMean(better, x0, x0 + 1.0)[channel];
      // Four times the noise (the spread of pixels holds the shadow too, so this is generous), and
      // what constant elements are off: the error falls by 2 or more with the level.
      EXPECT_NEAR(s.mean, fineMean, 4.0 * s.error + 2.0 * std::abs(fineMean - coarseMean));
      EXPECT_LT(std::abs(s.mean - fineMean), 0.05 * fineMean);
    }
  }
}

TEST(PathTracer, LampsAreSeenDirectlyAndOnlyFromTheirFront)
{
  Scene scene;
  scene.materials = { Diffuse(Color(0.0), Color(3.0, 2.0, 1.0)) };
  scene.AddPolygon({ { -1, -1, 0 }, { 1, -1, 0 }, { 1, 1, 0 }, { -1, 1, 0 } }, 0);
  const Stage stage(scene);
  PathTracerSettings settings;
  settings.samplesPerPixel = 3;
  EXPECT_EQ(
    stage.tracer.Render(LookingAt({ 0, 0, 2 }, { 0, 0, 0 }, { 0, 1, 0 }, 10), 1, 1, settings)
      .At(0, 0),
    Color(3.0, 2.0, 1.0));
  EXPECT_EQ(
    stage.tracer.Render(LookingAt({ 0, 0, -2 }, { 0, 0, 0 }, { 0, 1, 0 }, 10), 1, 1, settings)
      .At(0, 0),
    Color(0.0));
}

TEST(PathTracer, DirectLightIsTheFormFactor)
{
  // A floor under the middle of a unit lamp at height 1: albedo times the classical form factor.
  Scene scene;
  scene.materials = { Diffuse(Color(0.5)), Diffuse(Color(0.0), Color(1.0)) };
  scene.AddPolygon({ { -5, -5, 0 }, { 5, -5, 0 }, { 5, 5, 0 }, { -5, 5, 0 } }, 0);
  scene.AddPolygon({ { -.5, -.5, 1 }, { -.5, .5, 1 }, { .5, .5, 1 }, { .5, -.5, 1 } }, 1);
  const Stage stage(scene);
  PathTracerSettings settings;
  settings.pixelCentres = true;
  settings.samplesPerPixel = 4096;
  const Image image =
    stage.tracer.Render(LookingAt({ 0, 0, 0.5 }, { 0, 0, 0 }, { 0, 1, 0 }, 1.0), 1, 1, settings);
  // Four quarters with sides a = 1/2, s = sqrt(1 + a^2): each 2 (a / s) atan(a / s) / (2 pi).
  const double a = 0.5;
  const double s = std::sqrt(1.0 + a * a);
  const double classical = 4.0 * (2.0 * a / s * std::atan(a / s)) / (2.0 * Pi);
  // 4096 scrambled Sobol' points on a smooth integrand: error of order n^-1 or better.
  EXPECT_NEAR(image.At(0, 0).x, 0.5 * classical, 1e-4);
}

TEST(PathTracer, OneSidedBacksReflectNothing)
{
  Scene scene = Furnace(Color(0.5), Color(1.0));
  scene.materials.push_back(Diffuse(Color(0.9)));
  scene.materials[1].twoSided = false;
  scene.AddPolygon({ { 0.5, 0, 0.2 }, { 1.5, 0, 0.2 }, { 1.5, 1, 0.2 }, { 0.5, 1, 0.2 } }, 1);
  const Stage stage(scene);
  PathTracerSettings settings;
  settings.samplesPerPixel = 4;
  const auto look = [&](double z)
  {
    return stage.tracer
      .Render(LookingAt({ 1, 0.5, z }, { 1, 0.5, 0.2 }, { 0, 1, 0 }, 5.0), 1, 1, settings)
      .At(0, 0)
      .x;
  };
  EXPECT_GT(look(0.3), 0.5);
  EXPECT_EQ(look(0.1), 0.0);
}

TEST(PathTracer, DoublingTheEmissionDoublesEveryPixelExactly)
{
  PathTracerSettings settings;
  settings.samplesPerPixel = 4;
  const Camera camera = LookingAt({ 1, 0.1, 0.5 }, { 1, 2, 0.4 }, { 0, 0, 1 }, 80.0);
  const Color emission(10.0, 8.0, 6.0);
  Image once = Stage(ShadedRoom(emission)).tracer.Render(camera, 24, 24, settings);
  const Image twice = Stage(ShadedRoom(2.0 * emission)).tracer.Render(camera, 24, 24, settings);
  for (Color& pixel : once.pixels)
  {
    pixel *= 2.0;
  }
  EXPECT_EQ(once.pixels, twice.pixels);
}

TEST(PathTracer, IsTheSameForAnyNumberOfThreads)
{
  const Stage stage(ShadedRoom());
  PathTracerSettings settings;
  settings.samplesPerPixel = 3;
  const Camera camera = LookingAt({ 1, 0.1, 0.5 }, { 1, 2, 0.4 }, { 0, 0, 1 }, 80.0);
  const auto render = [&](int threads, PathTracerReport& report)
  {
    const tbb::global_control control(tbb::global_control::max_allowed_parallelism, threads);
    return stage.tracer.Render(camera, 33, 17, settings, &report).pixels;
  };
  PathTracerReport one, two, four;
  const auto pixels = render(1, one);
  EXPECT_EQ(pixels, render(2, two));
  EXPECT_EQ(pixels, render(4, four));
  EXPECT_EQ(one.rays, four.rays);
  EXPECT_EQ(one.relativeNoise, four.relativeNoise);
  EXPECT_EQ(one.samplesPerPixel, 3);
}

/// A room under a ceiling of many small lamps must look as under one lamp of the same power.
TEST(PathTracer, AThousandLampsLightLikeOne)
{
  const auto room = [](int side)
  {
    Scene scene;
    scene.materials = { Diffuse(Color(0.5)), Diffuse(Color(0.0), Color(1.0)) };
    AddBox(scene, { 0, 0, 0 }, { 4, 4, 2 }, 0);
    const double step = 4.0 / side;
    for (int i = 0; i < side * side; ++i)
    {
      const Vec3 a(step * (i % side), step * (i / side), 1.9);
      scene.AddPolygon(
        { a, a + Vec3(0, step, 0), a + Vec3(step, step, 0), a + Vec3(step, 0, 0) }, 1);
    }
    return scene;
  };
  PathTracerSettings settings;
  settings.samplesPerPixel = 32;
  const Camera camera = LookingAt({ 0.3, 0.3, 1 }, { 3, 3, 0.2 }, { 0, 0, 1 }, 60.0);
  PathTracerReport oneReport, manyReport;
  const Image one = Stage(room(1)).tracer.Render(camera, 24, 24, settings, &oneReport);
  const Image many = Stage(room(32)).tracer.Render(camera, 24, 24, settings, &manyReport);
  const Statistics a = StatisticsOf(one);
  const Statistics b = StatisticsOf(many);
  // Both noises as the report gives them (per pixel, 576 pixels average), four of them.
  const double noise = a.mean * std::hypot(oneReport.relativeNoise, manyReport.relativeNoise) / 24;
  EXPECT_NEAR(a.mean, b.mean, 4.0 * noise);
  // Choosing by distance and cosine keeps the noise low: a thousand lamps are no noisier.
  EXPECT_LT(manyReport.relativeNoise, 1.5 * oneReport.relativeNoise);
}

TEST(PathTracer, LookingUpTheExactRadianceGivesTheFurnaceToo)
{
  const Stage stage(Furnace(Color(0.5), Color(1.0)));
  PathTracerSettings settings;
  settings.samplesPerPixel = 16;
  settings.gatherRays = 4;
  settings.shadowRays = 4;
  // What leaves without its own emission: 2 - 1.
  const Image image = stage.tracer.Render(
    IntoTheFurnace, 24, 24, settings, nullptr, [](const Hit&) { return Color(1.0); });
  const Statistics s = StatisticsOf(image);
  EXPECT_NEAR(s.mean, 2.0, 4.0 * s.error);
  EXPECT_LT(s.error, 0.02);
}

TEST(PathTracer, MoreRaysAtTheFirstHitLessNoise)
{
  const Stage stage(ShadedRoom());
  const Camera camera = LookingAt({ 1, 0.1, 0.5 }, { 1, 2, 0.4 }, { 0, 0, 1 }, 80.0);
  const auto noise = [&](int rays)
  {
    PathTracerSettings settings;
    settings.samplesPerPixel = 16;
    settings.shadowRays = settings.gatherRays = rays;
    PathTracerReport report;
    stage.tracer.Render(camera, 16, 16, settings, &report);
    return report.relativeNoise;
  };
  EXPECT_LT(noise(16), 0.5 * noise(1));
}

TEST(PathTracer, ProgressRisesAndStops)
{
  const Stage stage(Furnace(Color(0.5), Color(1.0)));
  PathTracerSettings settings;
  settings.samplesPerPixel = 10;
  PathTracerReport report;
  std::vector<double> seen;
  stage.tracer.Render(IntoTheFurnace, 4, 4, settings, &report, {},
    [&](double done)
    {
      seen.push_back(done);
      return seen.size() < 4;
    });
  EXPECT_EQ(seen, (std::vector<double>{ 0.1, 0.2, 0.3, 0.4 }));
  EXPECT_EQ(report.samplesPerPixel, 4);
  settings.seconds = 1e-9;
  stage.tracer.Render(IntoTheFurnace, 4, 4, settings, &report);
  EXPECT_EQ(report.samplesPerPixel, 1);
}

TEST(PathTracer, PerfectReflectorsDoNotTraceForEver)
{
  const Stage stage(Furnace(Color(1.0), Color(1.0)));
  PathTracerSettings settings;
  settings.samplesPerPixel = 1;
  const Image image = stage.tracer.Render(IntoTheFurnace, 4, 4, settings);
  EXPECT_GT(StatisticsOf(image).mean, 2.0);
}

TEST(PathTracerSettings, BadValuesAreNamed)
{
  PathTracerSettings settings;
  settings.shadowRays = 0;
  try
  {
    settings.Validate();
    FAIL();
  }
  catch (const InputError& error)
  {
    EXPECT_STREQ(error.what(), "shadow rays is 0; give a number of at least 1");
  }
  settings.shadowRays = 1;
  settings.seconds = std::nan("");
  EXPECT_THROW(settings.Validate(), InputError);
}

} // namespace
} // namespace vantage
