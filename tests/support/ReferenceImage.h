#pragma once

#include "core/reference/ReferenceImage.h"
#include "io/ReferenceCache.h"

/// \file ReferenceImage.h
/// What tests and benchmarks judge pictures by.

namespace vantage::test
{

using vantage::CachedReference;
using vantage::EveryPixel;
using vantage::MakeReference;
using vantage::ReferenceImage;
using vantage::ReferenceKey;
using vantage::ReferenceSettings;

/// A path-traced image that owes nothing to the solver, and the standard error of its mean,
/// relative.
struct TracedImage
{
  Image image;
  double noiseOfMean = 0.0;
};
TracedImage PathTraced(const Scene& scene, const Camera& camera, int size, int samplesPerPixel,
  bool pixelCentres = false);

} // namespace vantage::test
