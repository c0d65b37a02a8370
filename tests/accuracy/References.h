#pragma once

#include "core/Solver.h"
#include "core/reference/PathTracer.h"
#include "support/ReferenceImage.h"

#include <string>

/// \file References.h
/// Solutions and pictures that the accuracy tests measure with, and how they report.

namespace vantage::test
{

/// A solver that has run until the given part of the view flux (or of the power) is unshot.
/// The camera makes square images.
Solver Solved(
  const Scene& scene, const Camera& camera, const SolverSettings& settings, double error);

/// The named camera of a scene, for square images.
Camera SquareCamera(const Scene& scene, const std::string& name);

/// What a pixel centre sees: exact radiance but for the noise of the sampling. Direct light by
/// stratified shadow rays, indirect light by a final gather into the reflected radiance of a finely
/// solved scene, whose own error is averaged over the whole hemisphere.
Image GatheredImage(const Solver& fine, const Camera& camera, int size, int gatherRays);

/// Prints one figure as "accuracy: name = value" and records it in the test's report.
void Record(const std::string& name, double value);

} // namespace vantage::test
