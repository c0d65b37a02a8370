#include "core/view/ScreenTile.h"
#include "core/math/Sampling.h"
#include "core/scene/Labyrinth.h"
#include "core/view/GatherStage.h"
#include "core/view/ViewSamples.h"

#include <gtest/gtest.h>

#include <utility>

namespace vantage
{
namespace
{

constexpr int Size = 96;

/// Polygons that hang anyhow before and behind the eye, also through each other.
Scene MakeClutter(std::uint64_t seed)
{
  Scene scene;
  const std::uint32_t white = test::AddMaterial(scene, Color(0.5));
  RandomStream random(seed);
  for (int i = 0; i < 60; ++i)
  {
    const Vec3 centre = 4.0 * Vec3(random.Next(), random.Next(), random.Next()) - 2.0;
    const Vec3 u = Vec3(random.Next(), random.Next(), random.Next()) - 0.5;
    const Vec3 v = Vec3(random.Next(), random.Next(), random.Next()) - 0.5;
    scene.AddPolygon({ centre, centre + u, centre + u + v, centre + v }, white);
  }
  return scene;
}

/// Returns how many pixels see something, and how many rays were traced.
std::pair<int, std::uint64_t> CompareWithRays(const Scene& scene, const Camera& camera)
{
  const test::GatherStage stage(scene, [](PatchId) { return Color(0.0); });
  const ImagePlane plane(camera);
  const ViewSamples samples = SampleImage(stage.occluders, plane, Size, Size, true);
  int seen = 0;
  for (int y = 0; y < Size; ++y)
  {
    for (int x = 0; x < Size; ++x)
    {
      const EyeHit& hit = samples.centres[y * Size + x];
      const auto expected = stage.Centre(camera, Size, Size, x, y);
      EXPECT_EQ(hit.patch, expected ? expected->Patch() : None) << x << ' ' << y;
      if (expected)
      {
        EXPECT_NEAR(hit.depth / expected->distance, 1.0, 1e-9);
        ++seen;
      }
    }
  }
  EXPECT_EQ(samples.points.size(), static_cast<std::size_t>(seen));
  return { seen, samples.rays };
}

TEST(ScreenTile, SeesWhatRaysSee)
{
  for (const std::uint64_t seed : { 1, 2, 3 })
  {
    SCOPED_TRACE(seed);
    for (const Camera& camera : { test::CameraAt({ 0.1, -0.2, 0.3 }, { 1.0, 0.5, 0.2 }, 70.0),
           test::CameraAt({ -6.0, 1.0, 2.0 }, { 0.0, 0.0, 0.0 }, 40.0) })
    {
      EXPECT_GT(CompareWithRays(MakeClutter(seed), camera).first, Size * Size / 20);
    }
  }
}

/// In a closed place nearly all is decided without rays.
TEST(ScreenTile, SeesWhatRaysSeeInALabyrinth)
{
  const Scene scene = MakeLabyrinth();
  for (const char* name : { "view1", "view2" })
  {
    SCOPED_TRACE(name);
    Camera camera = scene.FindCamera(name);
    camera.aspect = 1.0;
    const auto [seen, rays] = CompareWithRays(scene, camera);
    EXPECT_EQ(seen, Size * Size);
    EXPECT_LT(rays, static_cast<std::uint64_t>(Size * Size / 20));
  }
  EXPECT_GT(CompareWithRays(scene, scene.FindCamera("overview")).first, Size * Size / 10);
}

TEST(ScreenTile, APixelOfOnePatchHasNoOtherInIt)
{
  const test::GatherStage stage(MakeClutter(4), [](PatchId) { return Color(0.0); });
  const Camera camera = test::CameraAt({ -6.0, 1.0, 2.0 }, { 0.0, 0.0, 0.0 }, 40.0);
  const ImagePlane plane(camera);
  RandomStream random(3);
  std::uint64_t rays = 0;
  int whole = 0;
  for (const ScreenTile& tile :
    ScreenTile::Cut(stage.occluders, plane, { 2.0 / Size, 2.0 / Size }, { 0, 0, Size, Size }))
  {
    const ScreenTile::Rectangle& r = tile.Pixels();
    for (int y = r.y; y < r.y + r.height; ++y)
    {
      for (int x = r.x; x < r.x + r.width; ++x)
      {
        const PatchId patch = tile.Look(tile.Place(x + 0.5, y + 0.5), rays).patch;
        if (patch == None || !tile.SeesOnly(x, y, patch))
        {
          continue;
        }
        ++whole;
        for (int k = 0; k < 8; ++k)
        {
          const Vec2 place = tile.Place(x + random.Next(), y + random.Next());
          const auto hit = stage.occluders.Intersect(plane.eye, plane.Direction(place.x, place.y));
          ASSERT_TRUE(hit);
          ASSERT_EQ(hit->Patch(), patch) << x << ' ' << y;
        }
      }
    }
  }
  EXPECT_GT(whole, Size * Size / 8);
}

} // namespace
} // namespace vantage
