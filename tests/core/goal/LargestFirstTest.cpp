#include "core/goal/LargestFirst.h"

#include "core/math/Sampling.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>

namespace vantage
{
namespace
{

TEST(LargestFirst, TheFirstAreTheLeastNumberThatHasTheShare)
{
  for (std::uint64_t seed = 1; seed <= 20; ++seed)
  {
    SCOPED_TRACE("seed " + std::to_string(seed));
    std::vector<double> values;
    for (std::uint64_t i = 0; i < 100 + seed; ++i)
    {
      // Some are equal, some are zero.
      values.push_back(i % 7 == 0 ? 0.0 : i % 5 == 0 ? 0.5 : ToUnit(Hash(i, seed)));
    }
    std::vector<std::uint32_t> sorted(values.size());
    std::iota(sorted.begin(), sorted.end(), 0);
    std::stable_sort(sorted.begin(), sorted.end(),
      [&](std::uint32_t a, std::uint32_t b) { return values[a] > values[b]; });
    const double all = std::accumulate(values.begin(), values.end(), 0.0);
    for (const double share : { 0.01, 0.45, 0.9 })
    {
      std::size_t expected = 0;
      for (double sum = 0.0; sum < share * all; ++expected)
      {
        sum += values[sorted[expected]];
      }
      std::vector<std::uint32_t> items(values.size());
      std::iota(items.begin(), items.end(), 0);
      ASSERT_EQ(MoveLargestFirst(items, values, share), expected) << share;
      std::sort(items.begin(), items.begin() + static_cast<std::ptrdiff_t>(expected));
      std::vector<std::uint32_t> first(sorted.begin(), sorted.begin() + expected);
      std::sort(first.begin(), first.end());
      EXPECT_TRUE(std::equal(first.begin(), first.end(), items.begin())) << share;
    }
  }
}

TEST(LargestFirst, OfNothingThereIsNothing)
{
  std::vector<std::uint32_t> none;
  EXPECT_EQ(MoveLargestFirst(none, {}, 0.5), 0u);
  std::vector<std::uint32_t> one{ 2 };
  EXPECT_EQ(MoveLargestFirst(one, { 0.0, 0.0, 3.0 }, 0.5), 1u);
}

} // namespace
} // namespace vantage
