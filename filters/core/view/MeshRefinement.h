#pragma once

#include "core/transport/ViewWeights.h"
#include "core/view/SurfaceGather.h"

#include <vector>

/// \file MeshRefinement.h
/// Elements that are small where light straight from the lamps varies.

namespace vantage
{

/// Splits the elements that a view sees until interpolation between their corners adds no more than
/// `error` to its picture, relative L1, for light straight from the lamps: so small elements follow
/// the edges of shadows. What surfaces reflect is smooth: elements that fill no more than 1/2000 of
/// the view, as all do in the end, are small enough for it. Two neighbours on one patch differ by
/// one level at most. Elements that the view does not see stay as they are.
/// \param tree of the patches of the solution
/// \param view samples of the image, in any order
/// The same for any number of threads. O((elements + samples) log).
ElementTree RefineForView(const SurfaceGather& gather, const RadianceSolution& solution,
  ElementTree tree, const std::vector<ViewSample>& view, double error, GatherCounts& counts);

} // namespace vantage
