#pragma once

#include "core/Solver.h"

#include <cstdint>
#include <limits>

/// \file EngineRun.h
/// One picture by one method, and what it has cost.

namespace vantage::benchmarks
{

struct EngineSettings
{
  Method method = Method::GoalOriented;
  bool importance = true; ///< SolverSettings::importance
  int size = 48;          ///< pixels along each side
  bool pixelCentres = true;
  double error = 0.01; ///< asked relative L1 error of the picture
  double seconds = std::numeric_limits<double>::infinity(); ///< for the solution, wall-clock
  std::uint64_t seed = 1;                                   ///< of all that is random
};

struct EngineRun
{
  Image image;
  double estimate = 0.0;      ///< what the method says of its relative L1 error
  double solveEstimate = 0.0; ///< the part of the solution
  double buildCpu = 0.0;      ///< s, of all threads: scene, solution, picture
  double solveCpu = 0.0;
  double imageCpu = 0.0;
  std::uint64_t rays = 0; ///< of solution and picture
  std::size_t links = 0;
  std::size_t elements = 0;
  GatherReport view; ///< of goal-oriented
};

/// From the scene to the picture: gathered where the method is goal-oriented, else of the elements.
EngineRun RunEngine(const Scene& scene, const Camera& camera, const EngineSettings& settings);

} // namespace vantage::benchmarks
