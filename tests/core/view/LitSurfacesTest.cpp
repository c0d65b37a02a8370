#include "core/view/LitSurfaces.h"

#include "core/formfactor/FormFactor.h"
#include "core/view/LampsOverFloor.h"
#include "support/TestScenes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace vantage
{
namespace
{

using namespace test;

/// What the origin reflects of the lamps when nothing hides them.
Color Unhidden(const GatherStage& stage)
{
  double factor = 0.0;
  for (const PatchId lamp : stage.solution.lamps)
  {
    factor += PointToPolygon(Vec3(0.0), Vec3(0, 0, 1), ShapeOf(stage.occluders, lamp));
  }
  return Albedo / Pi * factor * Emission;
}

TEST(LitSurfaces, AddsTheClosedFormOfALampToTheRest)
{
  const GatherStage stage(MakeFloorBelowLamps(3), AllButEmission);
  const LitSurfaces lit(stage.occluders, stage.solution);
  const Color expected = Reflected + Unhidden(stage);
  for (std::uint64_t seed = 1; seed <= 10; ++seed)
  {
    std::uint64_t shadowRays = 0;
    const LitRadiance parts = lit.Radiance(FloorHit(stage), LitBy::ShadowRays, 0, seed, shadowRays);
    EXPECT_EQ(parts.indirect, Reflected);
    const Color found = parts.direct + parts.indirect;
    for (int c = 0; c < 3; ++c)
    {
      EXPECT_NEAR(found[c], expected[c], 1e-12) << "seed " << seed; // round-off
    }
    EXPECT_EQ(shadowRays, 3u);
  }
}

TEST(LitSurfaces, ALampThatIsNotNamedGivesNothingHere)
{
  GatherStage stage(MakeFloorBelowLamps(1), AllButEmission);
  RadianceSolution::Element& floor = ElementOf(stage, FloorHit(stage));
  floor.lastLamp = floor.firstLamp;
  std::uint64_t shadowRays = 0;
  const LitRadiance found = LitSurfaces(stage.occluders, stage.solution)
                              .Radiance(FloorHit(stage), LitBy::ShadowRays, 0, 1, shadowRays);
  EXPECT_EQ(found.direct, Color(0.0));
  EXPECT_EQ(found.indirect, Reflected);
  EXPECT_EQ(shadowRays, 0u);
}

TEST(LitSurfaces, AnInactiveSideIsBlack)
{
  const GatherStage stage(MakeFloorBelowLamps(1), AllButEmission);
  const Hit below = Met(stage, Vec3(0.0, 0.0, -0.1), Vec3(0.0, 0.0, 1.0));
  std::uint64_t shadowRays = 0;
  const LitRadiance found = LitSurfaces(stage.occluders, stage.solution)
                              .Radiance(below, LitBy::ShadowRays, 0, 1, shadowRays);
  EXPECT_EQ(found.direct + found.indirect, Color(0.0));
  EXPECT_EQ(shadowRays, 0u);
}

/// The mean over the samples of one seed, red channel, and the standard error of it, were they
/// independent.
struct MeanRadiance
{
  double mean = 0.0;
  double error = 0.0;
  std::uint64_t shadowRays = 0;

  MeanRadiance(
    const GatherStage& stage, const LitSurfaces& lit, std::uint32_t samples, std::uint64_t seed)
  {
    const Hit hit = FloorHit(stage);
    double squares = 0.0;
    for (std::uint32_t i = 0; i < samples; ++i)
    {
      const LitRadiance radiance = lit.Radiance(hit, LitBy::ShadowRays, i, seed, this->shadowRays);
      const double value = radiance.direct.x + radiance.indirect.x;
      this->mean += value / samples;
      squares += value * value / samples;
    }
    this->error = std::sqrt(std::max(0.0, squares - this->mean * this->mean) / samples);
  }
};

/// Something hides all of the lamp on one side of the vertical plane through the point and its
/// middle, which parts what it gives in halves.
void ExpectHalfToBeSeen(Scene scene)
{
  AddSquare(scene, Vec3(1.0, 0.0, 0.5), 2.0, 0);
  const GatherStage stage(scene, AllButEmission);
  const LitSurfaces lit(stage.occluders, stage.solution);
  const double all = Unhidden(stage).x;
  for (std::uint64_t seed = 1; seed <= 5; ++seed)
  {
    const MeanRadiance found(stage, lit, 1024, seed);
    ASSERT_GT(found.error, 0.0);
    EXPECT_NEAR(found.mean - Reflected.x, 0.5 * all, 4.0 * found.error) << "seed " << seed;
  }
}

TEST(LitSurfaces, OfAHalfHiddenLampHalfIsSeen)
{
  ExpectHalfToBeSeen(MakeFloorBelowLamps(1));
}

TEST(LitSurfaces, OfAHalfHiddenGlobeHalfIsSeen)
{
  Scene scene = MakeFloorBelowLamps(0);
  AddBall(scene, Vec3(0.0, 0.0, 1.0), 0.25, 12, 1);
  ExpectHalfToBeSeen(scene);
}

/// A globe is one lamp: it takes one ray, and its closed form.
TEST(LitSurfaces, AGlobeIsOneLamp)
{
  Scene scene = MakeFloorBelowLamps(0);
  AddBall(scene, Vec3(0.3, 0.2, 1.0), 0.25, 12, 1);
  const GatherStage stage(scene, AllButEmission);
  ASSERT_EQ(stage.solution.lamps.size(), 528u);
  const LitSurfaces lit(stage.occluders, stage.solution);
  std::uint64_t shadowRays = 0;
  const LitRadiance found = lit.Radiance(FloorHit(stage), LitBy::ShadowRays, 0, 1, shadowRays);
  EXPECT_EQ(shadowRays, 1u);
  EXPECT_NEAR(found.direct.x, Unhidden(stage).x, 1e-12); // round-off
}

/// Globes far and near in a circle, of which a few are drawn; three are half below the floor.
TEST(LitSurfaces, SomeOfManyGlobesStandForAll)
{
  Scene scene = MakeFloorBelowLamps(0);
  for (int i = 0; i < 12; ++i)
  {
    const double angle = Pi * i / 6.0;
    const double distance = 0.6 + 0.2 * (i % 5);
    AddBall(scene, Vec3(distance * std::cos(angle), distance * std::sin(angle), 0.25 * (i % 4)),
      0.12, 5, 1);
  }
  const GatherStage stage(scene, AllButEmission);
  const LitSurfaces lit(stage.occluders, stage.solution);
  const MeanRadiance found(stage, lit, 4096, 1);
  EXPECT_EQ(found.shadowRays / 4096, 8u);
  EXPECT_NEAR(found.mean - Reflected.x, Unhidden(stage).x, 4.0 * found.error);
}

/// A large lamp close by, most of which is hidden: what is left counts by what it gives, not by its
/// area.
TEST(LitSurfaces, OfALampCloseByTheNearPartCounts)
{
  Scene scene;
  const std::uint32_t grey = AddMaterial(scene, Albedo, Color(0.0), false);
  const std::uint32_t lamp = AddMaterial(scene, Color(0.5), Emission, false);
  AddSquare(scene, Vec3(0.0), -8.0, grey);
  AddSquare(scene, Vec3(0.0, 0.0, 0.2), 2.0, lamp);
  // Hides all that lies beyond x = 0.1 on the lamp.
  AddSquare(scene, Vec3(1.05, 0.0, 0.1), 2.0, grey);
  const GatherStage stage(scene, AllButEmission);
  const Polygon visible{ Vec3(-1, -1, .2), Vec3(-1, 1, .2), Vec3(.1, 1, .2), Vec3(.1, -1, .2) };
  const double exact =
    Albedo.x / Pi * Emission.x * PointToPolygon(Vec3(0.0), Vec3(0, 0, 1), visible);
  const LitSurfaces lit(stage.occluders, stage.solution);
  for (std::uint64_t seed = 1; seed <= 3; ++seed)
  {
    const MeanRadiance found(stage, lit, 4096, seed);
    EXPECT_NEAR(found.mean - Reflected.x, exact, 4.0 * found.error) << seed;
  }
}

/// Whatever part of it is above the horizon, and be it one in a thousand.
TEST(LitSurfaces, OfALampAcrossTheHorizonAllThatIsAboveIsSeen)
{
  for (const double height : { 0.5, 0.1, 0.001 })
  {
    Scene scene = MakeFloorBelowLamps(0);
    const std::uint32_t lamp = AddMaterial(scene, Color(0.5), Emission, false);
    scene.AddPolygon({ Vec3(1.0, -0.5, height - 1.0), Vec3(1.0, -0.5, height),
                       Vec3(1.0, 0.5, height), Vec3(1.0, 0.5, height - 1.0) },
      lamp);
    const GatherStage stage(scene, AllButEmission);
    ASSERT_EQ(stage.solution.lamps.size(), 1u);
    const MeanRadiance found(stage, LitSurfaces(stage.occluders, stage.solution), 64, 1);
    const double all = Unhidden(stage).x;
    ASSERT_GT(all, 0.0);
    EXPECT_NEAR(found.mean - Reflected.x, all, 1e-12) << height; // round-off
  }
}

TEST(LitSurfaces, AHiddenLampGivesNothing)
{
  Scene scene = MakeFloorBelowLamps(1);
  AddSquare(scene, Vec3(0.0, 0.0, 0.5), 2.0, 0);
  const GatherStage stage(scene, AllButEmission);
  const MeanRadiance found(stage, LitSurfaces(stage.occluders, stage.solution), 64, 1);
  EXPECT_NEAR(found.mean, Reflected.x, 1e-12); // round-off of the mean
  EXPECT_EQ(found.shadowRays, 64u);
}

TEST(LitSurfaces, SomeOfManyLampsStandForAll)
{
  const GatherStage stage(MakeFloorBelowLamps(30), AllButEmission);
  ASSERT_GT(stage.solution.lamps.size(), LitSurfaces::MostLamps);
  const LitSurfaces lit(stage.occluders, stage.solution);
  const double all = Unhidden(stage).x;
  for (std::uint64_t seed = 1; seed <= 5; ++seed)
  {
    const MeanRadiance found(stage, lit, 4096, seed);
    EXPECT_NEAR(found.mean - Reflected.x, all, 4.0 * found.error) << "seed " << seed;
    EXPECT_LE(found.shadowRays, 4096u * LitSurfaces::MostLamps);
    // Lamps are drawn as they are likely to give: the near ones, which give most, always.
    EXPECT_LT(found.error * std::sqrt(4096.0), 0.3 * all) << "seed " << seed;
  }
}

/// Below a ceiling of lamps the few that are drawn stand for all without noise.
TEST(LitSurfaces, LampsCloseByAreDrawnByWhatTheyGive)
{
  Scene scene;
  AddSquare(scene, Vec3(0.0), -8.0, AddMaterial(scene, Albedo, Color(0.0), false));
  const std::uint32_t lamp = AddMaterial(scene, Color(0.5), Emission, false);
  for (int i = 0; i < 36; ++i)
  {
    AddSquare(scene, Vec3(i % 6 - 2.5, i / 6 - 2.5, 1.0), 1.0, lamp);
  }
  const GatherStage stage(scene, AllButEmission);
  const LitSurfaces lit(stage.occluders, stage.solution);
  const double all = Unhidden(stage).x;
  std::uint64_t shadowRays = 0;
  for (std::uint32_t index = 0; index < 100; ++index)
  {
    // The lamps in the corners are farther than four radii: they are taken for points.
    const double found =
      lit.Radiance(FloorHit(stage), LitBy::ShadowRays, index, 1, shadowRays).direct.x;
    EXPECT_NEAR(found, all, 0.02 * all) << index;
  }
  EXPECT_LE(shadowRays, 100u * LitSurfaces::MostLamps);
}

} // namespace
} // namespace vantage
