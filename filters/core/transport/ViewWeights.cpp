#include "core/transport/ViewWeights.h"

#include <algorithm>

namespace vantage
{

void ViewWeights::Set(const ElementTree& tree, std::vector<ViewSample> samples)
{
  this->Samples = std::move(samples);
  std::stable_sort(this->Samples.begin(), this->Samples.end(),
    [](const ViewSample& a, const ViewSample& b) { return a.patch < b.patch; });
  this->Ranges.assign(tree.Size(), Range{});
  this->Weights.assign(tree.Size(), 0.0);
  for (std::size_t first = 0; first < this->Samples.size();)
  {
    const PatchId patch = this->Samples[first].patch;
    std::size_t last = first;
    while (last < this->Samples.size() && this->Samples[last].patch == patch)
    {
      ++last;
    }
    this->Weigh(tree.Patches()[patch].node, { first, last });
    first = last;
  }
  // Parents come before their children, so one loop reaches every level.
  for (NodeId node = 0; node < tree.Size(); ++node)
  {
    if (!tree[node].IsCluster() && !tree[node].IsLeaf())
    {
      this->HandDown(tree, node);
    }
  }
}

void ViewWeights::FollowSplit(const ElementTree& tree, NodeId node)
{
  this->Ranges.resize(tree.Size());
  this->Weights.resize(tree.Size(), 0.0);
  this->HandDown(tree, node);
}

std::size_t ViewWeights::Bytes() const
{
  return this->Samples.capacity() * sizeof(ViewSample) + this->Ranges.capacity() * sizeof(Range) +
         this->Weights.capacity() * sizeof(double);
}

void ViewWeights::HandDown(const ElementTree& tree, NodeId node)
{
  const Range range = this->Ranges[node];
  if (range.first == range.last)
  {
    return;
  }
  const NodeId child = tree[node].firstChild;
  std::size_t first = range.first;
  for (NodeId c = child; c < child + tree[node].childCount; ++c)
  {
    const auto middle =
      std::stable_partition(this->Samples.begin() + first, this->Samples.begin() + range.last,
        [&](const ViewSample& s) { return tree.ChildContaining(node, s.point) == c; });
    const std::size_t last = static_cast<std::size_t>(middle - this->Samples.begin());
    this->Weigh(c, { first, last });
    first = last;
  }
}

void ViewWeights::Weigh(NodeId node, Range range)
{
  this->Ranges[node] = range;
  double sum = 0.0;
  for (std::size_t s = range.first; s < range.last; ++s)
  {
    sum += this->Samples[s].weight;
  }
  this->Weights[node] = sum;
}

} // namespace vantage
