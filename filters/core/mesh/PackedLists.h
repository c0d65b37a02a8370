#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

/// \file PackedLists.h
/// Lists that follow each other in one vector.

namespace vantage
{

/// A list of entries for each key below some number, made by a counting sort.
template <typename Entry>
class PackedLists
{
public:
  struct List
  {
    const Entry* first;
    const Entry* last;

    const Entry* begin() const { return this->first; }
    const Entry* end() const { return this->last; }
    std::size_t size() const { return static_cast<std::size_t>(this->last - this->first); }
  };

  /// `forEach` calls what it is given with each key and entry, twice in the same order. O(keys +
  /// entries).
  template <typename ForEach>
  PackedLists(std::size_t keys, const ForEach& forEach)
    : Starts(keys + 1, 0)
  {
    forEach([this](std::uint32_t key, const Entry&) { ++this->Starts[key]; });
    std::uint32_t sum = 0;
    for (std::uint32_t& start : this->Starts)
    {
      sum += start;
      start = sum;
    }
    this->Entries.resize(sum);
    forEach([this](std::uint32_t key, const Entry& entry)
      { this->Entries[--this->Starts[key]] = entry; });
  }

  /// Of a key, in reversed order of the calls unless they were sorted.
  List Of(std::uint32_t key) const
  {
    const Entry* entries = this->Entries.data();
    return { entries + this->Starts[key], entries + this->Starts[key + 1] };
  }

  /// Each list by itself.
  template <typename IsBefore>
  void Sort(const IsBefore& isBefore)
  {
    for (std::size_t key = 0; key + 1 < this->Starts.size(); ++key)
    {
      std::sort(this->Entries.begin() + this->Starts[key],
        this->Entries.begin() + this->Starts[key + 1], isBefore);
    }
  }

  /// All lists, one after the other.
  std::vector<Entry> TakeEntries() { return std::move(this->Entries); }

private:
  std::vector<std::uint32_t> Starts; ///< of each list in the entries, and the end
  std::vector<Entry> Entries;
};

/// Items in the order of their buckets, and of `isBefore` within each. `forEach` calls what it is
/// given with all items, twice alike; `bucketOf` gives a number below `buckets`, which does not
/// descend where items ascend. O(n + buckets) while there are a few items a bucket.
template <typename Item, typename ForEach, typename BucketOf, typename IsBefore>
std::vector<Item> BucketSorted(
  std::size_t buckets, const ForEach& forEach, const BucketOf& bucketOf, const IsBefore& isBefore)
{
  PackedLists<Item> lists(buckets,
    [&](const auto& visit) { forEach([&](const Item& item) { visit(bucketOf(item), item); }); });
  lists.Sort(isBefore);
  return lists.TakeEntries();
}

} // namespace vantage
