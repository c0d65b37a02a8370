#pragma once

#include "core/mesh/ElementTree.h"

#include <vector>

/// \file ViewWeights.h
/// The importance that leaves the eye, as data: what the view layer finds, the transport uses.

namespace vantage
{

/// A piece of the image that sees one point of one patch. The weights of the samples on an element,
/// summed and divided by its area, are its V: (1/A) integral over A of cos cos_eye / r^2 vis dA.
struct ViewSample
{
  PatchId patch;
  Vec3 point;
  double weight; ///< cos_eye d omega, sr
};

/// View samples sorted into the elements that hold them, at every level.
class ViewWeights
{
public:
  /// Takes the samples of a view and sorts them down the tree as it is. O(samples * level).
  void Set(const ElementTree& tree, std::vector<ViewSample> samples);

  /// Makes room for new nodes and hands the samples of `node` down to its new children.
  void FollowSplit(const ElementTree& tree, NodeId node);

  /// V of a patch or element, sr m^-2.
  double Value(const ElementTree& tree, NodeId node) const
  {
    return this->Weights[node] / tree[node].area;
  }

  std::size_t Bytes() const;

private:
  /// Samples[first .. last) lie on the node.
  struct Range
  {
    std::size_t first = 0;
    std::size_t last = 0;
  };

  void HandDown(const ElementTree& tree, NodeId node);
  void Weigh(NodeId node, Range range);

  std::vector<ViewSample> Samples;
  std::vector<Range> Ranges;   ///< of each node
  std::vector<double> Weights; ///< of each node: sum over its range
};

} // namespace vantage
