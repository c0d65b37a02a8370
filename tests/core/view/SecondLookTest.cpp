#include "core/view/SecondLook.h"

#include "core/math/ScrambledSobol.h"
#include "core/view/LampsOverFloor.h"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <algorithm>
#include <cmath>

namespace vantage
{
namespace
{

using namespace test;

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
  const LitRadiance radiance = lit.Radiance(hit, LitBy::ShadowRays, 0, 1, shadowRays);
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
