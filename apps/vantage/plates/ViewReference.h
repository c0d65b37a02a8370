#pragma once

#include "core/Solver.h"
#include "core/reference/PathTracer.h"

/// \file ViewReference.h
/// What a view should look like, from the path tracer.

namespace vantage
{

/// A small path-traced image of a view, and how far solutions are from it. Only means over blocks
/// of pixels are compared: path tracing has to spend its rays on the means that count, not on
/// pixels.
class ViewReference
{
public:
  /// \param samples a pixel of an image about 160 pixels wide, >= 1
  ViewReference(
    const Scene& scene, const Camera& camera, int samples, const PathTracerProgress& progress = {});

  /// Relative L1 difference of the block means; that of two images without any noise of their own.
  double ErrorOf(const Solver& solver) const;

  /// What of such an error is expected to be the path tracer's own noise.
  double Noise() const { return this->BlockNoise; }

  const Image& Radiance() const { return this->Traced; }

private:
  Camera View;
  Image Traced;
  double BlockNoise = 0.0;
};

} // namespace vantage
