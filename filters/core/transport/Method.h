#pragma once

#include <string>
#include <vector>

/// \file Method.h
/// The orders in which interactions can be visited.

namespace vantage
{

/// Algorithms of Bekaert and Willems (1995), and gathering on the same interactions.
enum class Method
{
  BasicShooting,       ///< Algorithm 1: every interaction in turn
  ProgressiveShooting, ///< Algorithm 2: largest unshot dL A F first (Cohen et al. 1988)
  ImportanceShooting,  ///< Algorithms 3 and 4: importance and radiance in turn, largest dL A F I
  GoalOriented,        ///< hierarchical interactions made and refined where the view needs them
  GaussSeidel,         ///< gathering, patch by patch (Goral et al. 1984)
  ImportanceGathering  ///< radiance gathered where it matters, importance shot (Smits et al. 1992)
};

/// What one step shoots.
enum class Granularity
{
  Interaction, ///< one interaction
  Patch        ///< all interactions of one patch
};

/// "basic-shooting", "progressive-shooting", "importance-shooting", "goal-oriented",
/// "gauss-seidel", "importance-gathering".
const std::vector<std::string>& MethodNames();
/// Of the methods that share one graph of interactions, which depends on the scene only: all but
/// "goal-oriented".
std::vector<std::string> FixedGraphMethodNames();
std::string NameOf(Method method);
/// Whether the methods of the fixed graph go by importance, and so need a view.
bool UsesImportance(Method method);
/// Whether a step gathers, which takes all interactions of a patch at once.
bool Gathers(Method method);
/// \throw UnknownNameError
Method MethodFromName(const std::string& name);

/// "interaction", "patch".
std::string NameOf(Granularity granularity);
/// \throw UnknownNameError
Granularity GranularityFromName(const std::string& name);

} // namespace vantage
