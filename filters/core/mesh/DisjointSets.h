#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <vector>

/// \file DisjointSets.h
/// Union-find.

namespace vantage
{

/// Sets of the numbers below `size`; the smallest number of a set stands for it, so that the result
/// does not depend on the order of the joins. Nearly O(1) each (path halving).
class DisjointSets
{
public:
  explicit DisjointSets(std::size_t size)
    : Parents(size)
  {
    std::iota(this->Parents.begin(), this->Parents.end(), 0u);
  }

  std::uint32_t Find(std::uint32_t i)
  {
    while (this->Parents[i] != i)
    {
      this->Parents[i] = this->Parents[this->Parents[i]];
      i = this->Parents[i];
    }
    return i;
  }

  void Join(std::uint32_t i, std::uint32_t j)
  {
    i = this->Find(i);
    j = this->Find(j);
    this->Parents[std::max(i, j)] = std::min(i, j);
  }

private:
  std::vector<std::uint32_t> Parents;
};

} // namespace vantage
