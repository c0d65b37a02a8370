#pragma once

#include <string>
#include <vector>

/// \file Method.h
/// The orders in which interactions can be visited.

namespace vantage
{

/// Algorithms of Bekaert and Willems (1995), and the gathering baseline on the same interactions.
enum class Method
{
  BasicShooting,       ///< Algorithm 1: every interaction in turn
  ProgressiveShooting, ///< Algorithm 2: largest unshot dL A F first (Cohen et al. 1988)
  ImportanceShooting,  ///< Algorithms 3 and 4: importance and radiance in turn, largest dL A F I
  GoalOriented,        ///< hierarchical interactions made and refined where the view needs them
  GaussSeidel          ///< gathering, patch by patch (Goral et al. 1984)
};

/// What one step shoots.
enum class Granularity
{
  Interaction, ///< one interaction
  Patch        ///< all interactions of one patch
};

/// "basic-shooting", "progressive-shooting", "importance-shooting", "goal-oriented",
/// "gauss-seidel".
const std::vector<std::string>& MethodNames();
/// Of the methods that share one graph of interactions, which depends on the scene only: all but
/// "goal-oriented".
std::vector<std::string> FixedGraphMethodNames();
std::string NameOf(Method method);
/// \throw UnknownNameError
Method MethodFromName(const std::string& name);

/// "interaction", "patch".
std::string NameOf(Granularity granularity);
/// \throw UnknownNameError
Granularity GranularityFromName(const std::string& name);

} // namespace vantage
