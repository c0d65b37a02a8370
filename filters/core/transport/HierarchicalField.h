#pragma once

#include "core/mesh/ElementTree.h"

#include <vector>

/// \file HierarchicalField.h
/// A colour received all over the patches and elements, at many levels at once.

namespace vantage
{

/// What the nodes of patches have received, each as a constant over its area. A node's mean is all
/// that its ancestors and itself received, plus the mean of what its descendants received.
/// Receiving and reading walk one path up the tree, O(level): there is no push-pull pass, so that
/// single interactions can be shot. Clusters do not receive.
///
/// Beside the mean of what is received there is the mean of what is reflected of it, where every
/// leaf has a weight of its own (see Closure.h): the mean of a product is not the product of means.
class HierarchicalField
{
public:
  /// Makes room for the nodes the tree has now; new ones have the weight 1.
  void Follow(const ElementTree& tree);

  /// Forgets what was received; weights stay.
  void Clear();

  /// Sets the weights of the leaves of a patch (of other nodes: mean over their leaves);
  /// `weights` is indexed by node. O(nodes of the patch). \pre the patch is not split any more
  void SetWeights(const ElementTree& tree, NodeId patch, const std::vector<double>& weights);

  /// Adds an amount, constant over the node.
  void Receive(const ElementTree& tree, NodeId node, const Color& amount);

  /// Mean over the node of what was received.
  Color Received(const ElementTree& tree, NodeId node) const
  {
    return this->Below[node] + this->OwnOfPath(tree, node);
  }

  /// Mean over the node of weight times what was received.
  Color Weighted(const ElementTree& tree, NodeId node) const
  {
    return this->WeightedBelow[node] + this->Weights[node] * this->OwnOfPath(tree, node);
  }

  double Weight(NodeId node) const { return this->Weights[node]; }

  std::size_t Bytes() const;

private:
  Color OwnOfPath(const ElementTree& tree, NodeId node) const
  {
    Color sum = this->Own[node];
    while (tree[node].level > 0)
    {
      node = tree[node].parent;
      sum += this->Own[node];
    }
    return sum;
  }

  std::vector<Color> Own;           ///< received by the node itself
  std::vector<Color> Below;         ///< mean of what its descendants received
  std::vector<Color> WeightedBelow; ///< the same, weighted
  std::vector<double> Weights;      ///< mean over the leaves below
};

/// The nodes of a patch: itself and all elements below, parents before children.
std::vector<NodeId> NodesOfPatch(const ElementTree& tree, NodeId patch);

} // namespace vantage
