#pragma once

#include "core/mesh/ElementTree.h"
#include "core/transport/InteractionGraph.h"
#include "core/visibility/OccluderScene.h"

#include <vector>

/// \file Closure.h
/// What every element of a closed place must see: everything, once.

namespace vantage
{

/// Interactions have one throughput over both their ends, so an element below one of the ends gets
/// the mean over that end, not what it would see itself: the row sums sum_k G_ik / A_i of single
/// elements miss pi by several percent, and so does their radiance. In a closed place pi is exact,
/// and scaling what each element receives to it mends most of the error, that of sampled visibility
/// included. A furnace becomes exact whatever the refinement.
///
/// Returns the factor for each leaf of a patch (indexed by node; entries of other nodes are not
/// meant to be used): pi over its row sum, within [0.6, 1.6]. All factors are 1 for a patch from
/// which a ray gets out of the scene or ends on a side that takes no part: how much escapes
/// is not known exactly enough there.
/// \pre all interactions of the patch are in the graph. O(nodes and interactions of the patch).
std::vector<double> ClosureFactors(const ElementTree& tree, const OccluderScene& occluders,
  const InteractionGraph& graph, PatchId patch);

} // namespace vantage
