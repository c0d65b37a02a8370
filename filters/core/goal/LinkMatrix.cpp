#include "core/goal/LinkMatrix.h"

#include <numeric>

namespace vantage
{

LinkMatrix::LinkMatrix(const OpenTree& tree, const std::vector<Link>& links)
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
  this->Parents.reserve(tree.Size());
  this->Areas.reserve(tree.Size());
  for (OpenId id = 0; id < tree.Size(); ++id)
  {
    const OpenNode& node = tree[id];
    this->Parents.push_back(node.parent);
    this->Areas.push_back(node.area);
    if (node.IsLeaf())
    {
      this->AllLeaves.push_back({ id, node.area, node.albedo / Pi });
    }
  }
  for (OpenId id = tree.Size(); id-- > 0;)
  {
    const OpenNode& node = tree[id];
    const OpenId end = node.firstChild + node.childCount;
    const double area = node.IsLeaf() ? 0.0
                                      : std::accumulate(this->Areas.begin() + node.firstChild,
                                          this->Areas.begin() + end, 0.0);
    if (area > 0.0)
    {
      this->Inners.push_back({ id, node.firstChild, end, area });
    }
  }
}

} // namespace vantage
