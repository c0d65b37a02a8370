#include "EngineRun.h"

#include "Measure.h"

#include <cmath>

namespace vantage::benchmarks
{

namespace
{

Solver MakeSolver(const Scene& scene, const EngineSettings& settings)
{
  SolverSettings solverSettings;
  solverSettings.method = settings.method;
  solverSettings.importance = settings.importance;
  solverSettings.seed = settings.seed;
  return Solver(scene, solverSettings);
}

/// The picture as users get it: the gather has its share of the error.
void Gather(
  const Solver& solver, const Camera& camera, const EngineSettings& settings, EngineRun& run)
{
  GatherSettings pixels;
  pixels.width = pixels.height = settings.size;
  pixels.pixelCentres = settings.pixelCentres;
  pixels.error = std::max(GatherShare * settings.error, LeastGatherError);
  pixels.seed = settings.seed;
  const GatheredView view = solver.Gather(camera, pixels);
  run.image = view.radiance;
  run.view = view.report;
  run.estimate = std::hypot(run.solveEstimate, view.report.errorEstimate);
  run.rays += view.report.primaryRays + view.report.shadowRays + view.report.gatherRays +
              view.report.hitShadowRays;
}

} // namespace

EngineRun RunEngine(const Scene& scene, const Camera& camera, const EngineSettings& settings)
{
  EngineRun run;
  const Stopwatch building;
  Solver solver = MakeSolver(scene, settings);
  run.buildCpu = building.Cpu();

  const Stopwatch solving;
  solver.SetCamera(camera);
  Budget budget;
  budget.error = settings.error;
  budget.seconds = settings.seconds;
  solver.Run(budget);
  run.solveCpu = solving.Cpu();
  const StepReport& last = solver.History().back();
  run.estimate = run.solveEstimate = last.errorEstimate;
  run.rays = last.work.Rays();
  run.links = last.interactions;
  run.elements = last.elements;

  const Stopwatch looking;
  if (settings.method == Method::GoalOriented)
  {
    Gather(solver, camera, settings, run);
  }
  else
  {
    ElementImageSettings pixels;
    pixels.width = pixels.height = settings.size;
    pixels.pixelCentres = settings.pixelCentres;
    pixels.seed = settings.seed;
    run.image = solver.Render(camera, pixels);
  }
  run.imageCpu = looking.Cpu();
  return run;
}

} // namespace vantage::benchmarks
