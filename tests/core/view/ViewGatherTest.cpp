#include "core/Error.h"
#include "core/math/Sampling.h"
#include "core/transport/ExtractRadianceSolution.h"
#include "core/transport/Schedule.h"
#include "core/view/GatherStage.h"
#include "core/view/HemisphereGather.h"
#include "core/view/SecondLook.h"
#include "core/view/SurfaceGather.h"
#include "support/TestScenes.h"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace vantage
{
namespace
{

using test::AddMaterial;
using test::AddRoom;
using test::CameraAt;
using test::GatherStage;
using test::Pixels;

/// A closed room with a lamp, a crate on the floor and a pane that hangs near a wall.
Scene MakeFurnishedRoom()
{
  Scene scene;
  const std::uint32_t white = AddMaterial(scene, { 0.7, 0.6, 0.5 });
  const std::uint32_t blue = AddMaterial(scene, { 0.2, 0.4, 0.7 });
  const std::uint32_t lamp = AddMaterial(scene, Color(0.3), Color(20.0, 18.0, 15.0));
  AddRoom(scene, { 0, 0, 0 }, { 4, 3, 2.5 }, white);
  scene.AddPolygon(
    { { 1.8, 1.2, 2.4 }, { 1.8, 1.7, 2.4 }, { 2.3, 1.7, 2.4 }, { 2.3, 1.2, 2.4 } }, lamp);
  const Vec3 a(0.8, 0.7, 0.0);
  const Vec3 b(1.5, 1.3, 0.7);
  const auto add = [&](const std::vector<Vec3>& points) { scene.AddPolygon(points, blue); };
  add({ { a.x, a.y, b.z }, { b.x, a.y, b.z }, { b.x, b.y, b.z }, { a.x, b.y, b.z } });
  add({ { a.x, a.y, a.z }, { b.x, a.y, a.z }, { b.x, a.y, b.z }, { a.x, a.y, b.z } });
  add({ { b.x, b.y, a.z }, { a.x, b.y, a.z }, { a.x, b.y, b.z }, { b.x, b.y, b.z } });
  add({ { a.x, b.y, a.z }, { a.x, a.y, a.z }, { a.x, a.y, b.z }, { a.x, b.y, b.z } });
  add({ { b.x, a.y, a.z }, { b.x, b.y, a.z }, { b.x, b.y, b.z }, { b.x, a.y, b.z } });
  scene.AddPolygon(
    { { 0.1, 1.5, 1.0 }, { 0.1, 2.5, 1.0 }, { 0.2, 2.5, 1.8 }, { 0.2, 1.5, 1.8 } }, blue);
  return scene;
}

Camera RoomCamera()
{
  return CameraAt({ 3.7, 2.6, 1.8 }, { 0.8, 0.9, 0.6 }, 60.0);
}

/// Solved coarsely: what is known is exact for the gather's purposes.
GatherStage Solved(const Scene& scene)
{
  GatherStage stage(scene, [](PatchId) { return Color(0.0); });
  TransportSettings settings;
  settings.refinement.powerTolerance = 1e-3;
  settings.refinement.shadowTolerance = 1e-3;
  Transport transport(stage.tree, stage.occluders, stage.Optics(), stage.facets.meanArea, settings);
  const auto schedule = MakeSchedule(Method::ProgressiveShooting, Granularity::Patch, transport);
  for (std::uint32_t step = 1; step <= 150; ++step)
  {
    if (const auto next = schedule->Next(transport, step))
    {
      schedule->Perform(transport, *next, step);
    }
  }
  stage.solution = ExtractRadianceSolution(transport);
  return stage;
}

/// Every pixel by itself: exact direct light and very many rays, twice.
Image BruteForce(const GatherStage& stage, const Camera& camera, int size)
{
  constexpr std::uint32_t Rays = 2048;
  const SurfaceGather gather(stage.occluders, stage.solution);
  Image image(size, size);
  std::vector<GatherPoint> points;
  std::vector<Color*> pixels;
  for (int y = 0; y < size; ++y)
  {
    for (int x = 0; x < size; ++x)
    {
      const auto hit = stage.Centre(camera, size, size, x, y);
      if (hit && stage.solution.IsActive(hit->Patch()))
      {
        points.push_back({ hit->Patch(), hit->point });
        pixels.push_back(&image.At(x, y));
      }
    }
  }
  GatherCounts counts;
  const std::vector<Color> direct = gather.Direct(points, 0.0, counts);
  std::vector<Hit> hits;
  for (std::size_t i = 0; i < points.size(); ++i)
  {
    const PatchId patch = points[i].patch;
    const Frame frame(stage.Normal(patch));
    for (std::uint64_t k = 0; k < 16; ++k)
    {
      const Vec3 way = frame.ToWorld(CosineHemisphere(RandomStream(78, i, k).Next2()));
      if (const auto hit = stage.occluders.Intersect(points[i].point, way, patch / 2))
      {
        hits.push_back(*hit);
      }
    }
  }
  LitSurfaces lit(stage.occluders, stage.solution);
  SecondLook look(stage.occluders, stage.solution, 16, 79);
  look.From(hits, lit);
  look.Apply(lit);
  for (std::size_t i = 0; i < points.size(); ++i)
  {
    const PatchId patch = points[i].patch;
    const Color indirect =
      GatherHemisphere(stage.occluders, lit, patch, points[i].point, Rays, Hash(77, i)).irradiance;
    *pixels[i] =
      stage.solution.emission[patch] + stage.solution.albedo[patch] / Pi * (direct[i] + indirect);
  }
  return image;
}

TEST(ViewGather, AFurnaceGlowsEvenly)
{
  const Color albedo(0.9, 0.5, 0.2);
  const Color emission(1.0, 2.0, 3.0);
  Scene scene;
  AddRoom(scene, { 0, 0, 0 }, { 2, 1, 1.5 }, AddMaterial(scene, albedo, emission, false));
  const Color expected = emission / (1.0 - albedo);
  const GatherStage stage(scene, [&](PatchId) { return albedo * (expected - emission); });
  const Camera camera = CameraAt({ 1.7, 0.8, 1.2 }, { 0.3, 0.3, 0.2 }, 80.0);
  for (const bool centres : { true, false })
  {
    const GatheredView view = stage.Gather(camera, Pixels(48, 48, centres));
    for (const Color& pixel : view.radiance.pixels)
    {
      ASSERT_LT(MaxChannel(glm::abs(pixel / expected - 1.0)), 1e-4);
    }
    EXPECT_LT(view.report.errorEstimate, 1e-4);
  }
}

/// The mean over four seeds: what is left of one picture's mean error is noise.
double BiasOf(const GatherStage& stage, GatherSettings settings, const Image& exact)
{
  constexpr int Seeds = 4;
  double sum = 0.0;
  for (settings.seed = 1; settings.seed <= Seeds; ++settings.seed)
  {
    sum += Compare(stage.Gather(RoomCamera(), settings).radiance, exact).relativeBias;
  }
  return sum / Seeds;
}

TEST(ViewGather, IndirectLightIsWithinThePromisedError)
{
  constexpr int Size = 64;
  const GatherStage stage = Solved(MakeFurnishedRoom());
  const Image exact = BruteForce(stage, RoomCamera(), Size);
  std::uint64_t rays = 0;
  for (const double error : { 0.03, 0.01, 0.004 })
  {
    const GatherSettings settings = Pixels(Size, Size, true, error);
    const GatheredView view = stage.Gather(RoomCamera(), settings);
    const double truth = Compare(view.radiance, exact).relativeL1;
    EXPECT_LT(truth, error);
    EXPECT_GT(truth, 0.1 * error);
    EXPECT_GT(view.report.errorEstimate, 0.7 * truth) << error;
    EXPECT_LT(view.report.errorEstimate, 3.0 * truth) << error;
    EXPECT_LT(std::abs(BiasOf(stage, settings, exact)), 0.3 * error);
    EXPECT_GT(view.report.gatherRays, rays);
    EXPECT_LT(view.report.gatherPoints, static_cast<std::uint64_t>(Size * Size / 2));
    rays = view.report.gatherRays;
  }
}

/// A ball of 2,200 triangles: each by itself would take as many points as it has pixels.
TEST(ViewGather, FacetsOfACurvedSurfaceAreGatheredTogether)
{
  constexpr int Size = 64;
  Scene scene;
  const std::uint32_t white = AddMaterial(scene, Color(0.5), Color(0.0), false);
  const std::uint32_t red = AddMaterial(scene, Color(0.7, 0.2, 0.1), Color(0.0), false);
  const std::uint32_t lamp = AddMaterial(scene, Color(0.5), Color(9.0), false);
  AddRoom(scene, { 0, 0, 0 }, { 2, 2, 2 }, red);
  test::AddBall(scene, { 1.0, 1.0, 0.8 }, 0.6, 24, white);
  scene.AddPolygon(
    { { 0.5, 0.5, 1.9 }, { 0.5, 1.0, 1.9 }, { 1.0, 1.0, 1.9 }, { 1.0, 0.5, 1.9 } }, lamp);
  const GatherStage stage = Solved(scene);
  const Camera camera = CameraAt({ 0.2, 0.3, 1.5 }, { 1.0, 1.0, 0.8 }, 60.0);
  const Image exact = BruteForce(stage, camera, Size);
  for (const double error : { 0.03, 0.01 })
  {
    const GatheredView view = stage.Gather(camera, Pixels(Size, Size, true, error));
    const double truth = Compare(view.radiance, exact).relativeL1;
    EXPECT_LT(truth, error);
    EXPECT_GT(view.report.errorEstimate, 0.5 * truth) << error; // as with each facet by itself
    EXPECT_LT(view.report.gatherPoints, static_cast<std::uint64_t>(Size * Size / 10));
  }
}

TEST(ViewGather, IsTheSameToTheBitForAnyNumberOfThreads)
{
  const GatherStage stage = Solved(MakeFurnishedRoom());
  std::vector<GatheredView> views;
  for (const std::size_t threads : { 1, 2, 4 })
  {
    const tbb::global_control control(tbb::global_control::max_allowed_parallelism, threads);
    views.push_back(stage.Gather(RoomCamera(), Pixels(80, 60, false)));
  }
  for (const GatheredView& view : views)
  {
    EXPECT_EQ(view.radiance.pixels, views[0].radiance.pixels);
    EXPECT_EQ(view.depth, views[0].depth);
    EXPECT_EQ(view.patch, views[0].patch);
    EXPECT_EQ(view.report.gatherRays, views[0].report.gatherRays);
    EXPECT_EQ(view.report.errorEstimate, views[0].report.errorEstimate);
  }
}

TEST(ViewGather, AnotherSeedGivesAnotherImageWithinTheError)
{
  const GatherStage stage = Solved(MakeFurnishedRoom());
  GatherSettings settings = Pixels(64, 64, true);
  const GatheredView one = stage.Gather(RoomCamera(), settings);
  settings.seed = 2;
  const GatheredView other = stage.Gather(RoomCamera(), settings);
  const double difference = Compare(one.radiance, other.radiance).relativeL1;
  EXPECT_GT(difference, 0.0);
  EXPECT_LT(difference, 2.0 * settings.error);
}

TEST(ViewGather, DepthAndPatchesAreThoseOfThePixelCentres)
{
  const GatherStage stage = Solved(MakeFurnishedRoom());
  for (const bool centres : { true, false })
  {
    const GatheredView view = stage.Gather(RoomCamera(), Pixels(32, 24, centres, 0.1));
    for (int y = 0; y < 24; ++y)
    {
      for (int x = 0; x < 32; ++x)
      {
        const auto hit = stage.Centre(RoomCamera(), 32, 24, x, y);
        ASSERT_TRUE(hit);
        const std::size_t pixel = y * 32 + x;
        const double depth = glm::distance(hit->point, RoomCamera().eye);
        ASSERT_NEAR(view.depth[pixel], depth, 1e-6 * depth);
        ASSERT_EQ(view.patch[pixel], hit->Patch());
      }
    }
  }
}

/// A glowing triangle before nothing: a pixel is as bright as the part of it that is covered.
TEST(ViewGather, AnEdgeCoversPartsOfPixels)
{
  constexpr int Size = 24;
  Scene scene;
  const std::uint32_t glow = AddMaterial(scene, Color(0.0), Color(1.0));
  scene.AddPolygon({ { -0.8, -0.7, 0 }, { 0.9, -0.2, 0 }, { -0.1, 0.85, 0 } }, glow);
  // A strip of a tenth of a pixel.
  scene.AddPolygon(
    { { 0.5, -0.9, 0 }, { 0.95, -0.9, 0 }, { 0.95, -0.89, 0 }, { 0.5, -0.89, 0 } }, glow);
  const GatherStage stage(scene, [](PatchId) { return Color(0.0); });
  // The image shows the square [-1, 1]^2 of the plane z = 0.
  const Camera camera = CameraAt({ 0, 0, 1 }, { 0, 0, 0 }, 90.0, { 0, 1, 0 });
  const Image image = stage.Gather(camera, Pixels(Size, Size, false)).radiance;
  double sum = 0.0;
  double expectedSum = 0.0;
  int partly = 0;
  for (int y = 0; y < Size; ++y)
  {
    for (int x = 0; x < Size; ++x)
    {
      const Vec2 low = 2.0 * Vec2(x, y) / double(Size) - 1.0;
      const Vec2 high = low + 2.0 / Size;
      double covered = 0.0;
      for (const Facet& facet : stage.facets.facets)
      {
        Polygon part = facet.shape;
        for (const Plane& side : { Plane{ { 1, 0, 0 }, low.x }, Plane{ { -1, 0, 0 }, -high.x },
               Plane{ { 0, 1, 0 }, low.y }, Plane{ { 0, -1, 0 }, -high.y } })
        {
          part = ClipToFront(part, side);
        }
        covered += part.Empty() ? 0.0 : Area(part) * Size * Size / 4.0;
      }
      const double pixel = image.At(x, y).x;
      ASSERT_NEAR(pixel, covered, 0.125) << x << ' ' << y;
      partly += covered > 0.01 && covered < 0.99 ? 1 : 0;
      sum += pixel;
      expectedSum += covered;
    }
  }
  EXPECT_GT(partly, 30);
  EXPECT_NEAR(sum / expectedSum, 1.0, 0.01);
}

/// The hard shadow of a small lamp: an antialiased pixel is the mean over its area.
TEST(ViewGather, AnEdgeOfAShadowIsSmooth)
{
  Scene scene;
  const std::uint32_t floor = AddMaterial(scene, Color(0.5));
  const std::uint32_t lamp = AddMaterial(scene, Color(0.0), Color(1e4));
  const std::uint32_t black = AddMaterial(scene, Color(0.0));
  scene.AddPolygon({ { -2, -2, 0 }, { 2, -2, 0 }, { 2, 2, 0 }, { -2, 2, 0 } }, floor);
  scene.AddPolygon({ { 0, 0, 2 }, { 0, 0.01, 2 }, { 0.01, 0.01, 2 }, { 0.01, 0, 2 } }, lamp);
  scene.AddPolygon({ { -5, -5, 1 }, { 0.2, -5, 1 }, { -0.1, 5, 1 }, { -5, 5, 1 } }, black);
  const GatherStage stage(scene, [](PatchId) { return Color(0.0); });
  const Camera camera = CameraAt({ 0, 0, 0.9 }, { 0, 0, 0 }, 70.0, { 0, 1, 0 });
  const Image mean = BlockMeans(stage.Gather(camera, Pixels(512, 512, true)).radiance, 16);
  const Image smooth = stage.Gather(camera, Pixels(32, 32, false)).radiance;
  const Image centres = stage.Gather(camera, Pixels(32, 32, true)).radiance;
  const double jagged = Compare(centres, mean).relativeL1;
  EXPECT_GT(jagged, 0.005);
  EXPECT_LT(Compare(smooth, mean).relativeL1, 0.2 * jagged);
}

TEST(ViewGather, InactiveSidesAreBlackAndBringNoLight)
{
  // A floor below a pane whose back side looks down.
  const auto floorPixel = [](bool twoSided)
  {
    Scene scene;
    const std::uint32_t floor = AddMaterial(scene, Color(0.5));
    const std::uint32_t pane = AddMaterial(scene, Color(0.5), Color(0.0), twoSided);
    scene.AddPolygon({ { -1, -1, 0 }, { 1, -1, 0 }, { 1, 1, 0 }, { -1, 1, 0 } }, floor);
    scene.AddPolygon({ { -9, -9, 1 }, { 9, -9, 1 }, { 9, 9, 1 }, { -9, 9, 1 } }, pane);
    const GatherStage stage(scene, [](PatchId) { return Color(2.0); });
    const Camera camera = CameraAt({ 0.0, -0.5, 0.8 }, { 0.0, 0.0, 0.0 }, 20.0);
    return stage.Gather(camera, Pixels(3, 3, true)).radiance.At(1, 1).x;
  };
  EXPECT_GT(floorPixel(true), 0.1);
  EXPECT_EQ(floorPixel(false), 0.0);

  Scene box;
  AddRoom(box, { 0, 0, 0 }, { 1, 1, 1 }, AddMaterial(box, Color(0.5), Color(3.0), false));
  const GatherStage stage(box, [](PatchId) { return Color(2.0); });
  const Camera outside = CameraAt({ 3, 0.4, 0.6 }, { 0.5, 0.5, 0.5 }, 20.0);
  for (const bool centres : { true, false })
  {
    const GatheredView view = stage.Gather(outside, Pixels(8, 8, centres));
    EXPECT_EQ(view.radiance.At(4, 4), Color(0.0));
    EXPECT_NEAR(view.depth[4 * 8 + 4], 2.0, 0.1);
    EXPECT_EQ(view.patch[4 * 8 + 4], None);
  }
}

TEST(ViewGather, ACameraMaySeeNothing)
{
  Scene scene;
  scene.AddPolygon({ { 0, 0, 0 }, { 1, 0, 0 }, { 0, 1, 0 } }, AddMaterial(scene, Color(0.5)));
  const GatherStage stage(scene, [](PatchId) { return Color(2.0); });
  const Camera away = CameraAt({ 0, 0, 1 }, { 0, 0.1, 5 }, 40.0);
  for (const bool centres : { true, false })
  {
    const GatheredView view = stage.Gather(away, Pixels(10, 7, centres));
    ASSERT_EQ(view.radiance.pixels.size(), 70u);
    for (std::size_t pixel = 0; pixel < 70; ++pixel)
    {
      EXPECT_EQ(view.radiance.pixels[pixel], Color(0.0));
      EXPECT_EQ(view.depth[pixel], std::numeric_limits<float>::infinity());
      EXPECT_EQ(view.patch[pixel], None);
    }
    EXPECT_EQ(view.report.errorEstimate, 0.0);
    EXPECT_EQ(view.report.gatherRays, 0u);
  }
}

TEST(ViewGather, RefusesSettingsOutOfRange)
{
  Scene scene;
  scene.AddPolygon({ { 0, 0, 0 }, { 1, 0, 0 }, { 0, 1, 0 } }, AddMaterial(scene, Color(0.5)));
  const GatherStage stage(scene, [](PatchId) { return Color(0.0); });
  const Camera camera = CameraAt({ 0, 0, 1 }, { 0.1, 0.1, 0 }, 40.0);
  EXPECT_NO_THROW(stage.Gather(camera, Pixels(1, 1, true, 0.0005)));
  EXPECT_NO_THROW(stage.Gather(camera, Pixels(1, 1, true, 1.0)));
  EXPECT_THROW(stage.Gather(camera, Pixels(0, 1, true)), InputError);
  EXPECT_THROW(stage.Gather(camera, Pixels(1, -1, true)), InputError);
  EXPECT_THROW(stage.Gather(camera, Pixels(32769, 1, true)), InputError);
  EXPECT_THROW(stage.Gather(camera, Pixels(1, 1, true, 0.0004)), InputError);
  EXPECT_THROW(stage.Gather(camera, Pixels(1, 1, true, 1.01)), InputError);
  EXPECT_THROW(stage.Gather(camera, Pixels(1, 1, true, std::nan(""))), InputError);
  Camera wrong = camera;
  wrong.fieldOfView = 180.0;
  EXPECT_THROW(stage.Gather(wrong, Pixels(1, 1, true)), InputError);
}

/// The scene and its camera, turned, scaled and moved.
struct Motion
{
  Frame frame{ glm::normalize(Vec3(0.3, -0.5, 0.6)) };
  double scale = 1.0;
  Vec3 shift{ 0.0 };

  Vec3 operator()(const Vec3& x) const
  {
    return this->shift + this->scale * this->frame.ToWorld(x);
  }
  Scene operator()(Scene scene) const
  {
    for (Vec3& vertex : scene.vertices)
    {
      vertex = (*this)(vertex);
    }
    return scene;
  }
  Camera operator()(Camera camera) const
  {
    camera.eye = (*this)(camera.eye);
    camera.lookAt = (*this)(camera.lookAt);
    camera.up = this->frame.ToWorld(camera.up);
    return camera;
  }
};

TEST(ViewGather, DoesNotDependOnUnitsOrPlace)
{
  const auto reflected = [](PatchId) { return Color(0.2, 0.3, 0.1); };
  // Rays that graze an edge pass on either side of it: within the error that is asked for.
  const GatherStage here(MakeFurnishedRoom(), reflected);
  const GatheredView expected = here.Gather(RoomCamera(), Pixels(64, 48, true));
  for (const double scale : { 1e-3, 1.0, 1e4 })
  {
    Motion move;
    move.scale = scale;
    move.shift = scale * Vec3(30.0, -20.0, 10.0);
    const GatherStage there(move(MakeFurnishedRoom()), reflected);
    const GatheredView view = there.Gather(move(RoomCamera()), Pixels(64, 48, true));
    EXPECT_LT(Compare(view.radiance, expected.radiance).relativeL1, GatherSettings().error)
      << scale;
    for (std::size_t pixel = 0; pixel < view.depth.size(); ++pixel)
    {
      ASSERT_NEAR(view.depth[pixel] / scale, expected.depth[pixel], 1e-4);
    }
  }
}

} // namespace
} // namespace vantage
