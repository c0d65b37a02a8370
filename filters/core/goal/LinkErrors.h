#pragma once

#include "core/goal/Flow.h"
#include "core/goal/HiddenLight.h"

#include <vector>

/// \file LinkErrors.h
/// What the links that exist do not know, as an error of the view.

namespace vantage
{

struct LinkErrors
{
  /// Of each link: the root of what the square of the error would lose without this link's part.
  std::vector<double> ofLink;
  double all = 0.0; ///< of all links, in the unit of the view flux: estimated absolute error
};

/// The error that a gathered picture has from its solution, as the sum of the absolute errors of
/// its pixels. Its parts, by how they add up:
///
/// - What a few rays cannot know of the throughput of two surfaces is random, and independent from
///   link to link: squares add.
/// - What cluster links do not know is of one sign: radiance and importance both lie where the view
///   is, and their means over clusters say less than that. So these parts add up as they are, and
///   with them the lamps in clusters, which light what the eye sees without being known by name.
/// - That radiance, or importance, varies within an end where the kernel or the visibility vary as
///   well has the same sign for all links of that end: mean(L P) is not mean(L) mean(P). These add
///   up over the links of a node, at either end; over the nodes partly so, and partly as squares.
///
/// `hidden` says what is to be expected of links that no ray has got through. The factors were
/// measured: see the source. O(links + nodes).
LinkErrors EstimateLinkErrors(const OpenTree& tree, const std::vector<Link>& links,
  const Flow& radiance, const Flow& importance, const HiddenLight& hidden = {});

} // namespace vantage
