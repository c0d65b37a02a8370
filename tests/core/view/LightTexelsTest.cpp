#include "core/view/LightTexels.h"

#include "core/math/Sampling.h"
#include "core/view/DirectLight.h"
#include "core/view/GatherStage.h"
#include "core/view/LitSurfaces.h"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <algorithm>
#include <cmath>

namespace vantage
{
namespace
{

using test::AddMaterial;
using test::GatherStage;

/// Below two lamps of different colours, one of them half hidden: a triangle (upper side patch 0),
/// a quadrilateral without parallel edges (patch 2) and a square (patch 4).
Scene MakeFloors()
{
  Scene scene;
  const std::uint32_t grey = AddMaterial(scene, Color(0.6, 0.5, 0.4));
  const std::uint32_t red = AddMaterial(scene, Color(0.0), Color(9.0, 1.0, 0.5), false);
  const std::uint32_t blue = AddMaterial(scene, Color(0.0), Color(0.5, 2.0, 8.0), false);
  scene.AddPolygon({ { 0, 0, 0 }, { 3, 0, 0 }, { 0, 3, 0 } }, grey);
  scene.AddPolygon({ { -3, 0, 0 }, { -0.1, 0.2, 0 }, { -0.3, 2, 0 }, { -2.5, 3, 0 } }, grey);
  scene.AddPolygon({ { -2, -4, 0 }, { 2, -4, 0 }, { 2, -0.5, 0 }, { -2, -0.5, 0 } }, grey);
  scene.AddPolygon({ { 0, 0, 2 }, { 0, 1, 2 }, { 1, 1, 2 }, { 1, 0, 2 } }, red);
  scene.AddPolygon({ { -2, -1, 2 }, { -2, 0, 2 }, { -1, 0, 2 }, { -1, -1, 2 } }, blue);
  scene.AddPolygon({ { -1.5, -2, 1 }, { 0, -2, 1 }, { 0, 2, 1 }, { -1.5, 2, 1 } }, grey);
  return scene;
}

Color Nothing(PatchId)
{
  return Color(0.0);
}

/// The hit of a ray from above at a place of the unit square on the patch's facet.
Hit HitAt(const GatherStage& stage, PatchId patch, const Vec2& place)
{
  const Vec3 point = PointAt(stage.occluders.Shape(patch / 2), place);
  return { patch / 2, patch % 2 == 0 ? Side::Front : Side::Back, point, 1.0 };
}

/// Rays that come to the floors, most of them near one corner.
std::vector<Hit> DrawHits(const GatherStage& stage, int count, std::uint64_t seed)
{
  RandomStream random(seed);
  std::vector<Hit> hits;
  for (int i = 0; i < count; ++i)
  {
    const Vec2 u = random.Next2();
    hits.push_back(HitAt(stage, 2 * (i % 3), u * u));
  }
  return hits;
}

Color ExactAt(const GatherStage& stage, const Hit& hit)
{
  DirectCounters counters;
  return DirectLight(stage.occluders, stage.solution)
    .OfNamed(hit.Patch(), { hit.point }, counters)[0];
}

LightTexels MakeTexels(const GatherStage& stage, const std::vector<Hit>& sample)
{
  std::vector<Color> irradiance;
  for (const Hit& hit : sample)
  {
    irradiance.push_back(ExactAt(stage, hit));
  }
  return LightTexels(stage.occluders, stage.solution, sample, irradiance);
}

const Color* Lookup(const GatherStage& stage, const LightTexels& texels, const Hit& hit)
{
  return texels.At(stage.solution, hit.Patch(), hit.point).irradiance;
}

/// Quarters the element of a patch; the children name the same lamps. Returns the first of them.
RadianceSolution::NodeIndex Split(GatherStage& stage, PatchId patch)
{
  RadianceSolution& solution = stage.solution;
  const RadianceSolution::NodeIndex root = solution.elementOfPatch[patch];
  const auto first = static_cast<RadianceSolution::NodeIndex>(solution.elements.size());
  const RadianceSolution::Element child = solution.elements[root];
  solution.elements.insert(solution.elements.end(), 4, child);
  solution.elements[root].firstChild = first;
  solution.elements[root].childCount = 4;
  solution.StartAt(patch, stage.occluders.Shape(patch / 2), root);
  return first;
}

TEST(LightTexels, AFewHitsHaveTheirMeanInCommon)
{
  const GatherStage stage(MakeFloors(), Nothing);
  std::vector<Hit> sample;
  Color mean(0.0);
  for (int i = 0; i < 5; ++i)
  {
    sample.push_back(HitAt(stage, 4, { 0.1 + 0.15 * i, 0.9 - 0.1 * i }));
    mean += ExactAt(stage, sample.back()) / 5.0;
  }
  ASSERT_GT(Mean(mean), 0.0);
  const LightTexels texels = MakeTexels(stage, sample);
  for (const Vec2& place : { Vec2(0.01, 0.02), Vec2(0.5, 0.5), Vec2(0.97, 0.3) })
  {
    const Color* found = Lookup(stage, texels, HitAt(stage, 4, place));
    ASSERT_NE(found, nullptr);
    for (int c = 0; c < 3; ++c)
    {
      EXPECT_NEAR((*found)[c], mean[c], 1e-12 * mean[c]); // round-off
    }
  }
}

TEST(LightTexels, OverItsSampleTheMeanIsExact)
{
  GatherStage stage(MakeFloors(), Nothing);
  for (const PatchId patch : { 0u, 2u })
  {
    Split(stage, patch);
  }
  for (std::uint64_t seed = 1; seed <= 5; ++seed)
  {
    const std::vector<Hit> sample = DrawHits(stage, 3000, seed);
    const LightTexels texels = MakeTexels(stage, sample);
    Color exact(0.0);
    Color found(0.0);
    for (const Hit& hit : sample)
    {
      exact += ExactAt(stage, hit);
      const Color* texel = Lookup(stage, texels, hit);
      ASSERT_NE(texel, nullptr);
      found += *texel;
    }
    for (int c = 0; c < 3; ++c)
    {
      EXPECT_NEAR(found[c], exact[c], 1e-11 * exact[c]) << "seed " << seed; // round-off of 3000
    }
  }
}

/// Root mean square error of other hits of the same distribution, relative to their mean.
double ErrorOf(const GatherStage& stage, int count)
{
  const LightTexels texels = MakeTexels(stage, DrawHits(stage, count, 3));
  double error = 0.0;
  double sum = 0.0;
  const std::vector<Hit> others = DrawHits(stage, 3000, 4);
  for (const Hit& hit : others)
  {
    const Color* texel = Lookup(stage, texels, hit);
    const Color exact = ExactAt(stage, hit);
    const double difference = texel ? Mean(*texel - exact) : Mean(exact);
    error += difference * difference;
    sum += Mean(exact);
  }
  return std::sqrt(error * static_cast<double>(others.size())) / sum;
}

TEST(LightTexels, ErrorsFallWithTheirSize)
{
  const GatherStage stage(MakeFloors(), Nothing);
  const double coarse = ErrorOf(stage, 600);
  const double fine = ErrorOf(stage, 16 * 600);
  // Sixteen times the hits quarter the size of texels, and with it what light varies within them;
  // near the edges of shadows that is more than in proportion at the coarse end.
  EXPECT_LT(fine, coarse / 3.0);
  EXPECT_GT(fine, coarse / 10.0);
}

TEST(LightTexels, KnowTheElementOfAPoint)
{
  GatherStage stage(MakeFloors(), Nothing);
  Split(stage, 0);
  Split(stage, 4);
  const LightTexels texels = MakeTexels(stage, DrawHits(stage, 1000, 5));
  for (const Hit& hit : DrawHits(stage, 1000, 6))
  {
    EXPECT_EQ(texels.At(stage.solution, hit.Patch(), hit.point).leaf,
      stage.solution.LeafAt(hit.Patch(), hit.point));
  }
}

TEST(LightTexels, AnElementThatWasMissedHasNone)
{
  GatherStage stage(MakeFloors(), Nothing);
  const RadianceSolution::NodeIndex first = Split(stage, 4);
  std::vector<Hit> sample;
  for (int i = 0; i < 20; ++i)
  {
    sample.push_back(HitAt(stage, 4, { 0.02 * i, 0.45 - 0.02 * i })); // all in the first quarter
  }
  const LightTexels texels = MakeTexels(stage, sample);
  EXPECT_NE(Lookup(stage, texels, HitAt(stage, 4, { 0.25, 0.25 })), nullptr);
  const Hit missed = HitAt(stage, 4, { 0.75, 0.75 });
  EXPECT_EQ(Lookup(stage, texels, missed), nullptr);
  EXPECT_EQ(texels.At(stage.solution, 4, missed.point).leaf, first + 2);
}

TEST(LightTexels, APatchWithFewHitsHasNone)
{
  const GatherStage stage(MakeFloors(), Nothing);
  const std::vector<Hit> sample = DrawHits(stage, 9, 7); // three on each
  const LightTexels texels = MakeTexels(stage, sample);
  for (const Hit& hit : sample)
  {
    EXPECT_EQ(Lookup(stage, texels, hit), nullptr);
  }
  EXPECT_EQ(Lookup(stage, LightTexels(), sample[0]), nullptr);
}

TEST(LightTexels, AllHitsInOnePlaceAreNoTrouble)
{
  const GatherStage stage(MakeFloors(), Nothing);
  const Hit hit = HitAt(stage, 4, { 0.3, 0.7 });
  const LightTexels texels = MakeTexels(stage, std::vector<Hit>(1000, hit));
  const Color exact = ExactAt(stage, hit);
  const Color* found = Lookup(stage, texels, hit);
  ASSERT_NE(found, nullptr);
  EXPECT_NEAR(Mean(*found), Mean(exact), 1e-12 * Mean(exact)); // round-off
}

TEST(LightTexels, AreTheSameForAnyNumberOfThreads)
{
  const GatherStage stage(MakeFloors(), Nothing);
  const std::vector<Hit> sample = DrawHits(stage, 3000, 8);
  const auto make = [&](std::size_t threads)
  {
    tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
    const LightTexels texels = MakeTexels(stage, sample);
    std::vector<Color> found;
    for (const Hit& hit : sample)
    {
      found.push_back(*Lookup(stage, texels, hit));
    }
    return found;
  };
  const std::vector<Color> alone = make(1);
  EXPECT_EQ(alone, make(2));
  EXPECT_EQ(alone, make(4));
}

TEST(LightTexels, StandForShadowRaysOfLitSurfaces)
{
  const GatherStage stage(MakeFloors(), Nothing);
  const std::vector<Hit> sample = DrawHits(stage, 300, 9);
  LitSurfaces lit(stage.occluders, stage.solution);
  std::uint64_t shadowRays = 0;
  Color estimated(0.0);
  for (std::uint32_t k = 0; k < sample.size(); ++k)
  {
    estimated += lit.Radiance(sample[k], LitBy::Texels, k, 17, shadowRays).direct;
  }
  ASSERT_GT(shadowRays, 0u);
  EXPECT_EQ(lit.LightSample(sample, {}, 17), shadowRays);
  Color found(0.0);
  shadowRays = 0;
  for (const Hit& hit : sample)
  {
    found += lit.Radiance(hit, LitBy::Texels, 0, 1, shadowRays).direct;
  }
  EXPECT_EQ(shadowRays, 0u);
  for (int c = 0; c < 3; ++c)
  {
    EXPECT_NEAR(found[c], estimated[c], 1e-12 * estimated[c]); // round-off of 300
  }
}

} // namespace
} // namespace vantage
