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
#include <cstdio>
#include <memory>
#include <optional>
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

/// All of a run with one exposure: what a walk or a comparison of rooms asks for.
class ImageWriter
{
public:
  ImageWriter(const RenderOptions& options, std::size_t frames)
    : Options(options)
    , ToneMapping(options.toneMapping)
    , Frames(frames)
  {
  }

  /// The next frame. \param irradiance of a gathered one
  void Write(const Image& radiance, const Image& irradiance = {})
  {
    if (!this->ToneMapping.exposure)
    {
      this->ToneMapping.exposure = AutomaticExposure(radiance.pixels);
    }
    for (const std::string& output : this->Options.outputs)
    {
      if (SuffixOf(output) != ".vtp")
      {
        WriteImage(radiance, this->PathOf(output), this->ToneMapping);
      }
    }
    if (!this->Options.irradiance.empty())
    {
      WriteImage(irradiance, this->PathOf(this->Options.irradiance), this->ToneMapping);
    }
    ++this->Frame;
  }

  /// Nothing before the first image.
  std::optional<double> Exposure() const { return this->ToneMapping.exposure; }

private:
  std::string PathOf(const std::string& output) const
  {
    return RenderOptions::FramePath(output, this->Frame, this->Frames);
  }

  const RenderOptions& Options;
  ToneMappingSettings ToneMapping;
  std::size_t Frames;
  std::size_t Frame = 0; ///< that comes next
};

StepReport LastStep(const Solver& solver)
{
  return solver.History().empty() ? StepReport() : solver.History().back();
}

/// Gathered for the camera, or as they were solved on.
vtkSmartPointer<vtkPolyData> DrawElements(
  const RenderOptions& options, const Solver& solver, const Camera& camera)
{
  return options.IsGathered()
           ? ElementsToPolyData(solver.GatherElements(camera, options.ErrorOfElements()),
               LastStep(solver).errorEstimate)
           : ElementsToPolyData(solver.Elements());
}

void WriteSolution(const RenderOptions& options, const Solver& solver, const Camera& camera,
  const std::vector<FrameReport>& frames)
{
  for (const std::string& output : options.outputs)
  {
    if (SuffixOf(output) == ".vtp")
    {
      WritePolyData(DrawElements(options, solver, camera), output);
    }
  }
  if (!options.links.empty())
  {
    WritePolyData(InteractionsToPolyData(solver.Interactions()), options.links);
  }
  if (!options.history.empty())
  {
    WriteTextAtomically(options.history, PrintHistory(solver.History(), frames));
  }
}

void Warn(const RenderOptions& options, const std::vector<std::string>& warnings)
{
  if (!options.quiet)
  {
    PrintWarnings(warnings);
  }
}

/// What to do about an error that cannot be reached.
std::string AdviceOnError(const StepReport& last)
{
  char percent[32];
  std::snprintf(percent, sizeof percent, "%.2g %%", 100.0 * last.errorEstimate);
  return std::string("solution: its error stays at ") + percent +
         ", as elements are as small as they may be; give a smaller --minimum-element-size, "
         "a larger --maximum-level, or a larger --error";
}

void Solve(Solver& solver, const RenderOptions& options)
{
  const Budget budget = options.MakeBudget();
  const StepReport before = LastStep(solver);
  ProgressBar bar(!options.quiet);
  const RunEnd end = solver.Run(budget,
    [&](const StepReport& step)
    {
      bar.Update(FractionDone(budget, before, step),
        "step " + std::to_string(step.step) + ", " + step.phase);
      return true;
    });
  if (end == RunEnd::Exhausted)
  {
    Warn(options, { AdviceOnError(LastStep(solver)) });
  }
}

/// Radiance, and where it is gathered irradiance.
struct FrameImages
{
  Image radiance;
  Image irradiance;
};

FrameImages DrawFrame(
  const RenderOptions& options, const Solver& solver, const Camera& camera, FrameReport& frame)
{
  if (!options.IsGathered())
  {
    return { solver.Render(camera, options.MakeImageSettings(camera)), {} };
  }
  ProgressBar bar(!options.quiet);
  GatheredView view = solver.Gather(camera, options.MakeGatherSettings(camera),
    [&bar](double fraction)
    {
      bar.Update(fraction, "image");
      return true;
    });
  frame.gather = view.report;
  frame.errorEstimate = std::hypot(frame.errorEstimate, view.report.errorEstimate);
  return { std::move(view.radiance), std::move(view.irradiance) };
}

/// Solves for a camera, from where the solution stands.
FrameReport SolveFrame(const RenderOptions& options, Solver& solver, const Camera& camera)
{
  Stopwatch watch;
  const StepReport before = LastStep(solver);
  solver.SetCamera(camera);
  Warn(options, solver.Warnings());
  Solve(solver, options);
  const StepReport last = LastStep(solver);
  FrameReport frame;
  frame.camera = camera.name;
  frame.viewFlux = last.viewFlux;
  frame.errorEstimate = last.errorEstimate;
  frame.historyRows = solver.History().size();
  frame.steps = last.step - before.step;
  frame.evaluations = last.work.Evaluations() - before.work.Evaluations();
  frame.solverRays = last.work.Rays() - before.work.Rays();
  frame.solveSeconds = watch.Lap();
  return frame;
}

void Add(const FrameReport& frame, RenderReport& report)
{
  report.viewFlux = frame.viewFlux;
  report.errorEstimate = frame.errorEstimate;
  report.rays += frame.solverRays + frame.gather.primaryRays + frame.gather.shadowRays +
                 frame.gather.gatherRays + frame.gather.hitShadowRays;
  report.steps += frame.steps;
  report.solveSeconds += frame.solveSeconds;
  report.imageSeconds += frame.imageSeconds;
  report.frames.push_back(frame);
}

void RenderWithSolver(const RenderOptions& options, Scene scene, const std::vector<Camera>& cameras,
  RenderReport& report)
{
  Stopwatch watch;
  Solver solver(std::move(scene), options.solver);
  report.buildSeconds = watch.Lap();
  ImageWriter writer(options, cameras.size());
  for (const Camera& camera : cameras)
  {
    FrameReport frame = SolveFrame(options, solver, camera);
    if (options.WantsImage())
    {
      watch.Lap();
      const FrameImages images = DrawFrame(options, solver, camera, frame);
      frame.imageSeconds = watch.Lap();
      writer.Write(images.radiance, images.irradiance);
    }
    Add(frame, report);
  }
  report.exposure = writer.Exposure();
  const StepReport last = LastStep(solver);
  report.elements = last.elements;
  report.interactions = last.interactions;
  report.work = last.work;
  WriteSolution(options, solver, cameras.back(), report.frames);
}

void RenderWithPathTracer(
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
  const Image image =
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
  ImageWriter writer(options, 1);
  writer.Write(image);
  report.exposure = writer.Exposure();
}

int Render(RenderOptions options)
{
  options.Resolve();
  const std::size_t threads = ThreadsFor(options.threads);
  const tbb::global_control control(tbb::global_control::max_allowed_parallelism, threads);

  Stopwatch total;
  Stopwatch watch;
  RenderReport report;
  report.method = options.method;
  report.threads = static_cast<int>(threads);
  std::vector<std::string> warnings;
  Scene scene = ReadScene(options.scene, &warnings);
  const std::vector<Camera> cameras = options.ChooseCameras(scene);
  Warn(options, warnings);
  report.loadSeconds = watch.Lap();

  if (options.IsPathTracing())
  {
    RenderWithPathTracer(options, scene, cameras.front(), report);
  }
  else
  {
    RenderWithSolver(options, std::move(scene), cameras, report);
  }
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
