#include "support/ReferenceImage.h"

#include "core/reference/PathTracer.h"

#include <algorithm>
#include <cmath>

namespace vantage::test
{

namespace
{

double Total(const Image& image)
{
  double sum = 0.0;
  for (const Color& pixel : image.pixels)
  {
    sum += Mean(pixel);
  }
  return sum;
}

} // namespace

TracedImage PathTraced(
  const Scene& scene, const Camera& camera, int size, int samplesPerPixel, bool pixelCentres)
{
  constexpr int Batches = 4;
  const FacetSet facets = BuildFacets(scene);
  const OccluderScene occluders(facets);
  const PathTracer tracer(scene, facets, occluders);
  PathTracerSettings settings;
  settings.samplesPerPixel = std::max(1, samplesPerPixel / Batches);
  settings.pixelCentres = pixelCentres;
  TracedImage result{ Image(size, size), 0.0 };
  double squares = 0.0;
  for (int batch = 0; batch < Batches; ++batch)
  {
    settings.seed = static_cast<std::uint64_t>(batch) + 1;
    const Image image = tracer.Render(camera, size, size, settings);
    for (std::size_t p = 0; p < image.pixels.size(); ++p)
    {
      result.image.pixels[p] += image.pixels[p] / static_cast<double>(Batches);
    }
    squares += Total(image) * Total(image) / Batches;
  }
  const double mean = Total(result.image);
  const double variance = std::max(0.0, squares - mean * mean) / (Batches - 1);
  result.noiseOfMean = std::sqrt(variance) / mean;
  return result;
}

} // namespace vantage::test
