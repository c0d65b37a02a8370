#pragma once

#include "core/math/Types.h"
#include "core/mesh/ElementTree.h"
#include "core/scene/Scene.h"

#include <cstdint>
#include <vector>

/// \file DenseSolve.h
/// The diffuse radiance equation of a small scene as one dense linear system, solved directly.

namespace vantage
{

struct DenseSettings
{
  int level = 0;               ///< every patch is split this often into four, 0 .. 6
  bool exactVisibility = true; ///< cut shadows exactly (formfactor/); else stratified rays
  std::uint32_t rays = 1024;   ///< a pair, where visibility is sampled, 1 .. 4096

  /// \throw InputError naming the first value out of range.
  void Validate() const;
};

/// Elements of the uniformly split patches and what leaves them.
struct DenseSolution
{
  ElementTree tree;
  std::vector<NodeId> elements;   ///< the leaves, in ascending order
  std::vector<Color> radiance;    ///< one for each of them
  std::vector<double> throughput; ///< G, dense, row by row, (scene unit)^2 sr
};

/// Throughput between all pairs of elements, obstruction included: a dense symmetric matrix, row by
/// row. Elements that certainly see nothing or all of each other cost one proof; in between, the
/// shadows of what reaches into their convex hull are cut out, or rays are traced.
/// O(n^2) form factors, parallel; the same for any number of threads.
std::vector<double> DenseThroughput(const FacetSet& facets, const ElementTree& tree,
  const std::vector<NodeId>& elements, const DenseSettings& settings);

/// Solves (1 - rho F) L = E for each channel by LU with partial pivoting: O(n^3), one factorisation
/// for channels of equal albedo. Specular parts of materials are left out.
/// \throw InputError for a bad scene or setting, or more than 20,000 elements; DivergenceError when
/// light would be multiplied more than ten thousand times: albedo 1 in a closed scene, as exactly
/// as form factors can tell.
DenseSolution SolveDense(const Scene& scene, const DenseSettings& settings = {});

} // namespace vantage
