#include "core/goal/Flow.h"

#include <algorithm>
#include <cmath>

namespace vantage
{

namespace
{

/// Bounds of ScaleOfReceived().
constexpr double LargestScale = 8.0;

} // namespace

void Flow::Follow(const OpenTree& tree)
{
  for (OpenId id = static_cast<OpenId>(this->Values.size()); id < tree.Size(); ++id)
  {
    const OpenId parent = tree[id].parent;
    this->Sources.emplace_back(0.0);
    this->SourceRms.push_back(0.0);
    this->Values.push_back(parent == None ? Color(0.0) : Color(this->Values[parent]));
    this->Weighted.push_back(parent == None ? Color(0.0) : Color(this->Weighted[parent]));
    this->Incoming.push_back(parent == None ? Color(0.0) : Color(this->Incoming[parent]));
    this->Spreads.push_back(0.0);
  }
}

void Flow::Clear()
{
  for (std::size_t i = 0; i < this->Values.size(); ++i)
  {
    this->Values[i] = this->Weighted[i] = this->Sources[i];
    this->Spreads[i] = 0.0;
  }
}

double Flow::Sweep(const LinkMatrix& matrix, const std::vector<double>& closure, bool isBalanced)
{
  this->Incoming = matrix.Times(this->Weighted);
  const double scale = isBalanced ? this->ScaleOfReceived(matrix, closure) : 1.0;
  const double change = this->ReflectAtLeaves(matrix, closure, scale);
  matrix.AverageUp(this->Weighted);
  return change;
}

void Flow::FindStraight(const LinkMatrix& matrix, const std::vector<double>& closure)
{
  std::vector<double> weighted(matrix.Size(), 0.0);
  for (const LinkMatrix::Leaf& leaf : matrix.Leaves())
  {
    weighted[leaf.id] = closure[leaf.id] * Mean(this->Sources[leaf.id]);
  }
  matrix.AverageUp(weighted);
  this->Straight = matrix.Times(weighted);
  for (const LinkMatrix::Leaf& leaf : matrix.Leaves())
  {
    this->Straight[leaf.id] *= Mean(leaf.reflection) * closure[leaf.id];
  }
  matrix.AverageUp(this->Straight);
}

double Flow::StraightPart(OpenId id) const
{
  const double received = Mean(this->Received(id));
  return received > 0.0 ? std::clamp(this->Straight[id] / received, 0.0, 1.0) : 0.0;
}

/// s for which s v = source + s T v in the sum over all.
double Flow::ScaleOfReceived(const LinkMatrix& matrix, const std::vector<double>& closure) const
{
  double source = 0.0;
  double missing = 0.0;
  for (const LinkMatrix::Leaf& leaf : matrix.Leaves())
  {
    const Color received = leaf.reflection * closure[leaf.id] * this->Incoming[leaf.id];
    source += leaf.area * Mean(this->Sources[leaf.id]);
    missing += leaf.area * Mean(this->Values[leaf.id] - received);
  }
  return missing > 0.0 ? std::clamp(source / missing, 1.0 / LargestScale, LargestScale) : 1.0;
}

double Flow::ReflectAtLeaves(
  const LinkMatrix& matrix, const std::vector<double>& closure, double scale)
{
  double change = 0.0;
  double total = 0.0;
  for (const auto& [id, area, reflection] : matrix.Leaves())
  {
    this->Incoming[id] *= scale * closure[id];
    const Color value = this->Sources[id] + reflection * this->Incoming[id];
    change += area * std::abs(Mean(value - this->Values[id]));
    total += area * Mean(value);
    this->Values[id] = value;
    this->Weighted[id] = closure[id] * value;
  }
  return total > 0.0 ? change / total : 0.0;
}

/// What a cluster received may have come to a part of it only, and not to where its sources are.
double Flow::SpreadOfCluster(OpenId leaf) const
{
  const double rms = this->SourceRms[leaf];
  const double mean = Mean(this->Sources[leaf]);
  const double ofSource = std::sqrt(std::max(0.0, rms * rms - mean * mean));
  return std::hypot(ofSource, Mean(this->Received(leaf)));
}

void Flow::FindSpreads(
  const OpenTree& tree, const LinkMatrix& matrix, const std::vector<Link>& links)
{
  matrix.AverageUp(this->Sources);
  matrix.AverageUp(this->Values);
  // Of what arrives at each node: the variance, and the deviation by shadows, which all may fall on
  // the same part.
  std::vector<double> variances(tree.Size(), 0.0);
  std::vector<double> shadows(tree.Size(), 0.0);
  for (const Link& link : links)
  {
    for (int end = 0; end < (link.IsSelf() ? 1 : 2); ++end)
    {
      const OpenId to = link.ends[end];
      const double weighted = Mean(this->Weighted[link.ends[1 - end]]) / tree[to].area;
      const double deviation = link.variation * weighted;
      variances[to] += deviation * deviation;
      shadows[to] += link.shadowing * weighted;
    }
  }
  for (OpenId id = 0; id < tree.Size(); ++id)
  {
    const OpenNode& node = tree[id];
    if (id > 0)
    {
      variances[id] += variances[node.parent];
      shadows[id] += shadows[node.parent];
    }
    if (node.IsLeaf())
    {
      this->Spreads[id] = node.IsCluster()
                            ? this->SpreadOfCluster(id)
                            : Mean(node.albedo) / Pi * (std::sqrt(variances[id]) + shadows[id]);
    }
  }
  this->PullUpSpreads(tree);
}

void Flow::PullUpSpreads(const OpenTree& tree)
{
  for (OpenId id = tree.Size(); id-- > 0;)
  {
    const OpenNode& node = tree[id];
    if (node.IsLeaf())
    {
      continue;
    }
    double square = 0.0;
    double sourceSquare = 0.0;
    double area = 0.0;
    for (OpenId c = node.firstChild; c < node.firstChild + node.childCount; ++c)
    {
      const double childArea = tree[c].area;
      const double mean = Mean(this->Values[c]);
      area += childArea;
      sourceSquare += childArea * this->SourceRms[c] * this->SourceRms[c];
      square += childArea * (mean * mean + this->Spreads[c] * this->Spreads[c]);
    }
    if (area > 0.0)
    {
      const double mean = Mean(this->Values[id]);
      this->SourceRms[id] = std::sqrt(sourceSquare / area);
      this->Spreads[id] = std::sqrt(std::max(0.0, square / area - mean * mean));
    }
  }
}

std::size_t Flow::Bytes() const
{
  return this->Values.capacity() * (4 * sizeof(Color) + 3 * sizeof(double));
}

} // namespace vantage
