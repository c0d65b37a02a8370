#include "core/goal/RowClosure.h"

#include <algorithm>
#include <cmath>

namespace vantage
{

namespace
{

/// Some ten are enough, unless rows cannot be closed within the bounds of the factors.
constexpr int MostIterations = 24;
/// Three quarters of the way to a factor, in its logarithm. As the other ends move as well, half of
/// it would be right where all of them lack the same; where every second one has too much, less is
/// left of a step.
double Step(double factor)
{
  const double half = std::sqrt(factor);
  return half * std::sqrt(half);
}

constexpr double Tolerance = 1e-5;
constexpr double SmallestFactor = 0.02;
/// A coarse row may have next to nothing: rays between clusters have missed what its element sees.
constexpr double LargestFactor = 64.0;

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

/// What the links say of rows and no more, as closing goes over them again and again.
class Rows
{
public:
  Rows(const OpenTree& tree, const std::vector<Link>& links)
    : Tree(tree)
  {
    this->Entries.reserve(links.size());
    for (const Link& link : links)
    {
      if (link.throughput > 0.0)
      {
        const auto [a, b] = link.ends;
        this->Entries.push_back({ a, b, link.throughput / tree[a].area,
          link.IsSelf() ? 0.0 : link.throughput / tree[b].area });
      }
    }
  }

  std::vector<double> Sums(const std::vector<double>& factors) const
  {
    std::vector<double> sums(this->Tree.Size(), 0.0);
    for (const Entry& entry : this->Entries)
    {
      sums[entry.a] += entry.ofA * factors[entry.b];
      sums[entry.b] += entry.ofB * factors[entry.a];
    }
    for (OpenId id = 1; id < this->Tree.Size(); ++id)
    {
      sums[id] += sums[this->Tree[id].parent];
    }
    return sums;
  }

private:
  struct Entry
  {
    OpenId a, b;
    double ofA, ofB; ///< F_ab and F_ba
  };

  const OpenTree& Tree;
  std::vector<Entry> Entries;
};

} // namespace

std::vector<double> RowSums(
  const OpenTree& tree, const std::vector<Link>& links, const std::vector<double>& factors)
{
  return Rows(tree, links).Sums(factors);
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
  const Rows rows(tree, links);
  const std::vector<double> raw = rows.Sums(std::vector<double>(tree.Size(), 1.0));
  AverageUp(tree, closure);
  for (int iteration = 0; iteration < MostIterations; ++iteration)
  {
    const std::vector<double> sums = rows.Sums(closure);
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
      const double needed = target / (closure[id] * sums[id]);
      const double factor = std::clamp(closure[id] * Step(needed), SmallestFactor, largest);
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
