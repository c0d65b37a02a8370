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

namespace
{

nlohmann::ordered_json ToJson(const WorkCounters& counters)
{
  nlohmann::ordered_json work = nlohmann::ordered_json::object();
  ForEachCounter(counters, [&](const char* name, std::uint64_t count) { work[name] = count; });
  return work;
}

nlohmann::ordered_json ToJson(const GatherReport& gather)
{
  return { { "primaryRays", gather.primaryRays }, { "primaryLooks", gather.primaryLooks },
    { "viewPoints", gather.viewPoints }, { "lampEvaluations", gather.lampEvaluations },
    { "cutEvaluations", gather.cutEvaluations }, { "occluderQueries", gather.occluderQueries },
    { "shadowRays", gather.shadowRays }, { "gatherPoints", gather.gatherPoints },
    { "gatherRays", gather.gatherRays }, { "hitShadowRays", gather.hitShadowRays } };
}

nlohmann::ordered_json ToJson(const FrameReport& frame)
{
  return { { "camera", frame.camera }, { "viewFlux", frame.viewFlux },
    { "errorEstimate", frame.errorEstimate }, { "steps", frame.steps },
    { "evaluations", frame.evaluations }, { "solverRays", frame.solverRays },
    { "gather", ToJson(frame.gather) },
    { "seconds", { { "solve", frame.solveSeconds }, { "image", frame.imageSeconds } } } };
}

} // namespace

std::string PrintReport(const RenderReport& report)
{
  nlohmann::ordered_json frames = nlohmann::ordered_json::array();
  for (const FrameReport& frame : report.frames)
  {
    frames.push_back(ToJson(frame));
  }
  const nlohmann::ordered_json json = {
    { "method", report.method },
    { "viewFlux", report.viewFlux },
    { "errorEstimate", report.errorEstimate },
    { "exposure", report.exposure ? nlohmann::ordered_json(*report.exposure) : nullptr },
    { "elements", report.elements },
    { "interactions", report.interactions },
    { "rays", report.rays },
    { "steps", report.steps },
    { "work", ToJson(report.work) },
    { "frames", frames },
    { "seconds", { { "load", report.loadSeconds }, { "build", report.buildSeconds },
                   { "solve", report.solveSeconds }, { "image", report.imageSeconds },
                   { "total", report.totalSeconds } } },
    { "peakMemoryBytes", PeakMemoryBytes() },
    { "threads", report.threads },
  };
  return json.dump(2) + "\n";
}

std::string PrintHistory(
  const std::vector<StepReport>& history, const std::vector<FrameReport>& frames)
{
  std::string text =
    "frame,step,phase,patch,viewFlux,unshotViewFlux,unshotPower,errorEstimate,elements,"
    "interactions,evaluations,rays,seconds";
  ForEachCounter(
    WorkCounters(), [&text](const char* name, std::uint64_t) { text += std::string(",") + name; });
  text += '\n';
  std::size_t frame = 0;
  for (std::size_t k = 0; k < history.size(); ++k)
  {
    const StepReport& row = history[k];
    while (frame + 1 < frames.size() && k >= frames[frame].historyRows)
    {
      ++frame;
    }
    text += std::to_string(frame + 1) + ',' + std::to_string(row.step) + ',' + row.phase + ',' +
            (row.patch == None ? "-1" : std::to_string(row.patch)) + ',' +
            PrintNumber(row.viewFlux) + ',' + PrintNumber(row.unshotViewFlux) + ',' +
            PrintNumber(row.unshotPower) + ',' + PrintNumber(row.errorEstimate) + ',' +
            std::to_string(row.elements) + ',' + std::to_string(row.interactions) + ',' +
            std::to_string(row.work.Evaluations()) + ',' + std::to_string(row.work.Rays()) + ',' +
            PrintNumber(row.seconds);
    ForEachCounter(
      row.work, [&text](const char*, std::uint64_t count) { text += ',' + std::to_string(count); });
    text += '\n';
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
