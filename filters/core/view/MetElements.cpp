#include "core/view/MetElements.h"

#include <algorithm>

namespace vantage
{

namespace
{

using NodeIndex = RadianceSolution::NodeIndex;

/// Of a pool, so that its density is known to a third.
constexpr std::uint32_t LeastHits = 8;
constexpr double LeastDensity = 0.01;

/// The elements below a node that are in no pool further down.
struct Pool
{
  std::uint32_t hits = 0;
  double area = 0.0;

  bool IsFull() const { return this->hits >= LeastHits; }
};

/// Of each node; parents have smaller ids than their children.
std::vector<Pool> FillPools(
  const RadianceSolution& solution, const std::vector<std::uint32_t>& hits)
{
  std::vector<Pool> pools(solution.elements.size());
  for (NodeIndex id = static_cast<NodeIndex>(pools.size()); id-- > 0;)
  {
    const RadianceSolution::Element& element = solution.elements[id];
    if (element.childCount == 0)
    {
      pools[id] = { hits[id], element.area };
    }
    for (NodeIndex c = element.firstChild; c < element.EndOfChildren(); ++c)
    {
      if (!pools[c].IsFull())
      {
        pools[id].hits += pools[c].hits;
        pools[id].area += pools[c].area;
      }
    }
  }
  return pools;
}

/// The pool of each node: its own, or that of the nearest node above it that is full or a root.
std::vector<NodeIndex> PoolOfEach(const RadianceSolution& solution, const std::vector<Pool>& pools)
{
  std::vector<NodeIndex> poolOf(pools.size());
  for (NodeIndex id = 0; id < poolOf.size(); ++id)
  {
    poolOf[id] = id;
  }
  for (NodeIndex id = 0; id < poolOf.size(); ++id)
  {
    const RadianceSolution::Element& element = solution.elements[id];
    for (NodeIndex c = element.firstChild; c < element.EndOfChildren(); ++c)
    {
      poolOf[c] = pools[c].IsFull() ? c : poolOf[id];
    }
  }
  return poolOf;
}

/// The density at half of all hits is not below it.
Pool MedianOf(std::vector<Pool> pools)
{
  std::sort(pools.begin(), pools.end(),
    [](const Pool& a, const Pool& b) { return a.hits * b.area < b.hits * a.area; });
  std::uint64_t left = 0;
  for (const Pool& pool : pools)
  {
    left += pool.hits;
  }
  left /= 2;
  for (const Pool& pool : pools)
  {
    if (pool.hits > left)
    {
      return pool;
    }
    left -= pool.hits;
  }
  return {};
}

} // namespace

std::vector<bool> FindMetOften(
  const RadianceSolution& solution, const std::vector<std::uint32_t>& hits)
{
  const std::vector<Pool> pools = FillPools(solution, hits);
  const std::vector<NodeIndex> poolOf = PoolOfEach(solution, pools);
  std::vector<Pool> used;
  for (NodeIndex id = 0; id < pools.size(); ++id)
  {
    if (poolOf[id] == id && pools[id].hits > 0)
    {
      used.push_back(pools[id]);
    }
  }
  const Pool median = MedianOf(std::move(used));
  std::vector<bool> isMet(pools.size());
  for (NodeIndex id = 0; id < pools.size(); ++id)
  {
    const Pool& pool = pools[poolOf[id]];
    isMet[id] = pool.hits > 0 && pool.hits * median.area >= LeastDensity * median.hits * pool.area;
  }
  return isMet;
}

} // namespace vantage
