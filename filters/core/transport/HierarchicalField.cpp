#include "core/transport/HierarchicalField.h"

namespace vantage
{

void HierarchicalField::Follow(const ElementTree& tree)
{
  this->Own.resize(tree.Size(), Color(0.0));
  this->Below.resize(tree.Size(), Color(0.0));
  this->WeightedBelow.resize(tree.Size(), Color(0.0));
  this->Weights.resize(tree.Size(), 1.0);
}

void HierarchicalField::Clear()
{
  this->Own.assign(this->Own.size(), Color(0.0));
  this->Below.assign(this->Below.size(), Color(0.0));
  this->WeightedBelow.assign(this->WeightedBelow.size(), Color(0.0));
}

void HierarchicalField::SetWeights(
  const ElementTree& tree, NodeId patch, const std::vector<double>& weights)
{
  const std::vector<NodeId> nodes = NodesOfPatch(tree, patch);
  for (auto node = nodes.rbegin(); node != nodes.rend(); ++node)
  {
    const Node& n = tree[*node];
    if (n.IsLeaf())
    {
      this->Weights[*node] = weights[*node];
      continue;
    }
    this->Weights[*node] = 0.0;
    this->WeightedBelow[*node] = Color(0.0);
    for (NodeId c = n.firstChild; c < n.firstChild + n.childCount; ++c)
    {
      const double share = tree[c].area / n.area;
      this->Weights[*node] += share * this->Weights[c];
      this->WeightedBelow[*node] +=
        share * (this->WeightedBelow[c] + this->Weights[c] * this->Own[c]);
    }
  }
}

void HierarchicalField::Receive(const ElementTree& tree, NodeId node, const Color& amount)
{
  this->Own[node] += amount;
  const Color moment = amount * tree[node].area;
  const Color weighted = moment * this->Weights[node];
  while (tree[node].level > 0)
  {
    node = tree[node].parent;
    this->Below[node] += moment / tree[node].area;
    this->WeightedBelow[node] += weighted / tree[node].area;
  }
}

std::size_t HierarchicalField::Bytes() const
{
  return (this->Own.capacity() + this->Below.capacity() + this->WeightedBelow.capacity()) *
           sizeof(Color) +
         this->Weights.capacity() * sizeof(double);
}

std::vector<NodeId> NodesOfPatch(const ElementTree& tree, NodeId patch)
{
  std::vector<NodeId> nodes{ patch };
  for (std::size_t i = 0; i < nodes.size(); ++i)
  {
    const Node& node = tree[nodes[i]];
    for (NodeId c = node.firstChild; c < node.firstChild + node.childCount; ++c)
    {
      nodes.push_back(c);
    }
  }
  return nodes;
}

} // namespace vantage
