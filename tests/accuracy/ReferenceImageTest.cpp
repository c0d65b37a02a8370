#include "support/ReferenceImage.h"

#include "accuracy/References.h"
#include "core/formfactor/Shadows.h"
#include "core/math/ScrambledSobol.h"
#include "core/reference/ExactDirectLight.h"
#include "core/scene/Labyrinth.h"
#include "core/visibility/OccluderScene.h"
#include "support/StudyScenes.h"
#include "support/TestScenes.h"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>

namespace vantage
{
namespace
{

/// Irradiance over pi by the definition: many points on every emitter, a ray to each.
Color SampledDirectLight(const Scene& scene, const FacetSet& facets, const OccluderScene& occluders,
  const Hit& hit, const Vec3& normal)
{
  constexpr int Samples = 1 << 14;
  Color sum(0.0);
  for (std::uint32_t f = 0; f < facets.facets.size(); ++f)
  {
    const Facet& facet = facets.facets[f];
    const Color emission = scene.materials[facet.material].emission;
    if (emission == Color(0.0))
    {
      continue;
    }
    for (std::uint32_t i = 0; i < Samples; ++i)
    {
      const Vec2 uv = ScrambledSobol(i, Hash(f));
      const Vec3 y = PointAt(facet.shape, uv);
      const Vec3 path = y - hit.point;
      const double cosines = std::max(0.0, glm::dot(normal, path)) *
                             std::max(0.0, glm::dot(UnitNormal(facet.shape), -path));
      if (cosines > 0.0 && !occluders.IsOccluded({ hit.point, hit.facet }, { y, f }))
      {
        const double squared = glm::dot(path, path);
        sum += emission *
               (cosines / (squared * squared) * AreaElementAt(facet.shape, uv) / (Pi * Samples));
      }
    }
  }
  return sum;
}

TEST(ReferenceImage, DirectLightIsWhatManyShadowRaysFind)
{
  constexpr int Size = 6;
  for (const char* name :
    { "labyrinth-1-view1", "cornell-box", "courtyard", "unequal-lamps", "room-1", "room-2" })
  {
    SCOPED_TRACE(name);
    const test::StudyScene study = test::MakeStudyScene(name);
    const FacetSet facets = BuildFacets(study.scene);
    const OccluderScene occluders(facets);
    const ExactDirectLight exact(study.scene, facets, occluders);
    const ImagePlane plane(study.View());
    double difference = 0.0;
    double total = 0.0;
    for (int p = 0; p < Size * Size; ++p)
    {
      const int row = p / Size;
      const Vec2 at = (2.0 * Vec2(p % Size, row) + 1.0) / static_cast<double>(Size) - 1.0;
      const auto hit = occluders.Intersect(plane.eye, plane.Direction(at.x, at.y));
      if (!hit)
      {
        continue;
      }
      const Vec3 front = UnitNormal(facets.facets[hit->facet].shape);
      const Vec3 normal = hit->side == Side::Front ? front : -front;
      const Color sampled = SampledDirectLight(study.scene, facets, occluders, *hit, normal);
      difference += Mean(glm::abs(exact.At(*hit, normal) - sampled));
      total += Mean(sampled);
    }
    EXPECT_LT(difference, 3e-4 * total);
  }
}

/// What a point sees of a lamp past each and every other facet of the scene, sr. Lengths are those
/// of rooms, about 1.
double SeenPastAllFacets(
  const FacetSet& facets, std::uint32_t lamp, const Hit& hit, const Vec3& normal, double tolerance)
{
  const auto moved = [&](Polygon shape)
  {
    for (int i = 0; i < shape.Size(); ++i)
    {
      shape[i] -= hit.point;
    }
    return shape;
  };
  const Plane ground{ normal, 0.0 };
  const Polygon whole = moved(facets.facets[lamp].shape);
  const Plane lampPlane = SupportingPlane(whole);
  const Polygon target = ClipToFront(whole, ground, tolerance);
  if (target.Empty() || lampPlane.Distance(Vec3(0.0)) <= tolerance)
  {
    return 0.0;
  }
  std::vector<Polygon> shadows;
  for (std::uint32_t f = 0; f < facets.facets.size(); ++f)
  {
    const Polygon above = ClipToFront(moved(facets.facets[f].shape), ground, tolerance);
    const Polygon between = ClipToFront(above, lampPlane, tolerance);
    if (f == hit.facet || f == lamp || between.Empty())
    {
      continue;
    }
    shadows.push_back(between);
    if (PointToVisiblePolygon(Vec3(0.0), normal, target, { shadows.back() }) == 0.0)
    {
      return 0.0;
    }
  }
  return PointToVisiblePolygon(Vec3(0.0), normal, target, shadows);
}

/// Lamps behind walls are told by one ray; that must not change what is seen of any lamp.
TEST(ReferenceImage, DirectLightOfRoomsIsWhatIsSeenPastAllTheirFacets)
{
  const Scene scene = MakeLabyrinth({ 2, 3, 1 });
  const FacetSet facets = BuildFacets(scene);
  const OccluderScene occluders(facets);
  const ExactDirectLight direct(scene, facets, occluders);
  RandomStream random(1);
  int hidden = 0;
  int partly = 0;
  for (int i = 0; i < 400; ++i)
  {
    const auto facet =
      std::min<std::uint32_t>(random.Next() * facets.facets.size(), facets.facets.size() - 1);
    const Vec3 normal = UnitNormal(facets.facets[facet].shape);
    const Hit hit{ facet, Side::Front, PointAt(facets.facets[facet].shape, random.Next2()), 0.0 };
    Color plain(0.0);
    for (std::uint32_t f = 0; f < facets.facets.size(); ++f)
    {
      const Color emission = scene.materials[facets.facets[f].material].emission;
      if (MaxChannel(emission) > 0.0 && f != facet)
      {
        const double seen = SeenPastAllFacets(facets, f, hit, normal, occluders.Tolerance());
        plain += seen / Pi * emission;
        hidden += seen == 0.0 ? 1 : 0;
        partly += seen > 0.0 ? 1 : 0;
      }
    }
    constexpr double RoundOff = 1e-12; // of pieces with small angles, times the emission of 60
    EXPECT_NEAR(direct.At(hit, normal).x, plain.x, 60.0 * RoundOff) << i;
  }
  EXPECT_GT(hidden, 1000);
  EXPECT_GT(partly, 100);
}

/// Radiance is the same everywhere, so nothing is left to err but arithmetic.
TEST(ReferenceImage, IsExactInAFurnace)
{
  const Scene scene = test::MakeFurnace(Color(0.2, 0.5, 0.8));
  test::ReferenceSettings settings;
  settings.size = 8;
  settings.gatherRays = 64;
  settings.mapCells = 200;
  settings.mapRays = 16;
  const test::ReferenceImage reference =
    test::MakeReference(scene, scene.cameras.front(), settings);
  for (const Color& pixel : reference.image.pixels)
  {
    EXPECT_NEAR(pixel.x, 1.0 / 0.8, 1e-4);
    EXPECT_NEAR(pixel.y, 1.0 / 0.5, 1e-4);
    EXPECT_NEAR(pixel.z, 1.0 / 0.2, 5e-4);
  }
  EXPECT_LT(reference.noise, 1e-4);
}

TEST(ReferenceImage, AgreesWithPathTracing)
{
  const Scene scene = test::MakeLitBox();
  const Camera camera = test::SquareCamera(scene, "inside");
  test::ReferenceSettings settings;
  settings.size = 32;
  settings.gatherRays = 1024;
  settings.mapCells = 4000;
  const test::ReferenceImage reference = test::MakeReference(scene, camera, settings);
  const test::TracedImage traced = test::PathTraced(scene, camera, settings.size, 1024, true);
  const ImageDifference difference =
    Compare(BlockMeans(reference.image, 8), BlockMeans(traced.image, 8));
  test::Record("noise of the reference", reference.noise);
  test::Record("noise of the path tracer", traced.noiseOfMean);
  test::Record("bias", difference.relativeBias);
  test::Record("L1 of blocks", difference.relativeL1);
  ASSERT_LT(traced.noiseOfMean, 0.002);
  EXPECT_LT(std::abs(difference.relativeBias), 0.004);
  EXPECT_LT(difference.relativeL1, 0.01);
}

/// Few rays into few cells are noisy, four times as many of both are less so, until it is enough.
TEST(ReferenceImage, TakesMoreUntilItIsAsQuietAsAsked)
{
  const Scene scene = test::MakeLitBox();
  const Camera camera = test::SquareCamera(scene, "inside");
  test::ReferenceSettings settings;
  settings.size = 16;
  settings.gatherRays = 64;
  settings.mapCells = 250;
  settings.noise = 1.0;
  const double first = test::MakeReference(scene, camera, settings).noise;
  settings.noise = 0.7 * first;
  const double second = test::MakeReference(scene, camera, settings).noise;
  test::Record("noise at first", first);
  test::Record("noise when less was asked", second);
  EXPECT_LE(second, settings.noise);
  settings.noise = 0.0;
  EXPECT_LT(test::MakeReference(scene, camera, settings).noise, 0.7 * second);
}

TEST(ReferenceImage, ComesBackFromTheCache)
{
  const std::filesystem::path folder =
    std::filesystem::path(testing::TempDir()) / "vantage-reference-cache";
  std::filesystem::remove_all(folder);
  const Scene scene = test::MakeLitBox();
  test::ReferenceSettings settings;
  settings.size = 8;
  settings.gatherRays = 64;
  settings.mapCells = 200;
  settings.mapRays = 16;
  const auto reference = [&]()
  { return test::CachedReference(folder.string(), "box", scene, scene.cameras.front(), settings); };
  const test::ReferenceImage made = reference();
  const test::ReferenceImage read = reference();
  // Files hold single precision.
  EXPECT_LT(Compare(read.image, made.image).relativeL1, 1e-7);
  EXPECT_NEAR(read.noise, made.noise, 1e-6);
  std::filesystem::remove_all(folder);
}

TEST(ReferenceImage, KeyKnowsEveryNumber)
{
  const Scene scene = test::MakeLitBox();
  const Camera camera = scene.cameras.front();
  const test::ReferenceSettings settings;
  const std::uint64_t key = test::ReferenceKey(scene, camera, settings);
  EXPECT_EQ(test::ReferenceKey(scene, camera, settings), key);
  Scene moved = scene;
  moved.vertices.back().z += 1e-12;
  EXPECT_NE(test::ReferenceKey(moved, camera, settings), key);
  Scene lit = scene;
  lit.materials[3].emission.y *= 2.0;
  EXPECT_NE(test::ReferenceKey(lit, camera, settings), key);
  Camera turned = camera;
  turned.lookAt.x += 1e-9;
  EXPECT_NE(test::ReferenceKey(scene, turned, settings), key);
  test::ReferenceSettings finer = settings;
  finer.mapCells *= 2;
  EXPECT_NE(test::ReferenceKey(scene, camera, finer), key);
  test::ReferenceSettings larger = settings;
  ++larger.size;
  EXPECT_NE(test::ReferenceKey(scene, camera, larger), key);
}

} // namespace
} // namespace vantage
