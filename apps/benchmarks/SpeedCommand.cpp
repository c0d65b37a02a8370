#include "Commands.h"
#include "EngineRun.h"
#include "Measure.h"

#include "core/mesh/Facets.h"
#include "core/reference/PathTracer.h"
#include "core/scene/Labyrinth.h"
#include "core/visibility/OccluderScene.h"
#include "support/ReferenceImage.h"
#include "support/StudyScenes.h"

#include <CLI/CLI.hpp>
#include <tbb/global_control.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <limits>
#include <map>
#include <memory>
#include <string>
#include <vector>

namespace vantage::benchmarks
{

namespace
{

constexpr int PictureSize = 256;
/// Over the one asked for before: the fourth root of 1/2.
constexpr double NextAskedError = 0.8408964152537145;
constexpr double Never = std::numeric_limits<double>::infinity();

struct SpeedOptions
{
  int seeds = 5;
  int fewRooms = 20;
  int middleRooms = 100;
  int manyRooms = 10000;
  double goal = 0.01; ///< true relative L1 error
  double finerGoal = 0.003;
  double tracedGoal = 0.1;
  std::string method = NameOf(Method::GoalOriented);
  std::string cache = "references";
};

/// A view to be reached, and how far it is.
class Target
{
public:
  Target(int rooms, std::uint64_t seed, const std::string& cache)
    : Rooms(test::MakeLabyrinthOf(rooms, seed))
    , View(Rooms.FindCamera("view1"))
  {
    this->View.aspect = 1.0;
    this->Judge.size = PictureSize;
    this->Judge.stride = 4;
    // Light that has come through five doors is no light any more.
    const Scene near = test::PartAround(this->Rooms, this->View.eye, 20.0);
    this->Exact = test::CachedReference(cache,
      "speed-" + std::to_string(rooms) + "-" + std::to_string(seed), near, this->View, this->Judge);
  }

  const Scene& GetScene() const { return this->Rooms; }
  const Camera& GetView() const { return this->View; }
  double Noise() const { return this->Exact.noise; }

  /// From a part of the pixels, evenly spread.
  double ErrorOf(const Image& picture) const
  {
    return Compare(test::EveryPixel(picture, this->Judge.stride), this->Exact.image).relativeL1;
  }

private:
  Scene Rooms;
  Camera View;
  test::ReferenceSettings Judge;
  test::ReferenceImage Exact;
};

/// Processor time of a picture.
struct Cost
{
  double solve = Never;
  double image = 0.0;
  double error = Never; ///< true
  double All() const { return this->solve + this->image; }
};

Cost CostOf(const Target& target, const EngineSettings& engine)
{
  const EngineRun run = RunEngine(target.GetScene(), target.GetView(), engine);
  const Cost cost{ run.solveCpu, run.imageCpu, target.ErrorOf(run.image) };
  std::printf("# asked %.5f, estimated %.5f, true %.5f, %.4f s + %.4f s\n", engine.error,
    run.estimate, cost.error, cost.solve, cost.image);
  std::fflush(stdout);
  return cost;
}

/// Of the first picture whose true error is within the goal, over ever smaller asked errors; each
/// is a run from the scene on. The median of three runs of that.
Cost CpuToGoal(const Target& target, EngineSettings engine, double goal)
{
  for (engine.error = 0.2; engine.error > 0.05 * goal; engine.error *= NextAskedError)
  {
    std::array<Cost, 3> costs{ CostOf(target, engine), {}, {} };
    if (costs[0].error <= goal)
    {
      costs[1] = CostOf(target, engine);
      costs[2] = CostOf(target, engine);
      std::sort(
        costs.begin(), costs.end(), [](const Cost& a, const Cost& b) { return a.All() < b.All(); });
      return costs[1];
    }
  }
  return {};
}

/// The same of the path tracer. Its error falls with the root of the samples: twice as many until
/// the goal is passed, then in between.
double PathTracingCpuToGoal(const Target& target, std::uint64_t seed, double goal)
{
  const FacetSet facets = BuildFacets(target.GetScene());
  const OccluderScene occluders(facets);
  const PathTracer tracer(target.GetScene(), facets, occluders);
  PathTracerSettings settings;
  settings.pixelCentres = true;
  settings.seed = seed;
  double lastError = Never;
  double lastCpu = 0.0;
  for (settings.samplesPerPixel = 1; settings.samplesPerPixel <= 4096;
       settings.samplesPerPixel *= 2)
  {
    const Stopwatch watch;
    const Image picture = tracer.Render(target.GetView(), PictureSize, PictureSize, settings);
    const double cpu = watch.Cpu();
    const double error = target.ErrorOf(picture);
    std::printf("# %d samples a pixel, true %.5f, %.4f s\n", settings.samplesPerPixel, error, cpu);
    if (error <= goal)
    {
      // Both logarithms are nearly linear in the number of samples.
      const double part =
        lastCpu > 0.0 ? std::log(lastError / goal) / std::log(lastError / error) : 1.0;
      return lastCpu > 0.0 ? lastCpu * std::pow(cpu / lastCpu, part) : cpu;
    }
    lastError = error;
    lastCpu = cpu;
  }
  return Never;
}

/// True error after so many seconds of solving. The picture is gathered for the goal, so that what
/// is compared is what the solutions are worth.
double ErrorInTime(const Target& target, EngineSettings engine, double goal, double seconds)
{
  std::printf("# in the same time\n");
  engine.error = goal;
  engine.seconds = seconds;
  return CostOf(target, engine).error;
}

/// When all surfaces matter alike.
struct WithoutImportance
{
  double error = Never; ///< true, over that with importance, in the same time of solving
  double time = Never;  ///< to the same goal, over that with importance
};

WithoutImportance CostWithoutImportance(const Target& target, EngineSettings engine, double goal)
{
  const Cost with = CpuToGoal(target, engine, goal);
  if (!std::isfinite(with.All()))
  {
    return {};
  }
  const double errorWith = ErrorInTime(target, engine, goal, with.solve);
  engine.importance = false;
  std::printf("# without importance\n");
  const double errorWithout = ErrorInTime(target, engine, goal, with.solve);
  return { errorWithout / errorWith, CpuToGoal(target, engine, goal).All() / with.All() };
}

/// The picture with pixels that are integrated over their area against one of their centres.
double CostOfAntialiasing(const Target& target, EngineSettings engine, double goal)
{
  engine.error = goal;
  const EngineRun centres = RunEngine(target.GetScene(), target.GetView(), engine);
  engine.pixelCentres = false;
  const EngineRun areas = RunEngine(target.GetScene(), target.GetView(), engine);
  return (areas.solveCpu + areas.imageCpu) / (centres.solveCpu + centres.imageCpu);
}

/// Values of one line of the table, one a seed.
using Table = std::map<std::string, std::vector<double>>;

void MeasureSeed(const SpeedOptions& options, std::uint64_t seed, Table& table)
{
  EngineSettings engine;
  engine.method = MethodFromName(options.method);
  engine.size = PictureSize;
  engine.seed = seed;
  const Target few(options.fewRooms, seed, options.cache);
  std::printf("# seed %d, noise of the reference %.5f\n", static_cast<int>(seed), few.Noise());
  const double fewCpu = CpuToGoal(few, engine, options.goal).All();
  const double traced = PathTracingCpuToGoal(few, seed, options.tracedGoal);
  table["few rooms, to the goal, s"].push_back(fewCpu);
  table["path tracing, to its goal, s"].push_back(traced);
  table["ratio to path tracing"].push_back(fewCpu / traced);
  table["few rooms, to the finer goal, s"].push_back(
    CpuToGoal(few, engine, options.finerGoal).All());
  table["antialiased over pixel centres"].push_back(CostOfAntialiasing(few, engine, options.goal));
  if (options.middleRooms > 0)
  {
    const Target middle(options.middleRooms, seed, options.cache);
    const WithoutImportance without = CostWithoutImportance(middle, engine, options.goal);
    table["without importance, error over that with in the same time"].push_back(without.error);
    table["without importance, time to the goal over that with"].push_back(without.time);
  }
  if (options.manyRooms > 0)
  {
    const Target many(options.manyRooms, seed, options.cache);
    const double manyCpu = CpuToGoal(many, engine, options.goal).All();
    table["many rooms, to the goal, s"].push_back(manyCpu);
    table["many rooms over few"].push_back(manyCpu / fewCpu);
  }
}

void RunSpeed(const SpeedOptions& options)
{
  const tbb::global_control oneThread(tbb::global_control::max_allowed_parallelism, 1);
  Table table;
  for (int seed = 1; seed <= options.seeds; ++seed)
  {
    MeasureSeed(options, static_cast<std::uint64_t>(seed), table);
  }
  std::printf("measure,median,seeds\n");
  for (const auto& [name, values] : table)
  {
    std::printf("\"%s\",%.4f,%zu\n", name.c_str(), Median(values), values.size());
  }
}

} // namespace

void AddSpeedCommand(CLI::App& app, Command& chosen)
{
  const auto options = std::make_shared<SpeedOptions>();
  CLI::App* command = app.add_subcommand("speed",
    "Processor time of one thread to a true error: labyrinths of seeds 1 to N, 256 x 256 pixels");
  command->add_option("--seeds", options->seeds, "Labyrinths")->capture_default_str();
  command->add_option("--few", options->fewRooms, "Rooms of the small one")->capture_default_str();
  command->add_option("--middle", options->middleRooms, "Rooms of that without importance; 0: none")
    ->capture_default_str();
  command->add_option("--many", options->manyRooms, "Rooms of the large one; 0: without")
    ->capture_default_str();
  command->add_option("--goal", options->goal, "True relative L1 error")->capture_default_str();
  command->add_option("--finer-goal", options->finerGoal, "The same, harder")
    ->capture_default_str();
  command->add_option("--traced-goal", options->tracedGoal, "The same, for the path tracer")
    ->capture_default_str();
  command->add_option("--method", options->method, "Of the solver")->capture_default_str();
  command->add_option("--cache", options->cache, "Folder of the reference images")
    ->envname("VANTAGE_REFERENCES")
    ->capture_default_str();
  command->callback([options, &chosen] { chosen = [options] { RunSpeed(*options); }; });
}

} // namespace vantage::benchmarks
