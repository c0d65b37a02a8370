#pragma once

#include "core/Solver.h"

#include <cstdint>

/// \file RandomScene.h
/// Small scenes made from a seed, and what the property tests do with them.

namespace vantage::test
{

/// A closed box of random size and colours with one to four triangles and quadrilaterals hanging in
/// it, some of which emit; one camera inside.
Scene MakeRandomScene(std::uint64_t seed);

/// The same without its ceiling: light gets out.
Scene MakeOpenRandomScene(std::uint64_t seed);

/// A closed cube of one albedo around a square lamp that is parallel to its floor and in the middle
/// of the walls: four of them get the same light, so that ties must be broken.
Scene MakeSymmetricScene(std::uint64_t seed);

/// The numbers below `count` in a random order.
std::vector<std::size_t> RandomOrder(std::uint64_t seed, std::size_t count);

/// A scene whose polygon i is polygon order[i] of another one; those not named are left out.
Scene Reordered(const Scene& scene, const std::vector<std::size_t>& order);

/// Settings that keep these scenes to some hundred elements.
SolverSettings CoarseSettings(Method method, RefinementOracle oracle = RefinementOracle::F);

/// A solver that looks through the scene's camera.
Solver MakeSolver(const Scene& scene, const SolverSettings& settings);

/// Runs to a relative residual.
void Solve(Solver& solver, double error);

/// Mean radiance of each side of each polygon of the scene: two entries a polygon, front and back.
std::vector<Color> RadianceOfPolygonSides(const Solver& solver);
/// The same of any quantity that `elements`, the solver's, have.
std::vector<Color> MeansOverPolygonSides(
  const Solver& solver, const ElementSolution& elements, const std::vector<Color>& values);

} // namespace vantage::test
