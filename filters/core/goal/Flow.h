#pragma once

#include "core/goal/LinkMatrix.h"

#include <vector>

/// \file Flow.h
/// One of the two quantities that travel over the links: radiance, or reflected importance.

namespace vantage
{

/// Spread of a cluster that nobody looked into: what it received may have come to a part of it
/// only, and not to where its sources are, of which the mean and the root mean square are known. On
/// a curved surface it varies as the normals do: by half of the bend, measured as
/// UnevennessOfCurved() was (LinkEvaluator.cpp).
double SpreadOfCluster(const Node& cluster, double source, double rmsOfSource, double received);

/// Both obey the same equation, so this is written once. On every leaf i
///
///     value_i = source_i + albedo_i / pi * sum over links of d_i F_ik (d value)_k
///
/// where radiance L has the source E, and reflected importance Y = albedo / pi * P has the source
/// albedo / pi * V. d is the closure of the links' kind (RowClosure.h), 1 where there is none. What
/// a link brings is constant over its end and reaches all leaves below it; what a link takes is the
/// mean. Nodes that rest, of which the matrix has no rows, keep all that was found for them.
class Flow
{
public:
  /// Makes room for new nodes; they start with what their parent has.
  void Follow(const OpenTree& tree);

  /// One sweep over all links (Jacobi): the values on the right are those of the last sweep.
  /// Returns the largest change of area times value of all leaves, relative to the sum of it.
  /// O(links + nodes).
  /// `isBalanced` multiplies all that is received by the factor with which it balances the sources
  /// in the sum over all leaves: of the error, that takes away what is the same everywhere, which
  /// falls by the albedo only (aggregation to one unknown).
  double Sweep(const LinkMatrix& matrix, const Closure& closure, bool isBalanced = false);

  /// Finds what came from the sources at one go, for StraightPart(). O(links + nodes).
  void FindStraight(const LinkMatrix& matrix, const Closure& closure);

  /// Finds the means of inner nodes and how unevenly the values lie within nodes, for Spread().
  /// `links` are those of the matrix. O(links + nodes). \pre Sweep
  void FindSpreads(const OpenTree& tree, const LinkMatrix& matrix, const std::vector<Link>& links);

  /// Means over the nodes, weighted by area. \pre FindSpreads, but for leaves
  const Color& Value(OpenId id) const { return this->Values[id]; }
  /// The mean of d times value, d that of a kind of links.
  const Color& Weighted(LinkKind kind, OpenId id) const { return this->WeightedValues[kind][id]; }
  /// Standard deviation of the mean channel over the node: between the leaves below, and within
  /// them as the variation of their links tells, and, of clusters, SpreadOfCluster().
  /// \pre FindSpreads
  double Spread(OpenId id) const { return this->Spreads[id]; }

  /// Of a leaf; `rms` is the root mean square of the mean channel over it: how unevenly it lies
  /// there.
  void SetSource(OpenId id, const Color& source, double rms = 0.0)
  {
    this->Sources[id] = source;
    this->SourceRms[id] = rms;
  }
  /// Of any node. \pre FindSpreads, but for leaves
  double RmsOfSource(OpenId id) const { return this->SourceRms[id]; }
  const Color& Source(OpenId id) const { return this->Sources[id]; }
  /// What came over links: Value - Source; nothing before the first sweep. \pre FindSpreads, but
  /// for leaves
  Color Received(OpenId id) const
  {
    return glm::max(this->Values[id] - this->Sources[id], Color(0.0));
  }

  /// Of the mean channel of Received(), the part in [0, 1] that has been reflected once only: it
  /// came straight from a source. \pre FindStraight
  double StraightPart(OpenId id) const;

  /// What arrives at a leaf: irradiance H, or P - V.
  const Color& Arriving(OpenId leaf) const { return this->Incoming[leaf]; }

  void Clear();
  std::size_t Bytes() const;

private:
  double ScaleOfReceived(const LinkMatrix& matrix) const;
  double ReflectAtLeaves(const LinkMatrix& matrix, const Closure& closure, double scale);
  void PullUpSpreads(const OpenTree& tree, const LinkMatrix& matrix);

  std::vector<Color> Sources; ///< of each node
  std::vector<double> SourceRms;
  std::vector<Color> Values;
  OfKinds<std::vector<Color>> WeightedValues; ///< d times value, mean
  std::vector<Color> Incoming;                ///< of leaves: irradiance, times d
  std::vector<double> Spreads;
  std::vector<double> Straight; ///< see StraightPart(), mean channel
};

} // namespace vantage
