#pragma once

#include "core/transport/RadianceSolution.h"

/// \file ExtractRadianceSolution.h
/// What the shooting methods have found, for the gather.

namespace vantage
{

class Transport;

/// The elements of all patches as they are now. A leaf names the emitting patches that it or an
/// ancestor interacts with, those of the elements around it, which it may see as well, and all that
/// are parts of the same curved surfaces; nothing is unnamed.
/// O(nodes * lamps of a node + interactions).
RadianceSolution ExtractRadianceSolution(const Transport& transport);

} // namespace vantage
