#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

/// \file BucketSort.h
/// Sorts what spreads evenly over buckets.

namespace vantage
{

/// Items in the order of their buckets, and of `isBefore` within each. `forEach` calls what it is
/// given with all items, twice alike; `bucketOf` gives a number below `buckets`, which does not
/// descend where items ascend. O(n + buckets) while there are a few items a bucket.
template <typename Item, typename ForEach, typename BucketOf, typename IsBefore>
std::vector<Item> BucketSorted(
  std::size_t buckets, const ForEach& forEach, const BucketOf& bucketOf, const IsBefore& isBefore)
{
  std::vector<std::uint32_t> ends(buckets, 0);
  forEach([&](const Item& item) { ++ends[bucketOf(item)]; });
  std::uint32_t sum = 0;
  for (std::uint32_t& end : ends)
  {
    sum += std::exchange(end, sum);
  }
  std::vector<Item> sorted(sum);
  forEach([&](const Item& item) { sorted[ends[bucketOf(item)]++] = item; });
  auto first = sorted.begin();
  for (const std::uint32_t end : ends)
  {
    const auto last = sorted.begin() + end;
    std::sort(first, last, isBefore);
    first = last;
  }
  return sorted;
}

} // namespace vantage
