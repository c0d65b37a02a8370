#pragma once

#include "core/goal/GoalOrientedTransport.h"
#include "core/transport/RadianceSolution.h"

/// \file SolutionOfLinks.h
/// The solution as those see it who look at it.

namespace vantage
{

/// A lamp is named on an element when a link to it, or to a part of it, lets light pass or may do
/// so, and so are all that are parts of one curved surface; lamps in other clusters that were not
/// looked into, unless they are few, are in `unnamedDirect`.
/// O(nodes + links + patches). \pre the transport is solved
RadianceSolution SolutionOfLinks(const GoalOrientedTransport& transport);

} // namespace vantage
