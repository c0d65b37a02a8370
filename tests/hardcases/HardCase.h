#pragma once

#include "core/Solver.h"
#include "core/mesh/Facets.h"
#include "core/reference/PathTracer.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

/// \file HardCase.h
/// What the hard cases are run with: nothing but the scene, its camera and an error.

namespace vantage::test
{

constexpr int CasePixels = 32;

/// The solver after a run at default settings.
inline Solver SolvedCase(const Scene& scene, double error, std::uint64_t seed = 1)
{
  SolverSettings settings;
  settings.seed = seed;
  Solver solver(scene, settings);
  solver.SetCamera(scene.cameras[0]);
  Budget budget;
  budget.error = error;
  solver.Run(budget);
  return solver;
}

inline Image CasePicture(
  const Scene& scene, double error, int pixels = CasePixels, std::uint64_t seed = 1)
{
  GatherSettings settings;
  settings.width = settings.height = pixels;
  settings.pixelCentres = true;
  settings.error = GatherShare * error;
  settings.seed = seed;
  return SolvedCase(scene, error, seed).Gather(scene.cameras[0], settings).radiance;
}

inline double MeanRadiance(const Image& image)
{
  double sum = 0.0;
  for (const Color& pixel : image.pixels)
  {
    sum += Mean(pixel);
  }
  return sum / static_cast<double>(image.pixels.size());
}

inline bool IsFinite(const Image& image)
{
  return std::all_of(image.pixels.begin(), image.pixels.end(),
    [](const Color& c) {
      return std::isfinite(c.x + c.y + c.z) && std::min({ c.x, c.y, c.z }) >= 0.0;
    });
}

/// The slow twin's mean radiance of the same pixels.
inline double TracedMean(const Scene& scene, int samplesPerPixel)
{
  const FacetSet facets = BuildFacets(scene);
  const OccluderScene occluders(facets);
  PathTracerSettings settings;
  settings.pixelCentres = true;
  settings.samplesPerPixel = samplesPerPixel;
  return MeanRadiance(PathTracer(scene, facets, occluders)
                        .Render(scene.cameras[0], CasePixels, CasePixels, settings));
}

/// What a picture of default settings has of the slow twin's mean radiance.
inline double RelativeToTraced(const Scene& scene, double error, int samplesPerPixel)
{
  const Image picture = CasePicture(scene, error);
  EXPECT_TRUE(IsFinite(picture));
  return MeanRadiance(picture) / TracedMean(scene, samplesPerPixel);
}

} // namespace vantage::test
