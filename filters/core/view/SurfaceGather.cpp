#include "core/view/SurfaceGather.h"

#include "core/view/Stopwatch.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>

namespace vantage
{

namespace
{

/// Distance that points keep from the border of their patch, in sizes of the patch.
constexpr double BorderMargin = 1e-6;
/// Tolerance of a lamp over the error that is asked for, and at most. It is of the worst place that
/// is looked at: the mean over a picture errs by a tenth of it in labyrinths, a fiftieth in the
/// office.
constexpr double LampShare = 0.5;
constexpr double LargestLampTolerance = 0.01;

/// Indices of points, those of one patch side by side, in their own order.
struct PointsByPatch
{
  std::vector<std::uint32_t> order;
  std::vector<std::uint32_t> starts; ///< of each patch in the order, and the end

  /// A counting sort.
  explicit PointsByPatch(const std::vector<GatherPoint>& points)
    : order(points.size())
  {
    PatchId patches = 0;
    for (const GatherPoint& point : points)
    {
      patches = std::max(patches, point.patch + 1);
    }
    std::vector<std::uint32_t> next(patches, 0);
    for (const GatherPoint& point : points)
    {
      ++next[point.patch];
    }
    std::uint32_t sum = 0;
    for (std::uint32_t& start : next)
    {
      const std::uint32_t count = start;
      if (count > 0)
      {
        this->starts.push_back(sum);
      }
      start = sum;
      sum += count;
    }
    this->starts.push_back(sum);
    for (std::uint32_t i = 0; i < points.size(); ++i)
    {
      this->order[next[points[i].patch]++] = i;
    }
  }
};

/// The border of a patch, which points keep away from.
class PatchBorder
{
public:
  PatchBorder(const Polygon& shape, double tolerance)
    : Count(shape.Size())
  {
    const double margin = std::max(BorderMargin * RadiusAround(shape, shape[0]), 4.0 * tolerance);
    const Vec3 normal = UnitNormal(shape);
    for (int i = 0; i < this->Count; ++i)
    {
      const Vec3 along = shape[(i + 1) % this->Count] - shape[i];
      const Vec3 inward = glm::normalize(glm::cross(normal, along));
      this->Edges[i] = { inward, glm::dot(inward, shape[i]) + margin };
    }
  }

  /// The point, or one near it that keeps the margin from all edges.
  Vec3 Inside(Vec3 point) const
  {
    for (int i = 0; i < this->Count; ++i)
    {
      const double distance = this->Edges[i].Distance(point);
      point -= std::min(distance, 0.0) * this->Edges[i].normal;
    }
    return point;
  }

private:
  std::array<Plane, 4> Edges;
  int Count;
};

} // namespace

std::vector<Color> SurfaceGather::Direct(
  const std::vector<GatherPoint>& points, double error, GatherCounts& counts) const
{
  Stopwatch watch;
  const PointsByPatch patches(points);
  std::vector<Color> irradiance(points.size(), Color(0.0));
  const DirectLight light(
    *this->Occluders, *this->Solution, std::min(LampShare * error, LargestLampTolerance));
  std::vector<DirectCounters> counters(patches.starts.size() - 1);
  tbb::parallel_for(std::size_t(0), counters.size(),
    [&](std::size_t k)
    {
      const PatchId patch = points[patches.order[patches.starts[k]]].patch;
      const PatchBorder border(this->Occluders->Shape(patch / 2), this->Occluders->Tolerance());
      std::vector<Vec3> places;
      for (std::uint32_t i = patches.starts[k]; i < patches.starts[k + 1]; ++i)
      {
        places.push_back(border.Inside(points[patches.order[i]].point));
      }
      const std::vector<Color> ofPatch = light.At(patch, places, counters[k]);
      for (std::size_t i = 0; i < ofPatch.size(); ++i)
      {
        irradiance[patches.order[patches.starts[k] + i]] = ofPatch[i];
      }
    });
  for (const DirectCounters& counter : counters)
  {
    counts.direct.Add(counter);
  }
  counts.directSeconds += watch.Lap();
  return irradiance;
}

SurfaceGather::Result SurfaceGather::Radiance(
  const std::vector<GatherPoint>& points, const Settings& settings) const
{
  GatherCounts counts;
  const std::vector<Color> direct = this->Direct(points, settings.error, counts);
  Result result = this->Radiance(points, direct, settings);
  result.counts.direct.Add(counts.direct);
  result.counts.directSeconds = counts.directSeconds;
  return result;
}

SurfaceGather::Result SurfaceGather::Radiance(const std::vector<GatherPoint>& points,
  const std::vector<Color>& direct, const Settings& settings) const
{
  Stopwatch watch;
  const RadianceSolution& solution = *this->Solution;
  Result result;
  result.radiance.assign(points.size(), Color(0.0));
  result.irradiance.assign(points.size(), Color(0.0));
  IndirectSettings indirectSettings{ settings.error, 0.0, settings.seed };
  std::vector<IndirectSpot> spots;
  std::vector<std::uint32_t> pointOfSpot;
  spots.reserve(points.size());
  pointOfSpot.reserve(points.size());
  const PointsByPatch patches(points);
  for (std::size_t k = 0; k + 1 < patches.starts.size(); ++k)
  {
    const PatchId patch = points[patches.order[patches.starts[k]]].patch;
    if (!solution.IsActive(patch))
    {
      continue;
    }
    const PatchBorder border(this->Occluders->Shape(patch / 2), this->Occluders->Tolerance());
    const Color brdf = solution.albedo[patch] / Pi;
    for (std::uint32_t j = patches.starts[k]; j < patches.starts[k + 1]; ++j)
    {
      const std::uint32_t i = patches.order[j];
      result.irradiance[i] = direct[i];
      result.radiance[i] = solution.emission[patch] + brdf * direct[i];
      indirectSettings.total += points[i].weight * Mean(result.radiance[i]);
      spots.push_back({ patch, border.Inside(points[i].point), points[i].weight * Mean(brdf) });
      pointOfSpot.push_back(i);
    }
  }
  IndirectReport report;
  const std::vector<Color> indirect =
    IndirectLight(*this->Occluders, solution, spots, indirectSettings, report);
  for (std::size_t k = 0; k < spots.size(); ++k)
  {
    result.irradiance[pointOfSpot[k]] += indirect[k];
    result.radiance[pointOfSpot[k]] += solution.albedo[spots[k].patch] / Pi * indirect[k];
  }
  const double total = indirectSettings.total + report.sum;
  result.error = total > 0.0 ? report.error / total : 0.0;
  result.counts.gatherPoints = report.gatherPoints;
  result.counts.gatherRays = report.gatherRays;
  result.counts.hitShadowRays = report.shadowRays;
  result.counts.indirectSeconds = watch.Lap();
  return result;
}

} // namespace vantage
