#pragma once

#include "core/goal/Flow.h"

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
/// its pixels. Four kinds, by how they add up:
///
/// - What a few rays and points cannot know of a throughput is random, and independent from link to
///   link: squares add.
/// - That radiance, or importance, varies within an end where the kernel or the visibility vary as
///   well has the same sign for all links of that end: mean(L P) is not mean(L) mean(P). So these
///   add up over the links of a node, at either end, and their squares over the nodes.
/// - Lamps in clusters light what the eye sees without being known by name: as a mean over the
///   surface, without shadows. Each errs in other pixels, so absolute values add.
///
/// The factors were measured: see Calibration in the source. O(links + nodes).
LinkErrors EstimateLinkErrors(const OpenTree& tree, const std::vector<Link>& links,
  const Flow& radiance, const Flow& importance);

} // namespace vantage
