#include "core/goal/Flow.h"

#include <algorithm>
#include <cmath>

namespace vantage
{

namespace
{

/// Bounds of ScaleOfReceived().
constexpr double LargestScale = 8.0;
/// Of what a curved surface has received, over its bend.
constexpr double SpreadOfBend = 0.5;

/// At the leaves, sum over all links of d_i F_ik (d value)_k.
template <typename T>
std::vector<T> Gathered(
  const LinkMatrix& matrix, const Closure& closure, const OfKinds<std::vector<T>>& weighted)
{
  std::vector<T> received(matrix.Size(), T(0.0));
  for (const LinkKind kind : LinkKinds)
  {
    const std::vector<T> sums = matrix.Times(kind, weighted[kind]);
    for (const LinkMatrix::Leaf& leaf : matrix.Leaves())
    {
      received[leaf.id] += closure[kind][leaf.id] * sums[leaf.id];
    }
  }
  return received;
}

} // namespace

double SpreadOfCluster(const Node& cluster, double source, double rmsOfSource, double received)
{
  const double ofSource = std::sqrt(std::max(0.0, rmsOfSource * rmsOfSource - source * source));
  const double part = cluster.IsSmooth() ? SpreadOfBend * cluster.Bend() : 1.0;
  return std::hypot(ofSource, part * received);
}

void Flow::Follow(const OpenTree& tree)
{
  for (OpenId id = static_cast<OpenId>(this->Values.size()); id < tree.Size(); ++id)
  {
    const OpenId parent = tree[id].parent;
    this->Sources.emplace_back(0.0);
    this->SourceRms.push_back(0.0);
    this->Values.push_back(parent == None ? Color(0.0) : Color(this->Values[parent]));
    for (std::vector<Color>& weighted : this->WeightedValues)
    {
      weighted.push_back(parent == None ? Color(0.0) : Color(weighted[parent]));
    }
    this->Incoming.push_back(parent == None ? Color(0.0) : Color(this->Incoming[parent]));
    this->Spreads.push_back(parent == None ? 0.0 : this->Spreads[parent]);
    this->Straight.push_back(parent == None ? 0.0 : this->Straight[parent]);
  }
}

void Flow::Clear()
{
  this->Values = this->Sources;
  this->WeightedValues = { this->Sources, this->Sources };
  std::fill(this->Spreads.begin(), this->Spreads.end(), 0.0);
}

double Flow::Sweep(const LinkMatrix& matrix, const Closure& closure, bool isBalanced)
{
  const std::vector<Color> incoming = Gathered(matrix, closure, this->WeightedValues);
  for (const LinkMatrix::Leaf& leaf : matrix.Leaves())
  {
    this->Incoming[leaf.id] = incoming[leaf.id];
  }
  const double scale = isBalanced ? this->ScaleOfReceived(matrix) : 1.0;
  const double change = this->ReflectAtLeaves(matrix, closure, scale);
  for (std::vector<Color>& weighted : this->WeightedValues)
  {
    matrix.AverageUp(weighted);
  }
  return change;
}

void Flow::FindStraight(const LinkMatrix& matrix, const Closure& closure)
{
  OfKinds<std::vector<double>> weighted;
  for (const LinkKind kind : LinkKinds)
  {
    weighted[kind].resize(matrix.Size());
    for (OpenId id = 0; id < matrix.Size(); ++id)
    {
      weighted[kind][id] = closure[kind][id] * Mean(this->Sources[id]);
    }
    matrix.AverageUp(weighted[kind]);
  }
  const std::vector<double> incoming = Gathered(matrix, closure, weighted);
  for (const LinkMatrix::Leaf& leaf : matrix.Leaves())
  {
    this->Straight[leaf.id] = incoming[leaf.id] * Mean(leaf.reflection);
  }
  matrix.AverageUp(this->Straight);
}

double Flow::StraightPart(OpenId id) const
{
  const double received = Mean(this->Received(id));
  return received > 0.0 ? std::clamp(this->Straight[id] / received, 0.0, 1.0) : 0.0;
}

/// s for which s v = source + s T v in the sum over all.
double Flow::ScaleOfReceived(const LinkMatrix& matrix) const
{
  double source = 0.0;
  double missing = 0.0;
  for (const auto& [id, area, reflection] : matrix.Leaves())
  {
    source += area * Mean(this->Sources[id]);
    missing += area * Mean(this->Values[id] - reflection * this->Incoming[id]);
  }
  return missing > 0.0 ? std::clamp(source / missing, 1.0 / LargestScale, LargestScale) : 1.0;
}

double Flow::ReflectAtLeaves(const LinkMatrix& matrix, const Closure& closure, double scale)
{
  double change = 0.0;
  double total = 0.0;
  for (const auto& [id, area, reflection] : matrix.Leaves())
  {
    this->Incoming[id] *= scale;
    const Color value = this->Sources[id] + reflection * this->Incoming[id];
    change += area * std::abs(Mean(value - this->Values[id]));
    total += area * Mean(value);
    this->Values[id] = value;
    for (const LinkKind kind : LinkKinds)
    {
      this->WeightedValues[kind][id] = closure[kind][id] * value;
    }
  }
  return total > 0.0 ? change / total : 0.0;
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
    const std::vector<Color>& values = this->WeightedValues[KindOf(tree, link)];
    for (int end = 0; end < (link.IsSelf() ? 1 : 2); ++end)
    {
      const OpenId to = link.ends[end];
      const double weighted = Mean(values[link.ends[1 - end]]) / tree[to].area;
      const double deviation = link.variation * weighted;
      variances[to] += deviation * deviation;
      shadows[to] += link.shadowing * weighted;
    }
  }
  for (const auto& [id, parent] : matrix.Rows())
  {
    const OpenNode& node = tree[id];
    if (parent != None)
    {
      variances[id] += variances[parent];
      shadows[id] += shadows[parent];
    }
    if (node.IsLeaf())
    {
      const double ofLinks = Mean(node.albedo) / Pi * (std::sqrt(variances[id]) + shadows[id]);
      const double ofCluster = node.IsCluster()
                                 ? SpreadOfCluster(tree.Geometry(id), Mean(this->Sources[id]),
                                     this->SourceRms[id], Mean(this->Received(id)))
                                 : 0.0;
      this->Spreads[id] = std::hypot(ofLinks, ofCluster);
    }
  }
  this->PullUpSpreads(tree, matrix);
}

void Flow::PullUpSpreads(const OpenTree& tree, const LinkMatrix& matrix)
{
  for (auto row = matrix.Rows().rbegin(); row != matrix.Rows().rend(); ++row)
  {
    const OpenId id = row->id;
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
  return this->Values.capacity() * (5 * sizeof(Color) + 3 * sizeof(double));
}

} // namespace vantage
