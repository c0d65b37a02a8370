#include "core/goal/LargestFirst.h"

#include <algorithm>
#include <numeric>

namespace vantage
{

std::size_t MoveLargestFirst(
  std::vector<std::uint32_t>& items, const std::vector<double>& values, double share)
{
  const auto isBefore = [&values](std::uint32_t a, std::uint32_t b)
  { return values[a] != values[b] ? values[a] > values[b] : a < b; };
  const auto sum = [&values](auto begin, auto end)
  {
    return std::accumulate(
      begin, end, 0.0, [&values](double s, std::uint32_t item) { return s + values[item]; });
  };
  // Those before `first` are not enough, those before `last` are.
  double missing = share * sum(items.begin(), items.end());
  auto first = items.begin();
  auto last = items.end();
  while (last - first > 1)
  {
    const auto middle = first + (last - first) / 2;
    std::nth_element(first, middle, last, isBefore);
    const double larger = sum(first, middle);
    if (larger < missing)
    {
      missing -= larger;
      first = middle;
    }
    else
    {
      last = middle;
    }
  }
  return static_cast<std::size_t>(last - items.begin());
}

} // namespace vantage
