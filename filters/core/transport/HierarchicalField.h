#pragma once

#include "core/mesh/ElementTree.h"

#include <vector>

/// \file HierarchicalField.h
/// A colour received all over the patches and elements, at many levels at once.

namespace vantage
{

/// What the nodes of patches have received, each as a constant over its area. The value of a node
/// is its area mean: all that its ancestors and itself received, plus the mean of what its
/// descendants received. Receiving and reading walk one path up the tree, O(level): there is no
/// push-pull pass, so that single interactions can be shot. Clusters do not receive.
class HierarchicalField
{
public:
  /// Makes room for the nodes the tree has now. Call after splitting.
  void Follow(const ElementTree& tree)
  {
    this->Own.resize(tree.Size(), Color(0.0));
    this->Below.resize(tree.Size(), Color(0.0));
  }

  void Clear()
  {
    this->Own.assign(this->Own.size(), Color(0.0));
    this->Below.assign(this->Below.size(), Color(0.0));
  }

  /// Adds an amount, constant over the node.
  void Receive(const ElementTree& tree, NodeId node, const Color& amount)
  {
    this->Own[node] += amount;
    const Color moment = amount * tree[node].area;
    for (NodeId n = node; tree[n].level > 0;)
    {
      n = tree[n].parent;
      this->Below[n] += moment / tree[n].area;
    }
  }

  /// Area mean over the node.
  Color Value(const ElementTree& tree, NodeId node) const
  {
    Color sum = this->Below[node] + this->Own[node];
    for (NodeId n = node; tree[n].level > 0;)
    {
      n = tree[n].parent;
      sum += this->Own[n];
    }
    return sum;
  }

  std::size_t Bytes() const
  {
    return (this->Own.capacity() + this->Below.capacity()) * sizeof(Color);
  }

private:
  std::vector<Color> Own;   ///< received by the node itself
  std::vector<Color> Below; ///< area mean of what its descendants received
};

} // namespace vantage
