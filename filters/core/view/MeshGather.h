#pragma once

#include "core/mesh/PatchMesh.h"
#include "core/transport/ViewWeights.h"
#include "core/view/SurfaceGather.h"

#include <cstdint>
#include <vector>

/// \file MeshGather.h
/// The light of a view at the points of a mesh that is fine enough to be drawn.

namespace vantage
{

struct MeshGatherSettings
{
  /// Of the picture that interpolation between the points gives, relative L1: what interpolation
  /// may add, and what the gather of the points may. LeastGatherError .. 1
  double interpolationError = 0.01;
  double gatherError = 0.01;
  std::uint64_t seed = 1;

  /// \throw InputError naming the first value out of range.
  void Validate() const;
};

/// Elements with the radiance of their points.
struct GatheredMesh
{
  ElementTree tree; ///< the given one, split further where the view needs it
  ElementSurface surface;
  std::vector<Color> pointRadiance;    ///< of each point of the surface, W m^-2 sr^-1
  std::vector<std::uint32_t> gathered; ///< points of the surface whose light was, ascending
  std::vector<Color> irradiance;       ///< of these, W m^-2
  /// Relative L1 of what interpolation adds to the picture: measured at points of the image that
  /// had no say in the splits.
  double interpolationError = 0.0;
  double gatherError = 0.0; ///< of the points, estimated as SurfaceGather does
  GatherCounts counts;
};

/// Refines the elements for the view (MeshRefinement.h) and gathers the light of the points of all
/// patches that it sees (SurfaceGather.h); other points have the mean of the elements around them.
/// \param tree of the facets that the solution is of, as it was solved on or split further
/// \param view samples of the image; no order is needed
/// Parallel, the same for any number of threads. O((elements + samples) log).
GatheredMesh GatherMesh(const OccluderScene& occluders, const RadianceSolution& solution,
  const FacetSet& facets, ElementTree tree, const std::vector<ViewSample>& view,
  const MeshGatherSettings& settings);

} // namespace vantage
