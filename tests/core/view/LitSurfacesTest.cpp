#include "core/view/LitSurfaces.h"

#include "core/formfactor/FormFactor.h"
#include "core/math/ScrambledSobol.h"
#include "core/view/GatherStage.h"
#include "core/view/SecondLook.h"

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

const Color Albedo(0.6, 0.5, 0.4);
const Color Emission(9.0, 8.0, 7.0);
const Color Reflected(0.3, 0.2, 0.1);

/// A horizontal square about a centre, facing down unless its edge is negative.
void AddSquare(Scene& scene, const Vec3& centre, double edge, std::uint32_t material)
{
  const double x = 0.5 * std::abs(edge);
  const double y = -0.5 * edge;
  scene.AddPolygon({ centre + Vec3(-x, -y, 0.0), centre + Vec3(x, -y, 0.0),
                     centre + Vec3(x, y, 0.0), centre + Vec3(-x, y, 0.0) },
    material);
}

/// A floor (facet 0, its upper side patch 0) below lamps in a row, the first above the origin.
Scene MakeFloorBelowLamps(int lamps)
{
  Scene scene;
  const std::uint32_t grey = AddMaterial(scene, Albedo, Color(0.0), false);
  const std::uint32_t lamp = AddMaterial(scene, Color(0.5), Emission, false);
  AddSquare(scene, Vec3(0.0), -8.0, grey);
  for (int i = 0; i < lamps; ++i)
  {
    AddSquare(scene, Vec3(0.4 * i, 0.0, 1.0), 0.3, lamp);
  }
  return scene;
}

Color AllButEmission(PatchId)
{
  return Reflected;
}

/// What a ray meets.
Hit Met(const GatherStage& stage, const Vec3& from, const Vec3& direction)
{
  return stage.occluders.Intersect(from, direction).value();
}

/// The point of the floor at the origin, seen from above.
Hit FloorHit(const GatherStage& stage)
{
  return Met(stage, Vec3(0.0, 0.0, 0.1), Vec3(0.0, 0.0, -1.0));
}

RadianceSolution::Element& ElementOf(GatherStage& stage, const Hit& hit)
{
  return stage.solution.elements[stage.solution.elementOfPatch[hit.Patch()]];
}

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
    const LitRadiance parts = lit.Radiance(FloorHit(stage), 0, seed, shadowRays);
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
  const LitRadiance found =
    LitSurfaces(stage.occluders, stage.solution).Radiance(FloorHit(stage), 0, 1, shadowRays);
  EXPECT_EQ(found.direct, Color(0.0));
  EXPECT_EQ(found.indirect, Reflected);
  EXPECT_EQ(shadowRays, 0u);
}

TEST(LitSurfaces, AnInactiveSideIsBlack)
{
  const GatherStage stage(MakeFloorBelowLamps(1), AllButEmission);
  const Hit below = Met(stage, Vec3(0.0, 0.0, -0.1), Vec3(0.0, 0.0, 1.0));
  std::uint64_t shadowRays = 0;
  const LitRadiance found =
    LitSurfaces(stage.occluders, stage.solution).Radiance(below, 0, 1, shadowRays);
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
      const LitRadiance radiance = lit.Radiance(hit, i, seed, this->shadowRays);
      const double value = radiance.direct.x + radiance.indirect.x;
      this->mean += value / samples;
      squares += value * value / samples;
    }
    this->error = std::sqrt(std::max(0.0, squares - this->mean * this->mean) / samples);
  }
};

TEST(LitSurfaces, OfAHalfHiddenLampHalfIsSeen)
{
  Scene scene = MakeFloorBelowLamps(1);
  // Hides all of the lamp on one side of the vertical plane through its middle.
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
    const double found = lit.Radiance(FloorHit(stage), index, 1, shadowRays).direct.x;
    EXPECT_NEAR(found, all, 0.02 * all) << index;
  }
  EXPECT_LE(shadowRays, 100u * LitSurfaces::MostLamps);
}

/// A closed room of one albedo in which everything reflects the same radiance, without lamps.
GatherStage MakeEvenRoom()
{
  Scene scene;
  test::AddRoom(scene, Vec3(0.0), Vec3(1.0), AddMaterial(scene, Albedo));
  return GatherStage(scene, AllButEmission);
}

/// Looks from all hits at once, and has it applied.
SecondLook LookAgain(const GatherStage& stage, const std::vector<Hit>& hits,
  std::uint32_t raysOfHit, std::uint64_t seed, LitSurfaces& lit)
{
  SecondLook look(stage.occluders, stage.solution, raysOfHit, seed);
  look.From(hits, lit);
  look.Apply(lit);
  return look;
}

Color RadianceAt(const LitSurfaces& lit, const Hit& hit)
{
  std::uint64_t shadowRays = 0;
  const LitRadiance radiance = lit.Radiance(hit, 0, 1, shadowRays);
  return radiance.direct + radiance.indirect;
}

TEST(SecondLook, GivesElementsThatWereMetTheMeanOfWhatTheySee)
{
  const GatherStage stage = MakeEvenRoom();
  LitSurfaces lit(stage.occluders, stage.solution);
  const Hit floor = Met(stage, Vec3(0.3, 0.4, 0.5), Vec3(0.0, 0.0, -1.0));
  const Hit again = Met(stage, Vec3(0.8, 0.6, 0.5), Vec3(0.0, 0.0, -1.0));
  const SecondLook look = LookAgain(stage, { floor, again }, 16, 1, lit);
  EXPECT_EQ(look.Rays(), 32u);
  EXPECT_EQ(look.ShadowRays(), 0u);
  EXPECT_EQ(look.Correction(), 1.0);
  // All 32 rays see the same; the solution counts as four.
  const Color expected = (32.0 * Albedo * Reflected + 4.0 * Reflected) / 36.0;
  const Color found = RadianceAt(lit, floor);
  for (int c = 0; c < 3; ++c)
  {
    EXPECT_NEAR(found[c], expected[c], 1e-12); // round-off
  }
  // The ceiling was not met.
  EXPECT_EQ(RadianceAt(lit, Met(stage, Vec3(0.3, 0.4, 0.5), Vec3(0.0, 0.0, 1.0))), Reflected);
}

TEST(SecondLook, KeepsWhatUnnamedLampsGive)
{
  GatherStage stage = MakeEvenRoom();
  const Hit floor = Met(stage, Vec3(0.3, 0.4, 0.5), Vec3(0.0, 0.0, -1.0));
  const auto look = [&]
  {
    LitSurfaces lit(stage.occluders, stage.solution);
    LookAgain(stage, { floor }, 12, 1, lit);
    return RadianceAt(lit, floor);
  };
  const Color without = look();
  const Color irradiance(3.0, 2.0, 1.0);
  ElementOf(stage, floor).unnamedDirect = irradiance;
  const Color gain = look() - without;
  for (int c = 0; c < 3; ++c)
  {
    // The 12 rays count with the four of the solution.
    EXPECT_NEAR(gain[c], 0.75 * Albedo[c] / Pi * irradiance[c], 1e-12); // round-off
  }
}

/// Of a solution that has but `part` of the light there is, the same everywhere. Of each element,
/// light comes from unnamed lamps, and I = albedo (U / pi + I).
GatherStage MakeRoomWithPart(double part)
{
  GatherStage stage = MakeEvenRoom();
  const Color irradiance(3.0);
  for (RadianceSolution::Element& element : stage.solution.elements)
  {
    element.unnamedDirect = irradiance;
    element.indirect = part * Albedo / (1.0 - Albedo) * irradiance / Pi;
  }
  return stage;
}

/// So many hits of all faces of a room, in turn.
std::vector<Hit> HitsAllAround(const GatherStage& stage, int count)
{
  std::vector<Hit> hits;
  for (int i = 0; i < count; ++i)
  {
    Vec3 way(0.0);
    way[i % 3] = i % 6 < 3 ? 1.0 : -1.0;
    hits.push_back(Met(stage, Vec3(0.3, 0.4, 0.5), way));
  }
  return hits;
}

double CorrectionFor(double part, int hits)
{
  const GatherStage stage = MakeRoomWithPart(part);
  LitSurfaces lit(stage.occluders, stage.solution);
  return LookAgain(stage, HitsAllAround(stage, hits), 2, 1, lit).Correction();
}

TEST(SecondLook, CorrectsASolutionThatDoesNotAgreeWithItself)
{
  for (const double part : { 0.7, 0.9, 1.0, 1.3 })
  {
    EXPECT_NEAR(CorrectionFor(part, 100), 1.0 / part, 1e-9) << part; // round-off
  }
  EXPECT_EQ(CorrectionFor(0.2, 100), 2.0); // bounds
  EXPECT_EQ(CorrectionFor(5.0, 100), 0.5);
  EXPECT_EQ(CorrectionFor(0.9, 10), 1.0); // too few to tell
}

/// What was met is corrected with all that lies around it, whether or not a look fell on it.
TEST(SecondLook, CorrectsElementsBesideThoseThatWereMet)
{
  GatherStage stage = MakeRoomWithPart(0.8);
  const Hit floor = Met(stage, Vec3(0.3, 0.4, 0.5), Vec3(0.0, 0.0, -1.0));
  const Hit beside = Met(stage, Vec3(0.9, 0.9, 0.5), Vec3(0.0, 0.0, -1.0));
  RadianceSolution& solution = stage.solution;
  const RadianceSolution::NodeIndex whole = solution.LeafAt(floor.Patch(), floor.point);
  RadianceSolution::Element part = solution.elements[whole];
  part.area *= 0.25;
  solution.elements[whole].firstChild = static_cast<std::uint32_t>(solution.elements.size());
  solution.elements[whole].childCount = 4;
  solution.elements.insert(solution.elements.end(), 4, part);
  solution.StartAt(floor.Patch(), ShapeOf(stage.occluders, floor.Patch()), whole);
  ASSERT_NE(
    solution.LeafAt(floor.Patch(), floor.point), solution.LeafAt(beside.Patch(), beside.point));
  LitSurfaces lit(stage.occluders, solution);
  const Color before = RadianceAt(lit, beside);
  // Of the floor, all hits are in one quarter, too few to tell that no ray gets to the others.
  std::vector<Hit> hits = HitsAllAround(stage, 120);
  hits.erase(std::remove_if(hits.begin(), hits.end(),
               [&](const Hit& hit) { return hit.Patch() == floor.Patch(); }),
    hits.end());
  hits.insert(hits.end(), 6, floor);
  const SecondLook look = LookAgain(stage, hits, 2, 1, lit);
  EXPECT_NEAR(look.Correction(), 1.0 / 0.8, 1e-9);                             // round-off
  EXPECT_NEAR(RadianceAt(lit, beside).y, look.Correction() * before.y, 1e-12); // round-off
}

/// Nothing says that what the view does not meet errs by the same factor.
TEST(SecondLook, LeavesWhatWasNotMetAsItIs)
{
  GatherStage stage = MakeRoomWithPart(0.5);
  const Hit floor = Met(stage, Vec3(0.3, 0.4, 0.5), Vec3(0.0, 0.0, -1.0));
  const Hit ceiling = Met(stage, Vec3(0.3, 0.4, 0.5), Vec3(0.0, 0.0, 1.0));
  LitSurfaces lit(stage.occluders, stage.solution);
  const Color before = RadianceAt(lit, ceiling);
  const RadianceSolution::Element& element = ElementOf(stage, floor);
  const Color known = element.indirect;
  const Color seen = Albedo * (element.unnamedDirect / Pi + element.indirect);
  const SecondLook look = LookAgain(stage, std::vector<Hit>(100, floor), 2, 1, lit);
  EXPECT_NEAR(look.Correction(), Mean(seen) / Mean(known), 1e-9); // round-off
  EXPECT_EQ(RadianceAt(lit, ceiling), before);
}

/// A room where one wall shines and the floor gets next to nothing from lamps.
GatherStage MakeRoomWithBrightWall(const Color& radiance)
{
  GatherStage stage = MakeEvenRoom();
  ElementOf(stage, Met(stage, Vec3(0.3, 0.4, 0.5), Vec3(1.0, 0.0, 0.0))).indirect = radiance;
  ElementOf(stage, Met(stage, Vec3(0.3, 0.4, 0.5), Vec3(0.0, 0.0, -1.0))).unnamedDirect =
    Color(0.01);
  return stage;
}

/// The floor has in the mean what rays find, most of which is found by one ray of five.
TEST(SecondLook, NoiseIsNoReasonForACorrection)
{
  constexpr double FloorToWall = 0.200043776075403; // classical form factor
  constexpr int Seeds = 200;
  const Color bright(100.0);
  GatherStage stage = MakeRoomWithBrightWall(bright);
  const Hit floor = Met(stage, Vec3(0.3, 0.4, 0.5), Vec3(0.0, 0.0, -1.0));
  RadianceSolution::Element& element = ElementOf(stage, floor);
  element.unnamedDirect = Color(0.0);
  element.indirect = Albedo * (FloorToWall * bright + (1.0 - FloorToWall) * Reflected);
  double ofFactors = 0.0;
  double ofCorrections = 0.0;
  for (std::uint64_t seed = 1; seed <= Seeds; ++seed)
  {
    // Of points all over the floor, as the form factor is their mean.
    std::vector<Hit> hits;
    for (std::uint32_t i = 0; i < 64; ++i)
    {
      const Vec2 place = ScrambledSobol(i, seed);
      hits.push_back(Met(stage, Vec3(place, 0.5), Vec3(0.0, 0.0, -1.0)));
    }
    LitSurfaces surfaces(stage.occluders, stage.solution);
    const SecondLook look = LookAgain(stage, hits, 1, seed, surfaces);
    ofFactors += std::abs(look.Factor() - 1.0) / Seeds;
    ofCorrections += std::abs(look.Correction() - 1.0) / Seeds;
  }
  EXPECT_GT(ofFactors, 0.1);
  // A normal deviate z, of which max(0, |z| - 1 / |z|) is left, keeps a third in the mean.
  EXPECT_LT(ofCorrections, 0.5 * ofFactors);
}

/// Oracle: the spread over seeds.
TEST(SecondLook, KnowsItsNoise)
{
  constexpr int Seeds = 200;
  const GatherStage stage = MakeRoomWithBrightWall(2.0 * Reflected);
  const std::vector<Hit> hits(100, Met(stage, Vec3(0.3, 0.4, 0.5), Vec3(0.0, 0.0, -1.0)));
  const LitSurfaces lit(stage.occluders, stage.solution);
  double sum = 0.0;
  double squares = 0.0;
  double told = 0.0;
  for (std::uint64_t seed = 1; seed <= Seeds; ++seed)
  {
    SecondLook look(stage.occluders, stage.solution, 2, seed);
    look.From(hits, lit);
    sum += look.Factor();
    squares += look.Factor() * look.Factor();
    told += look.Noise() * look.Noise();
  }
  const double spread = std::sqrt(squares / Seeds - sum / Seeds * (sum / Seeds));
  EXPECT_GT(spread, 0.01 * sum / Seeds);
  // Four standard errors of a standard deviation, 1 / sqrt(2 n) each.
  EXPECT_NEAR(std::sqrt(told / Seeds) / spread, 1.0, 4.0 / std::sqrt(2.0 * Seeds));
}

TEST(SecondLook, GoesOnWhereItStopped)
{
  const GatherStage stage = MakeRoomWithBrightWall(Color(100.0));
  const std::vector<Hit> hits(80, Met(stage, Vec3(0.3, 0.4, 0.5), Vec3(0.0, 0.0, -1.0)));
  const LitSurfaces lit(stage.occluders, stage.solution);
  SecondLook atOnce(stage.occluders, stage.solution, 2, 1);
  atOnce.From(hits, lit);
  SecondLook inTwo(stage.occluders, stage.solution, 2, 1);
  inTwo.From(std::vector<Hit>(hits.begin(), hits.begin() + 30), lit);
  inTwo.From(std::vector<Hit>(hits.begin() + 30, hits.end()), lit);
  EXPECT_EQ(inTwo.Rays(), atOnce.Rays());
  EXPECT_EQ(inTwo.Factor(), atOnce.Factor());
  EXPECT_EQ(inTwo.Noise(), atOnce.Noise());
}

TEST(SecondLook, TheNumberOfThreadsChangesNothing)
{
  const GatherStage stage(MakeFloorBelowLamps(3), AllButEmission);
  std::vector<Hit> hits;
  for (int i = 0; i < 200; ++i)
  {
    hits.push_back(Met(stage, Vec3(0.01 * i - 1.0, 0.2, 0.1), Vec3(0.0, 0.0, -1.0)));
  }
  const auto look = [&](int threads)
  {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
    LitSurfaces lit(stage.occluders, stage.solution);
    LookAgain(stage, hits, 8, 1, lit);
    return RadianceAt(lit, FloorHit(stage));
  };
  const Color expected = look(1);
  EXPECT_NE(expected, RadianceAt(LitSurfaces(stage.occluders, stage.solution), FloorHit(stage)));
  EXPECT_EQ(look(2), expected);
  EXPECT_EQ(look(4), expected);
}

} // namespace
} // namespace vantage
