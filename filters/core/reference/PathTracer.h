#pragma once

#include "core/math/Image.h"
#include "core/mesh/Facets.h"
#include "core/scene/Scene.h"
#include "core/visibility/OccluderScene.h"

#include <cstdint>
#include <functional>
#include <limits>
#include <memory>

/// \file PathTracer.h
/// Unbiased Monte Carlo (Kajiya 1986): the reference, slow and obvious. It knows nothing of
/// transport/, so that it can be trusted to judge it.

namespace vantage
{

struct PathTracerSettings
{
  int samplesPerPixel = 64;  ///< stratified over the pixel, >= 1
  int shadowRays = 1;        ///< next-event rays at the point the camera sees, stratified, >= 1
  int gatherRays = 1;        ///< continued paths at that point, stratified, >= 1
  int rouletteDepth = 3;     ///< bounces before Russian roulette may end a path, >= 0
  bool pixelCentres = false; ///< camera rays through pixel centres only (no antialiasing)
  std::uint64_t seed = 1;
  double seconds = std::numeric_limits<double>::infinity(); ///< stop after this time, > 0

  /// \throw InputError naming the first value out of range.
  void Validate() const;
};

struct PathTracerReport
{
  std::uint64_t rays = 0;
  int samplesPerPixel = 0;    ///< that were finished
  double relativeNoise = 0.0; ///< sum of the standard errors of the pixels over the sum of the
                              ///< pixels, mean of channels; an upper estimate, as it does not know
                              ///< of the stratification. Infinite after a single pass
  double seconds = 0.0;
};

/// Radiance that leaves the side of the facet that was hit, without its own emission, taken from
/// elsewhere. Where it is given, paths end at their first bounce and look it up: a final gather.
/// Called from many threads.
using RadianceLookup = std::function<Color(const Hit&)>;

/// Called after each pass with the fraction done; returns false to stop.
using PathTracerProgress = std::function<bool(double)>;

/// Diffuse surfaces (specular parts of materials are left out), both sides unless the material is
/// one-sided, emission from front sides. At every vertex direct light by next-event estimation: the
/// lamp is chosen by power, distance and cosines (LampTree), the point on it by area; then a
/// cosine-distributed bounce; emission met by a bounce is not counted again. Russian roulette ends
/// paths by their throughput. Passes of one sample for each pixel; after each pass the image is
/// unbiased. The result is the same for any number of threads.
class PathTracer
{
public:
  /// The scene must be valid; `facets` are its facets and `occluders` are made of them. All three
  /// must outlive the tracer.
  PathTracer(const Scene& scene, const FacetSet& facets, const OccluderScene& occluders);
  ~PathTracer();

  Image Render(const Camera& camera, int width, int height, const PathTracerSettings& settings,
    PathTracerReport* report = nullptr, const RadianceLookup& lookup = {},
    const PathTracerProgress& progress = {}) const;

private:
  struct Implementation;
  std::unique_ptr<Implementation> Impl;
};

} // namespace vantage
