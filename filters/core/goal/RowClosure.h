#pragma once

#include "core/goal/LinkMatrix.h"

#include <vector>

/// \file RowClosure.h
/// What every surface must see: the whole hemisphere, but for what leaves the scene.

namespace vantage
{

/// Throughputs over coarse ends, sampled visibility and points drawn in clusters leave every leaf
/// with a row sum sum_k F_ik that is off by several percent; what it should be is known: pi (1 -
/// escaped part). Finds factors d_i for each leaf such that the symmetric scaling G_ij d_i d_j has
/// the right row sums (Sinkhorn, Knopp 1967, in its symmetric form), so that reciprocity, energy
/// and duality are kept and a furnace is exact on every element whatever the refinement.
///
/// Next to nothing is known of links with clusters of several surfaces: a lamp in a room that no
/// view needs has a row that a few rays have all but missed. Would its factor make up for that in
/// all its links, those with surfaces next door, which are known, would get many times the light.
/// So there are factors for each kind of links, and of what a row lacks in logarithms, links
/// between surfaces take a tenth of what links with clusters take (the entropy that is minimal then
/// is a weighted one).
///
/// Where light escapes, the target is known to the precision of the probes only: a row whose sum is
/// within two standard deviations of it is left as it is, another one is brought to the border of
/// that range. Leaves that are such clusters, of which nothing is known, are scaled down only. d_i
/// is kept within [0.02, 64]: what no view needs has links of a few rays, which may miss most of a
/// row.
///
/// `closure` has entries for each open node and holds the last factors, to start from; those of
/// inner nodes are the means of their leaves. O(links + nodes) an iteration, some ten.
void CloseRows(const OpenTree& tree, const LinkMatrix& matrix, Closure& closure);

} // namespace vantage
