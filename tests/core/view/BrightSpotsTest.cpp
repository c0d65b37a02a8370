#include "core/view/BrightSpots.h"

#include "core/formfactor/FormFactor.h"
#include "core/view/BrightPlate.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace vantage
{
namespace
{

using test::BrightPlate;

/// Where a ray meets a place on the upper side of the plate, as a texel.
LitRadiance AtPlace(const BrightPlate& room, const Vec3& place)
{
  std::uint64_t shadowRays = 0;
  const Hit hit{ room.Patch / 2, SideOf(room.Patch), place, 1.0 };
  return room.Lit.Radiance(hit, LitBy::Texels, 0, 1, shadowRays);
}

const Vec3 Above(0.6, 1.3, 2.0);
const Vec3 Down(0.0, 0.0, -1.0);

TEST(BrightSpots, AreTheTexelsOfWhatIsBright)
{
  BrightPlate room(BrightPlate::Square());
  EXPECT_TRUE(room.Lit.Spots().All().empty());
  room.Light(4000, 1);
  ASSERT_FALSE(room.Lit.Spots().All().empty());
  double area = 0.0;
  for (const BrightSpots::Spot& spot : room.Lit.Spots().All())
  {
    EXPECT_EQ(spot.centre.z, BrightPlate::Height);
    EXPECT_EQ(spot.normal.z, 1.0);
    EXPECT_DOUBLE_EQ(spot.radiance, room.Bright);
    area += spot.area;
  }
  EXPECT_NEAR(area, 0.04, 1e-12); // round-off
}

TEST(BrightSpots, ThereAreNoneWhereAllIsAlike)
{
  BrightPlate room(BrightPlate::Square(), 1.0);
  room.Light(4000, 1);
  EXPECT_TRUE(room.Lit.Spots().All().empty());
  const SpotDirections spots(room.Lit.Spots(), Above, Down);
  EXPECT_EQ(spots.PartOf(1000), 0u);
}

/// Of a patch with so few hits there are no known texels.
TEST(BrightSpots, OfWhatIsNotKnownTheSolutionTells)
{
  BrightPlate room(BrightPlate::Square());
  std::vector<Hit> sample = room.Sample(1000, 2);
  const auto isOnPlate = [&](const Hit& hit) { return hit.Patch() == room.Patch; };
  sample.erase(std::remove_if(sample.begin(), sample.end(), isOnPlate), sample.end());
  sample.push_back({ room.Patch / 2, SideOf(room.Patch), Vec3(1, 1, BrightPlate::Height), 1.0 });
  room.Lit.LightSample(sample, {}, 2);
  ASSERT_EQ(room.Lit.Spots().All().size(), 1u);
  EXPECT_EQ(room.Lit.Spots().All()[0].radiance, room.Bright);
}

TEST(BrightSpots, KnowWhatPartOfThemIsVisible)
{
  BrightPlate open(BrightPlate::Square());
  open.Light(20000, 3);
  // A lid of twice its size right above the left half: next to nothing sees that.
  BrightPlate covered(BrightPlate::Square(), 200.0,
    { { { 0.0, 0.0, 0.301 }, { 1.0, 0.0, 0.301 }, { 1.0, 2.0, 0.301 }, { 0.0, 2.0, 0.301 } } });
  covered.Light(20000, 3);
  const auto visible = [](const BrightPlate& room, bool left)
  {
    double sum = 0.0;
    double area = 0.0;
    for (const BrightSpots::Spot& spot : room.Lit.Spots().All())
    {
      if ((spot.centre.x < 1.0) == left)
      {
        sum += spot.area * spot.visible;
        area += spot.area;
      }
    }
    return sum / area;
  };
  // 5 to 7 hits to a texel, of which at most all are visible.
  EXPECT_GT(visible(open, true), 0.7);
  EXPECT_GT(visible(covered, false), 0.7);
  EXPECT_LT(visible(covered, true), 0.3);
}

/// Of a square, a quadrilateral without parallel edges and a triangle.
class SpotShapes : public testing::TestWithParam<std::vector<Vec3>>
{
};

TEST_P(SpotShapes, AreDrawnWithTheDensityThatIsStated)
{
  BrightPlate room(GetParam());
  room.Light(4000, 4);
  const SpotDirections spots(room.Lit.Spots(), Above, Down);
  ASSERT_EQ(spots.PartOf(8), 1u);
  RandomStream random(5);
  constexpr int Draws = 20000;
  double sum = 0.0;
  double squares = 0.0;
  for (int i = 0; i < Draws; ++i)
  {
    const SpotDirections::Target target = spots.Draw(random.Next2());
    const LitRadiance there = AtPlace(room, target.place);
    ASSERT_EQ(there.texel, target.texel);
    const Vec3 way = target.place - Above;
    const double density = spots.Density(there.texel, there.within, target.place);
    const double value = -way.z / glm::length(way) / density;
    sum += value;
    squares += value * value;
  }
  const double mean = sum / Draws;
  const double sigma = std::sqrt((squares / Draws - mean * mean) / Draws);
  const double exact = PointToPolygon(Above, Down, room.Stage.occluders.Shape(room.Patch / 2));
  EXPECT_NEAR(mean, std::abs(exact), 5.0 * sigma);
  EXPECT_LT(sigma, 0.3 * mean / std::sqrt(Draws)); // nearly as they light the point
}

TEST_P(SpotShapes, HaveADensityThatSumsUpToOne)
{
  BrightPlate room(GetParam());
  room.Light(4000, 6);
  const SpotDirections spots(room.Lit.Spots(), Above, Down);
  const Polygon shape = room.Stage.occluders.Shape(room.Patch / 2);
  constexpr int Steps = 200;
  double sum = 0.0;
  for (int i = 0; i < Steps * Steps; ++i)
  {
    const Vec2 u((i % Steps + 0.5) / Steps, (i / Steps + 0.5) / Steps);
    const Vec3 place = PointAt(shape, u);
    const LitRadiance there = AtPlace(room, place);
    const Vec3 way = place - Above;
    const double square = glm::dot(way, way);
    const double solidAngle =
      AreaElementAt(shape, u) / (Steps * Steps) * -way.z / (square * std::sqrt(square));
    sum += spots.Density(there.texel, there.within, place) * solidAngle;
  }
  EXPECT_NEAR(sum, 1.0, 0.02); // midpoints, and steps between texels at the borders of these
}

INSTANTIATE_TEST_SUITE_P(BrightSpots, SpotShapes,
  testing::Values(BrightPlate::Square(),
    std::vector<Vec3>{ { 0.8, 0.9, 0.3 }, { 1.3, 0.8, 0.3 }, { 1.1, 1.1, 0.3 }, { 0.9, 1.2, 0.3 } },
    std::vector<Vec3>{ { 0.8, 0.9, 0.3 }, { 1.3, 0.8, 0.3 }, { 1.0, 1.2, 0.3 } }));

TEST(BrightSpots, AreNotDrawnFromBehindThem)
{
  BrightPlate room(BrightPlate::Square());
  room.Light(4000, 7);
  ASSERT_FALSE(room.Lit.Spots().All().empty());
  EXPECT_EQ(SpotDirections(room.Lit.Spots(), { 0.6, 1.3, 0.0 }, { 0, 0, 1 }).PartOf(1000), 0u);
  EXPECT_EQ(SpotDirections(room.Lit.Spots(), { 0.6, 1.3, 2.0 }, { 0, 0, 1 }).PartOf(1000), 0u);
  EXPECT_EQ(SpotDirections(room.Lit.Spots(), Above, Down).PartOf(1000), 125u);
  EXPECT_EQ(SpotDirections(room.Lit.Spots(), Above, Down).PartOf(2), 1u);
  EXPECT_EQ(SpotDirections(room.Lit.Spots(), Above, Down).PartOf(1), 0u); // it looks everywhere
}

} // namespace
} // namespace vantage
