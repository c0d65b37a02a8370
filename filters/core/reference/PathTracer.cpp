#include "core/reference/PathTracer.h"

#include "core/Error.h"
#include "core/math/Sampling.h"
#include "core/math/ScrambledSobol.h"
#include "core/reference/PathSampler.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <numeric>
#include <string>

namespace vantage
{

namespace
{

/// Stream of random numbers of a pixel that the sampler leaves to the tracer.
constexpr std::uint64_t PlaceInPixel = 0;

void RequireAtLeast(int value, int least, const char* name)
{
  if (value < least)
  {
    throw InputError(std::string(name) + " is " + std::to_string(value) +
                     "; give a number of at least " + std::to_string(least));
  }
}

/// The sum of samples of every pixel so far.
struct Accumulation
{
  Image sum;
  std::vector<double> squares; ///< of the mean of channels
  std::vector<std::uint64_t> raysOfRow;
  int passes = 0;

  Accumulation(int width, int height)
    : sum(width, height)
    , squares(this->sum.pixels.size(), 0.0)
    , raysOfRow(height, 0)
  {
  }
  void Add(int x, int y, const Color& sample)
  {
    this->sum.At(x, y) += sample;
    this->squares[static_cast<std::size_t>(y) * this->sum.width + x] += Mean(sample) * Mean(sample);
  }
  Image MeanImage() const
  {
    Image image = this->sum;
    for (Color& pixel : image.pixels)
    {
      pixel /= this->passes;
    }
    return image;
  }

  /// Sum of the standard errors of the pixels over the sum of the pixels.
  double RelativeNoise() const
  {
    if (this->passes < 2)
    {
      return std::numeric_limits<double>::infinity();
    }
    double noise = 0.0;
    double light = 0.0;
    for (std::size_t p = 0; p < this->squares.size(); ++p)
    {
      const double mean = Mean(this->sum.pixels[p]) / this->passes;
      const double variance = std::max(0.0, this->squares[p] / this->passes - mean * mean);
      noise += std::sqrt(variance / (this->passes - 1));
      light += mean;
    }
    return light > 0.0 ? noise / light : 0.0;
  }
};

} // namespace

void PathTracerSettings::Validate() const
{
  RequireAtLeast(this->samplesPerPixel, 1, "samples per pixel");
  RequireAtLeast(this->shadowRays, 1, "shadow rays");
  RequireAtLeast(this->gatherRays, 1, "gather rays");
  RequireAtLeast(this->rouletteDepth, 0, "roulette depth");
  if (!(this->seconds > 0.0))
  {
    throw InputError(
      "seconds to trace for is " + std::to_string(this->seconds) + "; give a time above zero");
  }
}

struct PathTracer::Implementation
{
  PathSampler sampler;
};

PathTracer::PathTracer(const Scene& scene, const FacetSet& facets, const OccluderScene& occluders)
  : Impl(std::make_unique<Implementation>(Implementation{ PathSampler(scene, facets, occluders) }))
{
}

PathTracer::~PathTracer() = default;

Image PathTracer::Render(const Camera& camera, int width, int height,
  const PathTracerSettings& settings, PathTracerReport* report, const RadianceLookup& lookup,
  const PathTracerProgress& progress) const
{
  settings.Validate();
  RequireAtLeast(width, 1, "image width");
  RequireAtLeast(height, 1, "image height");
  const auto start = std::chrono::steady_clock::now();
  const auto secondsSpent = [start]
  { return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count(); };
  const ImagePlane plane(camera);
  Accumulation image(width, height);
  double done = 0.0;
  do
  {
    tbb::parallel_for(0, height,
      [&](int y)
      {
        for (int x = 0; x < width; ++x)
        {
          PixelSample sample{ Hash(settings.seed, x, y), static_cast<std::uint32_t>(image.passes) };
          const Vec2 place = settings.pixelCentres
                               ? Vec2(0.5)
                               : ScrambledSobol(sample.index, Hash(sample.seed, PlaceInPixel));
          const Vec3 direction =
            plane.Direction(2.0 * (x + place.x) / width - 1.0, 2.0 * (y + place.y) / height - 1.0);
          image.Add(
            x, y, this->Impl->sampler.Radiance(plane.eye, direction, settings, lookup, sample));
          image.raysOfRow[y] += sample.rays;
        }
      });
    ++image.passes;
    done = std::max(static_cast<double>(image.passes) / settings.samplesPerPixel,
      secondsSpent() / settings.seconds);
  } while ((!progress || progress(std::min(done, 1.0))) && done < 1.0);
  if (report)
  {
    report->rays =
      std::accumulate(image.raysOfRow.begin(), image.raysOfRow.end(), std::uint64_t{ 0 });
    report->samplesPerPixel = image.passes;
    report->relativeNoise = image.RelativeNoise();
    report->seconds = secondsSpent();
  }
  return image.MeanImage();
}

} // namespace vantage
