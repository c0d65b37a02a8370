#pragma once

#include "core/transport/Transport.h"

/// \file Solvability.h
/// Whether the light in a scene goes somewhere.

namespace vantage
{

/// Where nothing absorbs and nothing escapes, emitted light adds up without end. Follows random
/// walks from the patches that reflect everything in some channel; a walk ends when it leaves the
/// scene or meets a patch that absorbs some of that channel. O(1) in scenes without such patches.
/// \throw DivergenceError when the walks of a channel never end.
void RequireSolvable(
  const ElementTree& tree, const OccluderScene& occluders, const std::vector<PatchOptics>& optics);

} // namespace vantage
