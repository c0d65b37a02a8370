#pragma once

#include "core/goal/OpenTree.h"

#include <array>
#include <cstdint>

/// \file Link.h
/// A hierarchical interaction.

namespace vantage
{

/// Two nodes that exchange light, or a node with itself (all that its parts exchange). One
/// throughput serves both directions.
struct Link
{
  std::array<OpenId, 2> ends;
  double throughput = 0.0; ///< G, m^2 sr, visibility included
  double visibility = 1.0; ///< visible fraction
  /// How far the throughput itself may be off, m^2 sr: what a few rays cannot know.
  double uncertainty = 0.0;
  /// How far the throughput between parts of the ends is from what the mean says, m^2 sr: that the
  /// kernel varies over the ends ... With a cluster at an end, it is 0, as nothing is known, unless
  /// both are surfaces, if curved ones: then it tells of the visibility as well.
  double variation = 0.0;
  double shadowing = 0.0; ///< ... or their visibility
  /// Rays that found the same, all free or all hidden, down the chain of ancestors to here; 0 where
  /// they disagreed.
  std::uint32_t agreeingRays = 0;
  std::uint32_t step = 0; ///< the round in which it was made

  bool IsSelf() const { return this->ends[0] == this->ends[1]; }
};

/// Of links between surfaces, flat or curved, a few rays tell most; of those with a cluster of
/// several surfaces at an end next to nothing is certain.
enum LinkKind : std::size_t
{
  BetweenSurfaces,
  WithCluster
};
constexpr std::array<LinkKind, 2> LinkKinds{ BetweenSurfaces, WithCluster };

inline LinkKind KindOf(const OpenTree& tree, const Link& link)
{
  return tree.Geometry(link.ends[0]).IsSmooth() && tree.Geometry(link.ends[1]).IsSmooth()
           ? BetweenSurfaces
           : WithCluster;
}

/// Whether an end is a cluster, if only of the parts of one curved surface.
inline bool HasCluster(const OpenTree& tree, const Link& link)
{
  return tree[link.ends[0]].IsCluster() || tree[link.ends[1]].IsCluster();
}

} // namespace vantage
