#pragma once

#include "core/mesh/Facets.h"

#include <algorithm>
#include <cstdint>
#include <vector>

/// \file Neighbourhood.h
/// Which facets are near which.

namespace vantage
{

/// Lists of numbers, one for each key below some number, packed.
class PackedLists
{
public:
  struct List
  {
    const std::uint32_t* first;
    const std::uint32_t* last;

    const std::uint32_t* begin() const { return this->first; }
    const std::uint32_t* end() const { return this->last; }
  };

  /// `forEach` calls what it is given with each key and entry, twice in the same order. O(keys +
  /// entries).
  template <typename ForEach>
  PackedLists(std::size_t keys, const ForEach& forEach)
    : Starts(keys + 1, 0)
  {
    forEach([this](std::uint32_t key, std::uint32_t) { ++this->Starts[key]; });
    std::uint32_t sum = 0;
    for (std::uint32_t& start : this->Starts)
    {
      sum += start;
      start = sum;
    }
    this->Entries.resize(sum);
    forEach([this](std::uint32_t key, std::uint32_t entry)
      { this->Entries[--this->Starts[key]] = entry; });
  }

  /// Of a key, in reversed order of the calls unless they were sorted.
  List Of(std::uint32_t key) const
  {
    const std::uint32_t* entries = this->Entries.data();
    return { entries + this->Starts[key], entries + this->Starts[key + 1] };
  }

  /// Each list in ascending order.
  void Sort()
  {
    for (std::size_t key = 0; key + 1 < this->Starts.size(); ++key)
    {
      std::sort(
        this->Entries.begin() + this->Starts[key], this->Entries.begin() + this->Starts[key + 1]);
    }
  }

private:
  std::vector<std::uint32_t> Starts; ///< of each list in the entries, and the end
  std::vector<std::uint32_t> Entries;
};

/// For each facet the others whose bounding boxes come closer to its own than the tolerance, in
/// ascending order. O(n) for facets of like size that are each near a few; O(n k) where k are near
/// each.
PackedLists NeighboursOf(const std::vector<Facet>& facets, double tolerance);

} // namespace vantage
