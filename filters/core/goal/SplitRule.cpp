#include "core/goal/SplitRule.h"

#include "core/mesh/LongestEdge.h"

#include <algorithm>
#include <cmath>

namespace vantage
{

namespace
{

/// Radii that differ by less, relatively, are the same but for the rounding of coordinates.
constexpr double SameSize = 1e-6;

} // namespace

void SplitRule::Follow(const OpenTree& tree)
{
  for (auto id = static_cast<OpenId>(this->MaySplit.size()); id < tree.Size(); ++id)
  {
    this->MaySplit.push_back(this->IsLargeEnough(tree, id));
  }
}

bool SplitRule::IsLargeEnough(const OpenTree& tree, OpenId id) const
{
  const OpenNode& node = tree[id];
  return node.IsCluster() || (node.level < this->MaximumLevel &&
                               0.5 * LongestEdge(tree.Geometry(id)) >= this->MinimumLength);
}

std::array<bool, 2> SplitRule::EndsToSplit(const OpenTree& tree, const Link& link) const
{
  const auto [a, b] = link.ends;
  if (link.IsSelf())
  {
    return { true, true };
  }
  const std::array<bool, 2> may{ this->MaySplit[a], this->MaySplit[b] };
  const double first = tree.Geometry(a).radius;
  const double second = tree.Geometry(b).radius;
  const bool isClusterFirst = tree[a].IsCluster();
  const bool isClusterSecond = tree[b].IsCluster();
  if (isClusterFirst != isClusterSecond)
  {
    // A surface sees the surfaces in a cluster, whatever the sizes: lamps are to get their names.
    return { isClusterFirst, isClusterSecond };
  }
  if (!may[0] || !may[1] || (!isClusterFirst && std::abs(first - second) <= SameSize * first))
  {
    return may;
  }
  return { first >= second, first < second };
}

} // namespace vantage
