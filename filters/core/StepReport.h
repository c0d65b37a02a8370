#pragma once

#include "core/mesh/ElementTree.h"

#include <cstdint>
#include <string>

/// \file StepReport.h
/// What a solver tells of its progress.

namespace vantage
{

/// Work done so far, counted where it is done.
struct WorkCounters
{
  std::uint64_t viewRays = 0;     ///< cast through the image for the view importance
  std::uint64_t pairRays = 0;     ///< shadow rays between the ends of interactions
  std::uint64_t probeRays = 0;    ///< that find out what is covered or open (goal-oriented)
  std::uint64_t surfacePairs = 0; ///< pairs of patches or elements that were evaluated
  std::uint64_t clusterPairs = 0; ///< pairs with a cluster (goal-oriented)
  std::uint64_t refined = 0;      ///< interactions replaced by finer ones (goal-oriented)
  std::uint64_t certified = 0;    ///< pairs whose visibility was known from a coarser one
  std::uint64_t hidden = 0;       ///< pairs that were found to see nothing of each other
  std::uint64_t sweeps = 0;       ///< over all interactions (goal-oriented)

  std::uint64_t Evaluations() const { return this->surfacePairs + this->clusterPairs; }
  std::uint64_t Rays() const { return this->viewRays + this->pairRays + this->probeRays; }
};

/// Calls visit(name, count) for each counter, in the order above.
template <typename Visit>
void ForEachCounter(const WorkCounters& work, const Visit& visit)
{
  visit("viewRays", work.viewRays);
  visit("pairRays", work.pairRays);
  visit("probeRays", work.probeRays);
  visit("surfacePairs", work.surfacePairs);
  visit("clusterPairs", work.clusterPairs);
  visit("refined", work.refined);
  visit("certified", work.certified);
  visit("hidden", work.hidden);
  visit("sweeps", work.sweeps);
}

/// One line of history.
struct StepReport
{
  std::uint64_t step = 0;       ///< 1 for the first
  std::string phase;            ///< "initial", "radiance", "importance", "gather" or "refine"
  PatchId patch = None;         ///< that shot (gathered); of an interaction step: the shooter's
  double viewFlux = 0.0;        ///< estimate of Phi from below, mean of channels
  double unshotViewFlux = 0.0;  ///< its part that is still unshot: sum of dL G Y over interactions
  double unshotPower = 0.0;     ///< sum of A dL pi over patches, W, mean of channels
  double errorEstimate = 0.0;   ///< how far from the goal: see Solver::Run()
  std::size_t elements = 0;     ///< leaves of the element tree
  std::size_t interactions = 0; ///< that exist
  WorkCounters work;            ///< so far
  double seconds = 0.0;         ///< spent in Run() so far
};

} // namespace vantage
