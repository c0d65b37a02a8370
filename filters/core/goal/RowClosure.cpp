#include "core/goal/RowClosure.h"

#include <algorithm>
#include <cmath>

namespace vantage
{

namespace
{

/// Some twenty are enough, unless rows cannot be closed within the bounds of the factors.
constexpr int MostIterations = 64;
constexpr double Tolerance = 1e-5;
constexpr double SmallestFactor = 0.02;
constexpr double LargestFactor = 4.0;

/// What a row may sum up to.
struct Range
{
  double least;
  double most;
};

/// What the probes say.
Range RangeOf(const OpenNode& node)
{
  const double seen = 1.0 - node.escaped;
  return { Pi * std::max(0.0, seen - node.escapeError),
    Pi * std::min(1.0, seen + node.escapeError) };
}

} // namespace

std::vector<double> RowSums(
  const OpenTree& tree, const std::vector<Link>& links, const std::vector<double>& factors)
{
  std::vector<double> sums(tree.Size(), 0.0);
  for (const Link& link : links)
  {
    const auto [a, b] = link.ends;
    sums[a] += link.throughput / tree[a].area * factors[b];
    if (!link.IsSelf())
    {
      sums[b] += link.throughput / tree[b].area * factors[a];
    }
  }
  for (OpenId id = 1; id < tree.Size(); ++id)
  {
    sums[id] += sums[tree[id].parent];
  }
  return sums;
}

void AverageUp(const OpenTree& tree, std::vector<double>& factors)
{
  for (OpenId id = tree.Size(); id-- > 0;)
  {
    const OpenNode& node = tree[id];
    if (node.IsLeaf() || !node.IsExposed())
    {
      continue;
    }
    double sum = 0.0;
    for (OpenId c = node.firstChild; c < node.firstChild + node.childCount; ++c)
    {
      sum += tree[c].area * factors[c];
    }
    factors[id] = sum / node.area;
  }
}

void CloseRows(const OpenTree& tree, const std::vector<Link>& links, std::vector<double>& closure)
{
  const std::vector<double> raw = RowSums(tree, links, std::vector<double>(tree.Size(), 1.0));
  AverageUp(tree, closure);
  for (int iteration = 0; iteration < MostIterations; ++iteration)
  {
    const std::vector<double> sums = RowSums(tree, links, closure);
    double change = 0.0;
    for (OpenId id = 0; id < tree.Size(); ++id)
    {
      const OpenNode& node = tree[id];
      if (!node.IsLeaf() || !(sums[id] > 0.0))
      {
        continue;
      }
      const Range range = RangeOf(node);
      const double target = std::clamp(raw[id], range.least, range.most);
      const double largest = node.IsUnprobed() ? 1.0 : LargestFactor;
      // The square root takes half a step, as the other ends move as well.
      const double factor =
        std::clamp(std::sqrt(closure[id] * target / sums[id]), SmallestFactor, largest);
      change = std::max(change, std::abs(factor - closure[id]));
      closure[id] = factor;
    }
    AverageUp(tree, closure);
    if (change < Tolerance)
    {
      break;
    }
  }
}

} // namespace vantage
