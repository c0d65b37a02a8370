#include "core/mesh/TouchingBoxes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <utility>

namespace vantage
{
namespace
{

using Pairs = std::vector<std::pair<std::uint32_t, std::uint32_t>>;

Pairs Sorted(Pairs pairs)
{
  for (auto& [a, b] : pairs)
  {
    if (a > b)
    {
      std::swap(a, b);
    }
  }
  std::sort(pairs.begin(), pairs.end());
  return pairs;
}

Pairs Found(const std::vector<Box>& boxes, double tolerance)
{
  Pairs pairs;
  ForEachTouchingPair(
    boxes, tolerance, [&](std::uint32_t a, std::uint32_t b) { pairs.emplace_back(a, b); });
  return Sorted(pairs);
}

Pairs Expected(const std::vector<Box>& boxes, double tolerance)
{
  Pairs pairs;
  for (std::uint32_t a = 0; a < boxes.size(); ++a)
  {
    for (std::uint32_t b = a + 1; b < boxes.size(); ++b)
    {
      if (boxes[a].Touches(boxes[b], tolerance))
      {
        pairs.emplace_back(a, b);
      }
    }
  }
  return pairs;
}

/// Boxes in the unit cube, of sizes from 1 down to 10^-decades.
std::vector<Box> RandomBoxes(std::size_t count, double decades, unsigned seed)
{
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  const auto place = [&] { return Vec3(unit(random), unit(random), unit(random)); };
  std::vector<Box> boxes;
  for (std::size_t k = 0; k < count; ++k)
  {
    const Vec3 low = place();
    const double size = std::pow(10.0, -decades * unit(random));
    boxes.emplace_back(Polygon{ low, low + size * place() });
  }
  return boxes;
}

TEST(TouchingBoxes, AreThoseThatAllPairsGive)
{
  for (unsigned seed = 1; seed <= 40; ++seed)
  {
    SCOPED_TRACE(seed);
    const std::vector<Box> boxes = RandomBoxes(5 * seed, 4.0, seed);
    const double tolerance = seed % 2 == 0 ? 0.0 : 0.01;
    EXPECT_EQ(Found(boxes, tolerance), Expected(boxes, tolerance));
  }
}

TEST(TouchingBoxes, MayBeNoneOneOrAllInOnePlace)
{
  EXPECT_TRUE(Found({}, 1.0).empty());
  const Box box(Polygon{ Vec3(1.0), Vec3(1.0) });
  EXPECT_TRUE(Found({ box }, 1.0).empty());
  const std::vector<Box> same(20, box);
  EXPECT_EQ(Found(same, 0.0).size(), 190u);
}

/// A grid of cells of their mean size would have 10^10 in the large one.
TEST(TouchingBoxes, MayBeOfAnySize)
{
  std::vector<Box> boxes = RandomBoxes(20000, 0.0, 7);
  for (Box& box : boxes)
  {
    box.high = box.low + 1e-4;
  }
  boxes.emplace_back(Polygon{ Vec3(-1.0), Vec3(2.0) });
  const Pairs pairs = Found(boxes, 0.0);
  EXPECT_EQ(std::count_if(
              pairs.begin(), pairs.end(), [](const auto& pair) { return pair.second == 20000u; }),
    20000);
}

} // namespace
} // namespace vantage
