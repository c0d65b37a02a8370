#include "core/view/ViewGather.h"

#include "core/Error.h"
#include "core/view/Stopwatch.h"
#include "core/view/SurfaceGather.h"
#include "core/view/ViewSamples.h"

#include <tbb/parallel_for.h>

#include <limits>
#include <string>
#include <utility>

namespace vantage
{

namespace
{

/// Where the direct light of three pixels in a row bends by more than this part of the brightest,
/// the middle one holds an edge of a shadow, or something of the kind.
constexpr double EdgeBend = 0.08;

/// Pixels along a side.
constexpr int MostPixels = 32768;

/// What is done of most pictures before each of these.
constexpr double BeforeDirect = 0.1;
constexpr double BeforeIndirect = 0.5;

/// One image on its way.
class Gather
{
public:
  Gather(const OccluderScene& occluders, const RadianceSolution& solution, const Camera& camera,
    const GatherSettings& settings)
    : Occluders(&occluders)
    , Solution(&solution)
    , Plane(camera)
    , Light(occluders, solution)
    , Settings(settings)
  {
  }

  GatheredView Run(const GatherObserver& observer);

private:
  void FindPoints();
  void LightDirectly();
  std::vector<std::uint32_t> FindShadowEdges() const;
  void RefineShadowEdges();
  void LightIndirectly();
  void DescribeCentres();
  Vec3 Direction(double x, double y) const
  {
    return this->Plane.Direction(
      2.0 * x / this->Settings.width - 1.0, 2.0 * y / this->Settings.height - 1.0);
  }

  const OccluderScene* Occluders;
  const RadianceSolution* Solution;
  ImagePlane Plane;
  SurfaceGather Light;
  GatherSettings Settings;
  ViewSamples Samples;
  GatherCounts Counts;
  std::vector<Color> Direct; ///< irradiance of each point
  GatheredView View;
};

void Gather::FindPoints()
{
  this->Samples = SampleImage(*this->Occluders, this->Plane, this->Settings.width,
    this->Settings.height, this->Settings.pixelCentres);
  GatherReport& report = this->View.report;
  report.primaryRays = this->Samples.rays;
  report.primaryLooks = this->Samples.looks;
  report.viewPoints = this->Samples.points.size();
}

void Gather::LightDirectly()
{
  this->Direct = this->Light.Direct(this->Samples.points, this->Settings.error, this->Counts);
  if (!this->Settings.pixelCentres)
  {
    this->RefineShadowEdges();
  }
}

/// Points of pixels that see one patch, where light jumps.
std::vector<std::uint32_t> Gather::FindShadowEdges() const
{
  const ViewSamples& samples = this->Samples;
  std::vector<std::uint32_t> pointOfPixel(samples.centres.size(), None);
  for (std::uint32_t i = 0; i < samples.points.size(); ++i)
  {
    if (samples.points[i].weight == 1.0)
    {
      pointOfPixel[samples.pixelOfPoint[i]] = i;
    }
  }
  const auto bends = [&](std::uint32_t pixel, int step)
  {
    const std::uint32_t a = pointOfPixel[pixel - step];
    const std::uint32_t b = pointOfPixel[pixel];
    const std::uint32_t c = pointOfPixel[pixel + step];
    const PatchId patch = samples.points[b].patch;
    if (a == None || c == None || samples.points[a].patch != patch ||
        samples.points[c].patch != patch)
    {
      return false;
    }
    const Color bend = glm::abs(this->Direct[a] + this->Direct[c] - 2.0 * this->Direct[b]);
    const Color most = glm::max(this->Direct[a], glm::max(this->Direct[b], this->Direct[c]));
    return MaxChannel(bend) > EdgeBend * MaxChannel(most);
  };
  std::vector<std::uint32_t> edges;
  const int width = this->Settings.width;
  const int height = this->Settings.height;
  for (int y = 0; y < height; ++y)
  {
    for (int x = 0; x < width; ++x)
    {
      const std::uint32_t pixel = static_cast<std::uint32_t>(y) * width + x;
      const bool inside = pointOfPixel[pixel] != None;
      if (inside && ((x > 0 && x + 1 < width && bends(pixel, 1)) ||
                      (y > 0 && y + 1 < height && bends(pixel, width))))
      {
        edges.push_back(pointOfPixel[pixel]);
      }
    }
  }
  return edges;
}

/// The direct light of pixels with edges in it is the mean over their parts.
void Gather::RefineShadowEdges()
{
  const std::vector<std::uint32_t> edges = this->FindShadowEdges();
  std::vector<GatherPoint> parts;
  for (const std::uint32_t i : edges)
  {
    const GatherPoint& point = this->Samples.points[i];
    const int x = static_cast<int>(this->Samples.pixelOfPoint[i]) % this->Settings.width;
    const int y = static_cast<int>(this->Samples.pixelOfPoint[i]) / this->Settings.width;
    const Vec3 normal = UnitNormal(this->Occluders->Shape(point.patch / 2));
    const double height = glm::dot(normal, point.point - this->Plane.eye);
    for (std::uint32_t k = 0; k < PartsOfPixel; ++k)
    {
      const Vec2 place = PlaceOfPart(k);
      const Vec3 direction = this->Direction(x + place.x, y + place.y);
      parts.push_back(
        { point.patch, this->Plane.eye + height / glm::dot(normal, direction) * direction });
    }
  }
  const std::vector<Color> direct = this->Light.Direct(parts, this->Settings.error, this->Counts);
  for (std::size_t e = 0; e < edges.size(); ++e)
  {
    Color sum(0.0);
    for (std::uint32_t k = 0; k < PartsOfPixel; ++k)
    {
      sum += direct[e * PartsOfPixel + k];
    }
    this->Direct[edges[e]] = sum / static_cast<double>(PartsOfPixel);
  }
  this->View.report.viewPoints += parts.size();
}

void Gather::LightIndirectly()
{
  SurfaceGather::Settings settings;
  settings.error = this->Settings.error;
  settings.seed = this->Settings.seed;
  const SurfaceGather::Result result =
    this->Light.Radiance(this->Samples.points, this->Direct, settings);
  this->View.radiance = Image(this->Settings.width, this->Settings.height);
  this->View.irradiance = this->View.radiance;
  for (std::size_t i = 0; i < this->Samples.points.size(); ++i)
  {
    const std::uint32_t pixel = this->Samples.pixelOfPoint[i];
    const double weight = this->Samples.points[i].weight;
    this->View.radiance.pixels[pixel] += weight * result.radiance[i];
    this->View.irradiance.pixels[pixel] += weight * result.irradiance[i];
  }
  this->Counts.direct.Add(result.counts.direct);
  GatherReport& report = this->View.report;
  report.gatherPoints = result.counts.gatherPoints;
  report.gatherRays = result.counts.gatherRays;
  report.hitShadowRays = result.counts.hitShadowRays;
  report.errorEstimate = result.error;
}

void Gather::DescribeCentres()
{
  const std::vector<EyeHit>& centres = this->Samples.centres;
  this->View.depth.assign(centres.size(), std::numeric_limits<float>::infinity());
  this->View.patch.assign(centres.size(), None);
  tbb::parallel_for(0, this->Settings.height,
    [&](int y)
    {
      for (int x = 0; x < this->Settings.width; ++x)
      {
        const std::size_t pixel = static_cast<std::size_t>(y) * this->Settings.width + x;
        const EyeHit& hit = centres[pixel];
        if (hit.patch == None)
        {
          continue;
        }
        const Vec3 way = hit.depth * this->Direction(x + 0.5, y + 0.5);
        this->View.depth[pixel] = static_cast<float>(glm::length(way));
        this->View.patch[pixel] = this->Solution->IsActive(hit.patch) ? hit.patch : None;
      }
    });
}

GatheredView Gather::Run(const GatherObserver& observer)
{
  const auto isGivenUp = [&observer](double done) { return observer && !observer(done); };
  Stopwatch whole, phase;
  GatherReport& report = this->View.report;
  this->FindPoints();
  this->DescribeCentres();
  report.primarySeconds = phase.Lap();
  if (isGivenUp(BeforeDirect))
  {
    return {};
  }
  this->LightDirectly();
  report.directSeconds = phase.Lap();
  if (isGivenUp(BeforeIndirect))
  {
    return {};
  }
  this->LightIndirectly();
  report.indirectSeconds = phase.Lap();
  report.lampEvaluations = this->Counts.direct.lampEvaluations;
  report.cutEvaluations = this->Counts.direct.cutEvaluations;
  report.occluderQueries = this->Counts.direct.occluderQueries;
  report.shadowRays = this->Counts.direct.shadowRays;
  report.seconds = whole.Lap();
  if (isGivenUp(1.0))
  {
    return {};
  }
  return std::move(this->View);
}

} // namespace

void GatherSettings::Validate() const
{
  const auto require = [](bool isGood, const std::string& message)
  {
    if (!isGood)
    {
      throw InputError("gather: " + message);
    }
  };
  for (const auto& [name, value] :
    { std::make_pair("width", this->width), std::make_pair("height", this->height) })
  {
    require(value >= 1 && value <= MostPixels, std::string(name) + " is " + std::to_string(value) +
                                                 "; give a number from 1 to " +
                                                 std::to_string(MostPixels));
  }
  require(this->error >= LeastGatherError && this->error <= 1.0,
    "error is " + std::to_string(this->error) + "; give a number from 0.0005 to 1");
}

GatheredView GatherView(const OccluderScene& occluders, const RadianceSolution& solution,
  const Camera& camera, const GatherSettings& settings, const GatherObserver& observer)
{
  settings.Validate();
  camera.Validate();
  return Gather(occluders, solution, camera, settings).Run(observer);
}

} // namespace vantage
