#include "Commands.h"
#include "Measure.h"

#include "core/Solver.h"
#include "core/scene/Labyrinth.h"

#include <CLI/CLI.hpp>
#include <tbb/global_control.h>

#include <cstdint>
#include <cstdio>
#include <memory>
#include <vector>

namespace vantage::benchmarks
{

namespace
{

struct WalkOptions
{
  int seeds = 5;
  int rows = 4;
  int columns = 5;
  double error = 0.02;
};

/// From room to neighbouring room through all of the labyrinth, row by row to and fro, from near a
/// corner of each to the opposite one, at eye height.
std::vector<Camera> CamerasOfWalk(const WalkOptions& options)
{
  constexpr double RoomSize = 4.0;
  std::vector<Camera> cameras;
  for (int row = 0; row < options.rows; ++row)
  {
    for (int i = 0; i < options.columns; ++i)
    {
      const int column = row % 2 == 0 ? i : options.columns - 1 - i;
      Camera camera;
      camera.eye = Vec3(column * RoomSize + 1.0, row * RoomSize + 1.0, 1.6);
      camera.lookAt = camera.eye + Vec3(1.0, 1.0, -0.2);
      camera.up = Vec3(0.0, 0.0, 1.0);
      cameras.push_back(camera);
    }
  }
  return cameras;
}

struct Work
{
  double cpu = 0.0;
  std::uint64_t evaluations = 0;
  std::size_t links = 0; ///< that there are in the end
};

Work WorkOfView(Solver& solver, const Camera& camera, double error)
{
  const auto evaluations = [&solver]
  { return solver.History().empty() ? 0 : solver.History().back().work.Evaluations(); };
  Work work;
  const std::uint64_t before = evaluations();
  const Stopwatch watch;
  solver.SetCamera(camera);
  Budget budget;
  budget.error = error;
  solver.Run(budget);
  work.cpu = watch.Cpu();
  work.evaluations = evaluations() - before;
  work.links = solver.History().back().interactions;
  return work;
}

/// What the views but the first cost together, over what each costs on its own.
struct WalkRatios
{
  double cpu;
  double evaluations;
};

WalkRatios Walk(const WalkOptions& options, int seed)
{
  LabyrinthSettings rooms;
  rooms.rows = options.rows;
  rooms.columns = options.columns;
  rooms.seed = static_cast<std::uint64_t>(seed);
  const Scene scene = MakeLabyrinth(rooms);
  Solver walking(scene);
  Work walked;
  Work alone;
  int place = 0;
  for (const Camera& camera : CamerasOfWalk(options))
  {
    const Work next = WorkOfView(walking, camera, options.error);
    Solver fresh(scene);
    const Work first = WorkOfView(fresh, camera, options.error);
    std::printf("%d,%d,%.4f,%llu,%zu,%.4f,%llu,%zu\n", seed, place, next.cpu,
      static_cast<unsigned long long>(next.evaluations), next.links, first.cpu,
      static_cast<unsigned long long>(first.evaluations), first.links);
    std::fflush(stdout);
    if (place++ > 0)
    {
      walked.cpu += next.cpu;
      walked.evaluations += next.evaluations;
      alone.cpu += first.cpu;
      alone.evaluations += first.evaluations;
    }
  }
  return { walked.cpu / alone.cpu,
    static_cast<double>(walked.evaluations) / static_cast<double>(alone.evaluations) };
}

void RunWalks(const WalkOptions& options)
{
  const tbb::global_control oneThread(tbb::global_control::max_allowed_parallelism, 1);
  std::printf("seed,view,cpu s,evaluations,links,fresh cpu s,fresh evaluations,fresh links\n");
  std::vector<double> cpu;
  std::vector<double> evaluations;
  for (int seed = 1; seed <= options.seeds; ++seed)
  {
    const WalkRatios ratios = Walk(options, seed);
    cpu.push_back(ratios.cpu);
    evaluations.push_back(ratios.evaluations);
  }
  std::printf("# next views over fresh ones, median of %d walks: %.2f of the time, %.2f of the "
              "evaluations\n",
    options.seeds, Median(cpu), Median(evaluations));
}

} // namespace

void AddWalkCommand(CLI::App& app, Command& chosen)
{
  const auto options = std::make_shared<WalkOptions>();
  CLI::App* command = app.add_subcommand("walk",
    "Processor time of one thread for the solution of each view of a walk through all rooms of a "
    "labyrinth, and of the same view on its own, as CSV");
  command->add_option("--seeds", options->seeds, "Labyrinths: 1 to N")
    ->check(CLI::PositiveNumber)
    ->capture_default_str();
  command->add_option("--rows", options->rows, "Of rooms")
    ->check(CLI::PositiveNumber)
    ->capture_default_str();
  command->add_option("--columns", options->columns, "Of rooms")
    ->check(CLI::PositiveNumber)
    ->capture_default_str();
  command->add_option("--error", options->error, "Asked relative L1 error of each view")
    ->capture_default_str();
  command->callback([options, &chosen] { chosen = [options] { RunWalks(*options); }; });
}

} // namespace vantage::benchmarks
