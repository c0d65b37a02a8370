#include "CommandLine.h"
#include "ImageFile.h"
#include "ProgressBar.h"
#include "RenderOptions.h"
#include "RenderReport.h"
#include "SceneFile.h"
#include "SceneSummary.h"
#include "SolutionAdapter.h"
#include "VtkFile.h"
#include "io/AtomicFile.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <chrono>
#include <cmath>
#include <memory>
#include <tbb/global_control.h>

namespace vantage
{

namespace
{

/// Seconds since the last call of Lap().
class Stopwatch
{
public:
  double Lap()
  {
    const auto now = Clock::now();
    const std::chrono::duration<double> lap = now - this->Start;
    this->Start = now;
    return lap.count();
  }

private:
  using Clock = std::chrono::steady_clock;
  Clock::time_point Start = Clock::now();
};

void WriteImages(const RenderOptions& options, const Image& image)
{
  for (const std::string& output : options.outputs)
  {
    if (SuffixOf(output) != ".vtp")
    {
      WriteImage(image, output, options.toneMapping);
    }
  }
}

void WriteSolution(const RenderOptions& options, const Solver& solver)
{
  for (const std::string& output : options.outputs)
  {
    if (SuffixOf(output) == ".vtp")
    {
      WritePolyData(ElementsToPolyData(solver.Elements()), output);
    }
  }
  if (!options.links.empty())
  {
    WritePolyData(InteractionsToPolyData(solver.Interactions()), options.links);
  }
  if (!options.history.empty())
  {
    WriteTextAtomically(options.history, PrintHistory(solver.History()));
  }
}

/// The part of the budget that is used up, by the criterion that is nearest to its end. The error
/// falls geometrically, so its logarithm tells how far it is.
double FractionDone(const StepReport& step, const Budget& budget)
{
  const double bySteps = static_cast<double>(step.step) / static_cast<double>(budget.steps);
  const double byTime = step.seconds / budget.seconds;
  const double goal = std::max(budget.error, 1e-13);
  const double byError =
    step.errorEstimate < 1.0 ? std::log(std::max(step.errorEstimate, goal)) / std::log(goal) : 0.0;
  return std::max({ bySteps, byTime, byError });
}

void Solve(Solver& solver, const RenderOptions& options)
{
  const Budget budget = options.MakeBudget();
  ProgressBar bar(!options.quiet);
  solver.Run(budget,
    [&](const StepReport& step)
    {
      bar.Update(
        FractionDone(step, budget), "step " + std::to_string(step.step) + ", " + step.phase);
      return true;
    });
}

void Warn(const RenderOptions& options, const std::vector<std::string>& warnings)
{
  if (!options.quiet)
  {
    PrintWarnings(warnings);
  }
}

Image GatherImage(
  const RenderOptions& options, const Solver& solver, const Camera& camera, RenderReport& report)
{
  GatheredView view = solver.Gather(camera, options.MakeGatherSettings(camera));
  report.gather = view.report;
  report.rays += view.report.primaryRays + view.report.shadowRays + view.report.gatherRays;
  report.errorEstimate = std::hypot(report.errorEstimate, view.report.errorEstimate);
  return std::move(view.radiance);
}

Image RenderWithSolver(
  const RenderOptions& options, Scene scene, const Camera& camera, RenderReport& report)
{
  Stopwatch watch;
  Solver solver(std::move(scene), options.solver);
  solver.SetCamera(camera);
  Warn(options, solver.Warnings());
  report.buildSeconds = watch.Lap();
  Solve(solver, options);
  report.solveSeconds = watch.Lap();
  if (!solver.History().empty())
  {
    const StepReport& last = solver.History().back();
    report.viewFlux = last.viewFlux;
    report.errorEstimate = last.errorEstimate;
    report.elements = last.elements;
    report.interactions = last.interactions;
    report.work = last.work;
    report.rays = last.work.Rays();
    report.steps = last.step;
  }
  Image image;
  if (options.WantsImage())
  {
    image = options.IsGathered() ? GatherImage(options, solver, camera, report)
                                 : solver.Render(camera, options.MakeImageSettings(camera));
  }
  report.imageSeconds = watch.Lap();
  WriteSolution(options, solver);
  return image;
}

Image RenderWithPathTracer(
  const RenderOptions& options, const Scene& scene, const Camera& camera, RenderReport& report)
{
  Stopwatch watch;
  const FacetSet facets = BuildFacets(scene);
  const OccluderScene occluders(facets);
  const PathTracer tracer(scene, facets, occluders);
  Warn(options, SceneWarnings(scene, facets));
  report.buildSeconds = watch.Lap();
  const ElementImageSettings size = options.MakeImageSettings(camera);
  PathTracerReport figures;
  ProgressBar bar(!options.quiet);
  Image image =
    tracer.Render(camera, size.width, size.height, options.MakePathTracerSettings(), &figures, {},
      [&bar](double fraction)
      {
        bar.Update(fraction, "path tracing");
        return true;
      });
  report.solveSeconds = watch.Lap();
  report.viewFlux = ViewFluxOf(image, camera);
  report.errorEstimate = figures.relativeNoise;
  report.rays = figures.rays;
  report.steps = static_cast<std::uint64_t>(figures.samplesPerPixel);
  return image;
}

int Render(RenderOptions options)
{
  options.Resolve();
  const std::size_t allThreads =
    tbb::global_control::active_value(tbb::global_control::max_allowed_parallelism);
  const std::size_t threads = options.threads > 0 ? options.threads : allThreads;
  const tbb::global_control control(tbb::global_control::max_allowed_parallelism, threads);

  Stopwatch total;
  Stopwatch watch;
  RenderReport report;
  report.method = options.method;
  report.threads = static_cast<int>(threads);
  std::vector<std::string> warnings;
  Scene scene = ReadScene(options.scene, &warnings);
  const Camera camera = options.ChooseCamera(scene);
  Warn(options, warnings);
  report.loadSeconds = watch.Lap();

  const Image image = options.IsPathTracing()
                        ? RenderWithPathTracer(options, scene, camera, report)
                        : RenderWithSolver(options, std::move(scene), camera, report);
  WriteImages(options, image);
  report.totalSeconds = total.Lap();
  if (!options.report.empty())
  {
    WriteTextAtomically(options.report, PrintReport(report));
  }
  return 0;
}

} // namespace

void AddRenderCommand(CLI::App& app, Command& chosen)
{
  const auto options = std::make_shared<RenderOptions>();
  CLI::App* command = app.add_subcommand("render", "Solve a scene for a view and show it");
  DeclareRenderOptions(*command, *options);
  command->callback([options, &chosen] { chosen = [options] { return Render(*options); }; });
}

} // namespace vantage
