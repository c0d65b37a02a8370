#include "core/goal/LinkMatrix.h"

#include <numeric>

namespace vantage
{

LinkMatrix::LinkMatrix(
  const OpenTree& tree, const std::vector<Link>& links, const std::vector<bool>& resting)
{
  for (const Link& link : links)
  {
    if (link.throughput > 0.0)
    {
      const auto [a, b] = link.ends;
      this->Entries[KindOf(tree, link)].push_back({ a, b, link.throughput / tree[a].area,
        link.IsSelf() ? 0.0 : link.throughput / tree[b].area });
    }
  }
  this->Areas.reserve(tree.Size());
  for (OpenId id = 0; id < tree.Size(); ++id)
  {
    const OpenNode& node = tree[id];
    this->Areas.push_back(node.area);
    if (!resting.empty() && resting[id])
    {
      continue;
    }
    this->AllRows.push_back({ id, node.parent });
    if (node.IsLeaf())
    {
      this->AllLeaves.push_back({ id, node.area, node.albedo / Pi });
    }
  }
  for (auto row = this->AllRows.rbegin(); row != this->AllRows.rend(); ++row)
  {
    const OpenNode& node = tree[row->id];
    const OpenId end = node.firstChild + node.childCount;
    const double area = node.IsLeaf() ? 0.0
                                      : std::accumulate(this->Areas.begin() + node.firstChild,
                                          this->Areas.begin() + end, 0.0);
    if (area > 0.0)
    {
      this->Inners.push_back({ row->id, node.firstChild, end, area });
    }
  }
}

} // namespace vantage
