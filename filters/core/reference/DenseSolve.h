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
  int level = 0;         ///< every patch is split this often into four, 0 .. 6
  bool exactVisibility = true; ///< cut shadows exactly (formfactor/); else stratified rays
  std::uint32_t rays = 1024;   ///< a pair, where visibility is sampled
};

/// Elements of the uniformly split patches and what leaves them.
struct DenseSolution
{
  ElementTree tree;
  std::vector<NodeId> elements;   ///< the leaves, in ascending order
  std::vector<Color> radiance;    ///< one for each of them
  std::vector<double> throughput; ///< G, dense, row by row, m^2 sr
};

/// Solves (1 - rho F) L = E for each channel by LU. O(n^2) form factors, O(n^3) time.
/// \throw InputError for more than 20,000 elements; DivergenceError when the system is singular
/// (albedo 1 in a closed scene).
DenseSolution SolveDense(const Scene& scene, const DenseSettings& settings = {});

} // namespace vantage
