#include "plates/ViewReference.h"

#include <algorithm>
#include <cmath>

namespace vantage
{

namespace
{

constexpr int BlockSize = 8; ///< pixels
constexpr int Width = 160;   ///< pixels

Image SizedFor(const Camera& camera)
{
  return { Width, std::max(1, static_cast<int>(std::lround(Width / camera.aspect))) };
}

} // namespace

ViewReference::ViewReference(
  const Scene& scene, const Camera& camera, int samples, const PathTracerProgress& progress)
  : View(camera)
  , Traced(SizedFor(camera))
{
  this->View.aspect = static_cast<double>(this->Traced.width) / this->Traced.height;
  const FacetSet facets = BuildFacets(scene);
  const OccluderScene occluders(facets);
  PathTracerSettings settings;
  settings.samplesPerPixel = samples;
  PathTracerReport report;
  this->Traced =
    PathTracer(scene, facets, occluders)
      .Render(this->View, this->Traced.width, this->Traced.height, settings, &report, {}, progress);
  // The pixels of a block are independent and there are BlockSize^2 of them.
  this->BlockNoise = report.relativeNoise / BlockSize;
}

double ViewReference::ErrorOf(const Solver& solver) const
{
  ElementImageSettings settings;
  settings.width = this->Traced.width;
  settings.height = this->Traced.height;
  const Image image = solver.Render(this->View, settings);
  return Compare(BlockMeans(image, BlockSize), BlockMeans(this->Traced, BlockSize)).relativeL1;
}

} // namespace vantage
