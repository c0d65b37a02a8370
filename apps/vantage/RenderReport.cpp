#include "RenderReport.h"

#include "io/TextLines.h"

#include <nlohmann/json.hpp>
#include <sys/resource.h>

namespace vantage
{

namespace
{

std::int64_t PeakMemoryBytes()
{
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return 1024 * static_cast<std::int64_t>(usage.ru_maxrss); // Linux counts kibibytes
}

} // namespace

std::string PrintReport(const RenderReport& report)
{
  const nlohmann::ordered_json json = {
    { "method", report.method },
    { "viewFlux", report.viewFlux },
    { "errorEstimate", report.errorEstimate },
    { "elements", report.elements },
    { "interactions", report.interactions },
    { "rays", report.rays },
    { "steps", report.steps },
    { "seconds", { { "load", report.loadSeconds }, { "build", report.buildSeconds },
                   { "solve", report.solveSeconds }, { "image", report.imageSeconds },
                   { "total", report.totalSeconds } } },
    { "peakMemoryBytes", PeakMemoryBytes() },
    { "threads", report.threads },
  };
  return json.dump(2) + "\n";
}

std::string PrintHistory(const std::vector<StepReport>& history)
{
  std::string text = "step,phase,patch,viewFlux,unshotViewFlux,unshotPower,relativeUnshot,elements,"
                     "interactions,evaluations,rays,seconds\n";
  for (const StepReport& row : history)
  {
    text += std::to_string(row.step) + ',' + row.phase + ',' +
            (row.patch == None ? "-1" : std::to_string(row.patch)) + ',' +
            PrintNumber(row.viewFlux) + ',' + PrintNumber(row.unshotViewFlux) + ',' +
            PrintNumber(row.unshotPower) + ',' + PrintNumber(row.relativeUnshot) + ',' +
            std::to_string(row.elements) + ',' + std::to_string(row.interactions) + ',' +
            std::to_string(row.evaluations) + ',' + std::to_string(row.rays) + ',' +
            PrintNumber(row.seconds) + '\n';
  }
  return text;
}

double ViewFluxOf(const Image& image, const Camera& camera)
{
  const ImagePlane plane(camera);
  const double pixelArea = plane.Area() / static_cast<double>(image.pixels.size());
  double flux = 0.0;
  for (int y = 0; y < image.height; ++y)
  {
    for (int x = 0; x < image.width; ++x)
    {
      const double s = 2.0 * (x + 0.5) / image.width - 1.0;
      const double t = 2.0 * (y + 0.5) / image.height - 1.0;
      // d omega = cos^3 dA at distance 1, and one cosine more; cos^2 = 1 / |direction|^2.
      const Vec3 direction = plane.Direction(s, t);
      const double cosine2 = 1.0 / glm::dot(direction, direction);
      flux += Mean(image.At(x, y)) * cosine2 * cosine2 * pixelArea;
    }
  }
  return flux;
}

} // namespace vantage
