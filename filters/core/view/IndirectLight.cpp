#include "core/view/IndirectLight.h"

#include "core/math/Sampling.h"
#include "core/view/HemisphereGather.h"
#include "core/view/IndirectSurface.h"
#include "core/view/SecondLook.h"
#include "core/view/SpotPlanes.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <numeric>
#include <optional>

namespace vantage
{

namespace
{

/// Cells start with at most this many spots, and a plane with at least four cells.
constexpr std::size_t MostSpots = 400;
/// Rays of a point for an error of 1 %; the noise falls with their number to the power 0.75.
constexpr double RaysAtOnePercent = 72.0;
constexpr double RaysExponent = 1.33;
constexpr std::uint32_t LeastRays = 16;
constexpr std::uint32_t MostRays = 4096;
/// Rays that find what counts, at least and at most.
constexpr double LeastRaysAround = 2048.0;
constexpr double MostRaysAround = 65536.0;
constexpr double MostRaysInAll = 262144.0;
/// From what these meet, the looks together take so many rays that the noise of their mean is a
/// part of the error that is asked for: the relative noise of a ray over that error, squared.
constexpr double NoiseOfLook = 1.0;
/// Noise of the correction over the error that is asked for, from which more looks are made.
constexpr double MostNoiseOfCorrection = 1.5;
constexpr std::uint32_t RaysOfHit = 4;
constexpr std::uint32_t MostBatches = 4;
/// The light of lamps is found at what a sample of rays meets. It is large enough to serve the rays
/// of the cells to start with and some three times as many that come later, and for its own noise,
/// of which a ray has this much relative to the light.
constexpr double PartThatIsLit = 0.2;
constexpr double NoiseOfLitRay = 0.4;
/// Spots from which it is seen how much of a bright texel is hidden.
constexpr std::uint32_t OriginsToKnow = 128;
/// Part of the error that may come from the interpolation: to start with, and in the end, if the
/// estimate of the whole is not met before.
constexpr double ShareOfModel = 0.4;
constexpr double LeastShareOfModel = 0.1;
/// Estimated error over the sum of weighted surprises. Calibrated on both views of the labyrinth, a
/// Cornell box and a room with a partition, against 4096 rays at each pixel: errors were 0.6 to
/// 1.05 of the estimate, for asked errors from 0.05 to 0.001.
constexpr double ErrorOfSurprise = 0.6;
/// Part of the error of a cell that goes when it is cut.
constexpr double GainOfCut = 0.6;
/// Part of the error that may be noise, and part of the noise of a cell that four times the rays
/// take away.
constexpr double NoiseShare = 0.9;
constexpr double GainOfEffort = 0.6;
/// Cells with less than this part of the usual weight get a quarter of the rays.
constexpr double SmallCell = 0.02;
/// Relative noise of a point, over the error asked for, from which it gets more rays, unless it
/// cannot be seen anyway; and how many times more at most.
constexpr double MostNoise = 8.0;
constexpr double InvisibleNoise = 0.03;
constexpr std::uint32_t MostEffort = 64;
constexpr int MostRounds = 8;

/// Gathers at the points of all planes and refines them.
class IndirectGatherer
{
public:
  IndirectGatherer(const OccluderScene& occluders, const RadianceSolution& solution,
    const std::vector<IndirectSpot>& spots, const IndirectSettings& settings)
    : Occluders(&occluders)
    , Solution(&solution)
    , Lit(occluders, solution)
    , Spots(&spots)
    , Settings(settings)
    , Surfaces(SurfacesOf(occluders, spots, MostSpots))
  {
    const double rays = RaysAtOnePercent * std::pow(settings.error / 0.01, -RaysExponent);
    this->Rays = static_cast<std::uint32_t>(
      std::clamp(rays, static_cast<double>(LeastRays), static_cast<double>(MostRays)));
  }

  std::vector<Color> Run(IndirectReport& report)
  {
    this->LightTheMet(report);
    this->LookAround(report);
    for (int round = 0; round <= MostRounds; ++round)
    {
      this->Measure(report);
      this->ForEachSurface([](IndirectSurface& surface) { surface.Fit(); });
      this->Summarise(report);
      const double wanted = this->Settings.error * (this->Settings.total + report.sum);
      while (this->Share > LeastShareOfModel && report.error > wanted &&
             this->ErrorToCut() <= this->Share * wanted)
      {
        this->Share *= 0.7;
      }
      if (round == MostRounds)
      {
        break;
      }
      const bool isDoubtful = this->Doubt(NoiseShare * wanted / ErrorOfSurprise);
      const bool isCut = this->Refine(this->Share * wanted);
      if (!isDoubtful && !isCut)
      {
        break;
      }
    }
    std::vector<Color> values(this->Spots->size(), Color(0.0));
    this->ForEachSurface([&](IndirectSurface& surface) { surface.Evaluate(values.data()); });
    return values;
  }

private:
  template <typename Action>
  void ForEachSurface(const Action& action)
  {
    tbb::parallel_for(
      std::size_t(0), this->Surfaces.size(), [&](std::size_t s) { action(this->Surfaces[s]); });
  }

  std::vector<Hit> MeetAround(
    std::uint32_t count, std::uint32_t batch, IndirectReport& report) const;
  RayOrigins OriginsOf(double rays) const;
  void LookAround(IndirectReport& report);
  void LightTheMet(IndirectReport& report);
  void Measure(IndirectReport& report);
  std::uint64_t MeasureAt(IndirectSurface::Cell& cell, std::uint32_t index) const;
  double ErrorToCut() const;
  bool Doubt(double goal);
  bool Refine(double goal);
  void Summarise(IndirectReport& report) const;

  const OccluderScene* Occluders;
  const RadianceSolution* Solution;
  LitSurfaces Lit;
  const std::vector<IndirectSpot>* Spots;
  IndirectSettings Settings;
  std::vector<IndirectSurface> Surfaces;
  std::uint32_t Rays;
  double Share = ShareOfModel;
  double UsualWeight = 0.0; ///< of the cells to start with
};

/// So many of the spots, in order, each as often as its weight says.
std::vector<std::uint32_t> DrawSpots(const std::vector<IndirectSpot>& spots, std::uint32_t count)
{
  double sum = 0.0;
  for (const IndirectSpot& spot : spots)
  {
    sum += spot.weight;
  }
  std::vector<std::uint32_t> drawn;
  double walked = 0.0;
  for (std::uint32_t i = 0; i < spots.size() && sum > 0.0; ++i)
  {
    walked += spots[i].weight;
    while (drawn.size() < count && (drawn.size() + 0.5) * sum < walked * count)
    {
      drawn.push_back(i);
    }
  }
  return drawn;
}

/// What rays from `count` of the spots meet. `batch` tells one such set from another.
std::vector<Hit> IndirectGatherer::MeetAround(
  std::uint32_t count, std::uint32_t batch, IndirectReport& report) const
{
  const std::vector<std::uint32_t> drawn = DrawSpots(*this->Spots, count);
  std::vector<std::optional<Hit>> met(drawn.size());
  tbb::parallel_for(std::size_t(0), drawn.size(),
    [&](std::size_t k)
    {
      const IndirectSpot& spot = (*this->Spots)[drawn[k]];
      const Frame frame(NormalOf(*this->Occluders, spot.patch));
      const Vec2 u = RandomStream(this->Settings.seed, k, batch).Next2();
      met[k] =
        this->Occluders->Intersect(spot.point, frame.ToWorld(CosineHemisphere(u)), spot.patch / 2);
    });
  report.gatherRays += drawn.size();
  std::vector<Hit> hits;
  for (const std::optional<Hit>& hit : met)
  {
    if (hit && this->Solution->IsActive(hit->Patch()))
    {
      hits.push_back(*hit);
    }
  }
  return hits;
}

/// Where so many rays start, about.
RayOrigins IndirectGatherer::OriginsOf(double rays) const
{
  RayOrigins origins;
  origins.rays = rays;
  for (const std::uint32_t i : DrawSpots(*this->Spots, OriginsToKnow))
  {
    const IndirectSpot& spot = (*this->Spots)[i];
    origins.places.push_back({ spot.point, NormalOf(*this->Occluders, spot.patch) });
  }
  return origins;
}

/// Lights a sample of what rays will meet for all of them. A few rays are better off alone.
void IndirectGatherer::LightTheMet(IndirectReport& report)
{
  double rays = 0.0;
  for (const IndirectSurface& surface : this->Surfaces)
  {
    rays += static_cast<double>(surface.Cells().size()) * this->Rays;
  }
  const double quiet = std::pow(NoiseOfLitRay / this->Settings.error, 2);
  const double wanted =
    std::clamp(std::max(rays * PartThatIsLit, quiet), LeastRaysAround, MostRaysInAll);
  if (wanted < rays)
  {
    const std::vector<Hit> sample = this->MeetAround(static_cast<std::uint32_t>(wanted), 0, report);
    report.shadowRays +=
      this->Lit.LightSample(sample, this->OriginsOf(wanted), Hash(this->Settings.seed, 3));
  }
}

/// Finds what counts for the spots, by rays from some of them, and betters what is known of that.
/// More are sent where the first ones say that they are not enough: where light comes through a
/// slit.
void IndirectGatherer::LookAround(IndirectReport& report)
{
  const double looks = std::pow(NoiseOfLook / this->Settings.error, 2);
  double wanted = std::clamp(looks / RaysOfHit, LeastRaysAround, MostRaysAround);
  SecondLook look(*this->Occluders, *this->Solution, RaysOfHit, Hash(this->Settings.seed, 2));
  double rays = 0.0;
  for (std::uint32_t batch = 1; rays < wanted && batch <= MostBatches; ++batch)
  {
    const auto missing = static_cast<std::uint32_t>(wanted - rays);
    look.From(this->MeetAround(missing, batch, report), this->Lit);
    rays += missing;
    const double excess = look.Noise() / (MostNoiseOfCorrection * this->Settings.error);
    wanted = std::min(rays * excess * excess, MostRaysInAll);
  }
  look.Apply(this->Lit);
  report.gatherRays += look.Rays();
  report.shadowRays += look.ShadowRays();
}

/// Gathers at the points of all cells that have not been measured.
void IndirectGatherer::Measure(IndirectReport& report)
{
  struct Task
  {
    IndirectSurface::Cell* cell;
    std::uint32_t spot;
    std::uint64_t shadowRays = 0;
  };
  std::vector<Task> tasks;
  double weight = 0.0;
  for (IndirectSurface& surface : this->Surfaces)
  {
    for (IndirectSurface::Cell& cell : surface.Cells())
    {
      if (cell.samples == 0)
      {
        tasks.push_back({ &cell, surface.Spot(cell.point).index, 0 });
        weight += cell.weight;
      }
    }
  }
  if (this->UsualWeight == 0.0 && !tasks.empty())
  {
    this->UsualWeight = weight / static_cast<double>(tasks.size());
  }
  tbb::parallel_for(std::size_t(0), tasks.size(),
    [&](std::size_t k) { tasks[k].shadowRays = this->MeasureAt(*tasks[k].cell, tasks[k].spot); });
  report.gatherPoints += tasks.size();
  for (const Task& task : tasks)
  {
    report.gatherRays += task.cell->samples;
    report.shadowRays += task.shadowRays;
  }
}

/// Returns the shadow rays that it took.
std::uint64_t IndirectGatherer::MeasureAt(IndirectSurface::Cell& cell, std::uint32_t index) const
{
  const IndirectSpot& spot = (*this->Spots)[index];
  // What few pixels see need not be as exact.
  const bool isSmall = cell.weight < SmallCell * this->UsualWeight;
  cell.samples = cell.effort * (isSmall ? this->Rays / 4 : this->Rays);
  const HemisphereEstimate estimate = GatherHemisphere(*this->Occluders, this->Lit, spot.patch,
    spot.point, cell.samples, Hash(this->Settings.seed, index));
  cell.value = estimate.irradiance;
  cell.noise = estimate.noise;
  return estimate.shadowRays;
}

/// What is worst first, until the sum is down to the goal, when each that is mended loses the part
/// `gain` of itself: the least that has to be mended.
double LimitToReach(double goal, double gain, std::vector<double> errors)
{
  double sum = std::accumulate(errors.begin(), errors.end(), 0.0);
  std::sort(errors.begin(), errors.end(), std::greater<double>());
  double limit = std::numeric_limits<double>::infinity();
  for (std::size_t k = 0; k < errors.size() && sum > goal; ++k)
  {
    sum -= gain * errors[k];
    limit = errors[k];
  }
  return limit;
}

/// Asks for more rays where noise is too much for the goal, and where it is far above the usual
/// one: where light comes through a small opening. Such places are dark, so they count little, but
/// they would look blotchy.
bool IndirectGatherer::Doubt(double goal)
{
  std::vector<double> noise;
  for (const IndirectSurface& surface : this->Surfaces)
  {
    for (const IndirectSurface::Cell& cell : surface.Cells())
    {
      noise.push_back(cell.weight * cell.noiseAround);
    }
  }
  const double limit = LimitToReach(goal, GainOfEffort, std::move(noise));
  std::size_t doubtful = 0;
  for (IndirectSurface& surface : this->Surfaces)
  {
    doubtful +=
      surface.Doubt(std::max(MostNoise * this->Settings.error, InvisibleNoise), limit, MostEffort);
  }
  return doubtful > 0;
}

/// Error of the models that cutting cells can mend.
double IndirectGatherer::ErrorToCut() const
{
  double error = 0.0;
  for (const IndirectSurface& surface : this->Surfaces)
  {
    for (const IndirectSurface::Cell& cell : surface.Cells())
    {
      error += IndirectSurface::ModelError(cell);
    }
  }
  return error;
}

/// Cuts the cells where the model fails most, as many as will bring that error down to the goal.
/// Returns whether any was.
bool IndirectGatherer::Refine(double goal)
{
  std::vector<double> errors;
  for (const IndirectSurface& surface : this->Surfaces)
  {
    for (const IndirectSurface::Cell& cell : surface.Cells())
    {
      errors.push_back(IndirectSurface::ModelError(cell));
    }
  }
  const double cells = static_cast<double>(errors.size());
  double limit = LimitToReach(goal, GainOfCut, std::move(errors));
  // Where none is much worse than the others, more of all of them is no cure.
  limit = std::max(limit, goal / cells);
  std::size_t cuts = 0;
  for (IndirectSurface& surface : this->Surfaces)
  {
    cuts += surface.Refine(limit);
  }
  return cuts > 0;
}

void IndirectGatherer::Summarise(IndirectReport& report) const
{
  report.sum = 0.0;
  report.error = 0.0;
  for (const IndirectSurface& surface : this->Surfaces)
  {
    for (const IndirectSurface::Cell& cell : surface.Cells())
    {
      report.sum += cell.weight * Mean(cell.value);
      report.error += ErrorOfSurprise * cell.weight * cell.surprise;
    }
  }
}

} // namespace

std::vector<Color> IndirectLight(const OccluderScene& occluders, const RadianceSolution& solution,
  const std::vector<IndirectSpot>& spots, const IndirectSettings& settings, IndirectReport& report)
{
  return IndirectGatherer(occluders, solution, spots, settings).Run(report);
}

} // namespace vantage
