#pragma once

#include "core/math/Types.h"
#include "core/mesh/PatchMesh.h"

#include <cstdint>
#include <memory>
#include <vector>

/// \file Solution.h
/// What a solver has found, as plain data: the elements and the interactions.

namespace vantage
{

class GoalOrientedTransport;
class Transport;

/// Elements and what is known of each. Vectors have an entry for each polygon of `surface`, unless
/// they say otherwise.
struct ElementSolution
{
  std::shared_ptr<const ElementTree> tree; ///< whose leaves they are
  ElementSurface surface;
  std::vector<Color> pointRadiance;    ///< at the points of the surface, W m^-2 sr^-1
  std::vector<Color> pointIrradiance;  ///< the same of `irradiance`
  std::vector<Color> radiance;         ///< mean, W m^-2 sr^-1
  std::vector<Color> irradiance;       ///< mean, W m^-2; goal-oriented only, else empty
  std::vector<Color> unshotRadiance;   ///< W m^-2 sr^-1, mean over the interactions by throughput
  std::vector<Color> importance;       ///< P, sr m^-2
  std::vector<Color> unshotImportance; ///< of Y = rho P, sr m^-2
  std::vector<double> viewImportance;  ///< V, sr m^-2
  std::vector<Color> albedo;
  std::vector<Color> emission; ///< W m^-2 sr^-1
  std::vector<PatchId> patch;
  std::vector<std::uint32_t> scenePolygon;
  std::vector<Side> side;
  std::vector<int> level;
};

/// One interaction as others see it.
struct InteractionRecord
{
  Vec3 shooterCentre, receiverCentre;
  /// Level of a cluster of patches, whose patch is None.
  static constexpr int ClusterLevel = -1;

  PatchId shooter, receiver;       ///< patches of the two ends; None: a cluster
  int shooterLevel, receiverLevel; ///< 0: the patch itself
  double formFactor;               ///< F shooter -> receiver, sr, visibility included
  double visibility;               ///< visible fraction
  double shotFlux;                 ///< power carried so far, both directions, W, mean of channels;
                                   ///< goal-oriented: with its closure (goal/RowClosure.h)
  double contribution;             ///< of what was carried, to the view flux (same unit as Phi)
  std::uint64_t step;              ///< in which it was made
};

/// All leaves of `elements`, which `surface` shows: the tree of the transport, or a copy of it that
/// was split further. Points have the mean of what is around them. O(nodes + interactions).
ElementSolution ExtractElements(
  const Transport& transport, const FacetSet& facets, ElementTree elements, ElementSurface surface);
/// What lies in a cluster that was not looked into has the mean of what the cluster received.
ElementSolution ExtractElements(const GoalOrientedTransport& transport, const FacetSet& facets,
  ElementTree elements, ElementSurface surface);

/// All active interactions in the order they were made. O(interactions).
std::vector<InteractionRecord> ExtractInteractions(const Transport& transport);
std::vector<InteractionRecord> ExtractInteractions(const GoalOrientedTransport& transport);

} // namespace vantage
