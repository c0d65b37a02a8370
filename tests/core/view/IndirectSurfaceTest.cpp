#include "core/view/IndirectSurface.h"
#include "core/math/Sampling.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>

namespace vantage
{
namespace
{

using Function = std::function<double(const Vec2&)>;

std::vector<SurfaceSpot> RandomSpots(std::uint32_t count)
{
  RandomStream random(31);
  std::vector<SurfaceSpot> spots;
  for (std::uint32_t i = 0; i < count; ++i)
  {
    spots.push_back({ { 3.0 * random.Next(), 2.0 * random.Next() }, 1.0, i });
  }
  return spots;
}

void Measure(IndirectSurface& surface, const Function& value)
{
  for (IndirectSurface::Cell& cell : surface.Cells())
  {
    if (cell.samples == 0)
    {
      cell.samples = 1;
      cell.value = Color(value(surface.Spot(cell.point).place));
    }
  }
  surface.Fit();
}

std::vector<Color> Evaluated(const IndirectSurface& surface, std::size_t spots)
{
  std::vector<Color> values(spots, Color(-1.0));
  surface.Evaluate(values.data());
  return values;
}

/// Mean error over the spots.
double ErrorOf(
  const IndirectSurface& surface, const std::vector<SurfaceSpot>& spots, const Function& value)
{
  const std::vector<Color> values = Evaluated(surface, spots.size());
  double sum = 0.0;
  for (const SurfaceSpot& spot : spots)
  {
    sum += std::abs(Mean(values[spot.index]) - value(spot.place)) / spots.size();
  }
  return sum;
}

TEST(IndirectSurface, AConstantIsKept)
{
  const auto spots = RandomSpots(2000);
  IndirectSurface surface(spots, {}, 50);
  Measure(surface, [](const Vec2&) { return 0.7; });
  for (const Color& value : Evaluated(surface, spots.size()))
  {
    ASSERT_NEAR(value.y, 0.7, 1e-12);
  }
}

TEST(IndirectSurface, SlopesAreFollowed)
{
  const Function slope = [](const Vec2& x) { return 1.0 + 0.3 * x.x - 0.2 * x.y; };
  const auto spots = RandomSpots(4000);
  IndirectSurface surface(spots, {}, 50);
  Measure(surface, slope);
  // Without slopes, cells of 0.25 would err by a twelfth of the slope or so.
  EXPECT_LT(ErrorOf(surface, spots, slope), 0.002);
}

TEST(IndirectSurface, CutsCellsWhereTheModelFails)
{
  const Function bump = [](const Vec2& x)
  { return std::exp(-40.0 * glm::dot(x - Vec2(0.5, 1.5), x - Vec2(0.5, 1.5))); };
  const auto spots = RandomSpots(8000);
  IndirectSurface surface(spots, {}, 300);
  Measure(surface, bump);
  const double before = ErrorOf(surface, spots, bump);
  std::size_t cuts = 0;
  for (int round = 0; round < 5; ++round)
  {
    double worst = 0.0;
    for (const IndirectSurface::Cell& cell : surface.Cells())
    {
      worst = std::max(worst, IndirectSurface::ModelError(cell));
    }
    cuts += surface.Refine(0.3 * worst);
    Measure(surface, bump);
  }
  EXPECT_GT(cuts, 10u);
  EXPECT_LT(ErrorOf(surface, spots, bump), 0.25 * before);
  std::size_t nearBump = 0;
  for (const IndirectSurface::Cell& cell : surface.Cells())
  {
    nearBump += glm::distance(cell.low + 0.5 * cell.size, Vec2(0.5, 1.5)) < 0.7 ? 1 : 0;
  }
  EXPECT_GT(nearBump, surface.Cells().size() / 2);
}

TEST(IndirectSurface, NothingPassesThroughAWall)
{
  const Function step = [](const Vec2& x) { return x.x < 1.3 ? 5.0 : 0.0; };
  const auto spots = RandomSpots(4000);
  const auto leak = [&](const std::vector<Foot>& feet)
  {
    IndirectSurface surface(spots, feet, 60);
    Measure(surface, step);
    const std::vector<Color> values = Evaluated(surface, spots.size());
    double most = 0.0;
    for (const SurfaceSpot& spot : spots)
    {
      if (spot.place.y > 0.2 && spot.place.y < 1.8)
      {
        most = std::max(most, std::abs(Mean(values[spot.index]) - step(spot.place)));
      }
    }
    return most;
  };
  EXPECT_GT(leak({}), 1.0);
  EXPECT_LT(leak({ { { 1.3, -0.1 }, { 1.3, 2.1 } } }), 1e-9);
}

TEST(IndirectSurface, DoubtfulCellsAreMeasuredAgainWithMoreEffort)
{
  IndirectSurface surface(RandomSpots(1000), {}, 100);
  for (IndirectSurface::Cell& cell : surface.Cells())
  {
    cell.samples = 8;
    cell.value = Color(1.0);
    cell.noise = surface.Spot(cell.point).place.x < 1.5 ? 0.2 : 0.001;
  }
  surface.Fit();
  const std::size_t doubtful = surface.Doubt(0.1, std::numeric_limits<double>::infinity(), 16);
  EXPECT_GT(doubtful, surface.Cells().size() / 4);
  EXPECT_LT(doubtful, surface.Cells().size());
  for (const IndirectSurface::Cell& cell : surface.Cells())
  {
    EXPECT_EQ(cell.samples == 0, cell.effort == 4);
  }
}

TEST(IndirectSurface, OneSpotIsEnough)
{
  const std::vector<SurfaceSpot> one{ { { 0.3, 0.4 }, 1.0, 0 } };
  IndirectSurface surface(one, {}, 10);
  Measure(surface, [](const Vec2&) { return 2.0; });
  EXPECT_NEAR(Evaluated(surface, 1)[0].x, 2.0, 1e-12);
}

} // namespace
} // namespace vantage
