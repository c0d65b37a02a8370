#pragma once

#include "core/goal/Flow.h"
#include "core/goal/HiddenLight.h"

#include <vector>

/// \file LinkErrors.h
/// What the links that exist do not know, as an error of the view.

namespace vantage
{

/// The error that a gathered picture has from its solution, as the sum of the absolute errors of
/// its pixels. Its parts, by how they add up:
///
/// - What a few rays cannot know of the throughput of two surfaces is random, and independent from
///   link to link: squares add.
/// - What cluster links do not know is of one sign: radiance and importance both lie where the view
///   is, and their means over clusters say less than that. So these parts add up as they are, and
///   with them the lamps in clusters, which light what the eye sees without being known by name. Of
///   parts of curved surfaces it is only what varies over them.
/// - That radiance, or importance, varies within an end where the kernel or the visibility vary as
///   well has the same sign for all links of that end: mean(L P) is not mean(L) mean(P). These add
///   up over the links of a node, at either end; over the nodes partly so, and partly as squares.
///
/// Where links with clusters have missed most of what a surface sees, as between the slats of a
/// louvre, the closure multiplies what they have found by the factors d of both ends
/// (RowClosure.h), and with it what they do not know.
///
/// The factors were measured: see the source.
class LinkErrors
{
public:
  LinkErrors() = default;
  /// `hidden` says what is to be expected of links that no ray has got through. O(links + nodes).
  LinkErrors(const OpenTree& tree, const std::vector<Link>& links, const Flow& radiance,
    const Flow& importance, const Closure& closure, const HiddenLight& hidden = {});

  /// Estimated absolute error, in the unit of the view flux.
  double All() const { return this->OfAll; }
  /// Of each link: by how much the square of All() would fall without its part.
  const std::vector<double>& OfLinks() const { return this->Losses; }

  /// Makes room for new nodes: they have received what their parent has, and know their sources.
  void Follow(const OpenTree& tree, const Flow& radiance, const Flow& importance);
  /// About what OfLinks() is going to have for a link that was made since. \pre Follow
  double Expected(const OpenTree& tree, const Link& link, const HiddenLight& hidden) const;

  std::size_t Bytes() const;

private:
  /// What the parts of links need to know of a node, means of channels.
  struct NodeValues
  {
    double radiance = 0.0;
    double radianceSpread = 0.0;
    double importance = 0.0; ///< received
    double importanceSpread = 0.0;
    double emission = 0.0;
    double straight = 0.0;           ///< part of the importance that came over one reflection
    double sourceOfImportance = 0.0; ///< root mean square
    OfKinds<double> closure{};
    bool isSurface = false;  ///< flat or curved: its lamps have names
    double atReceiver = 0.0; ///< sums over its links
    double atShooter = 0.0;
  };
  struct Parts;

  Parts PartsOf(const OpenTree& tree, const Link& link, const HiddenLight& hidden) const;
  double Closed(const Link& link, LinkKind kind) const;
  double LossWithout(const Link& link, const Parts& parts) const;

  std::vector<NodeValues> Nodes;
  double SumOfClusters = 0.0; ///< over all links
  double SumOfNodes = 0.0;
  std::vector<double> Losses;
  double OfAll = 0.0;
};

} // namespace vantage
