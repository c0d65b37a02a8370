#include "report/MethodRun.h"

#include "core/reference/PathTracer.h"
#include "io/TextLines.h"

#include <algorithm>
#include <cmath>
#include <ctime>

namespace vantage
{

namespace
{

/// Processor time of all threads of this process since it was made, s.
class CpuWatch
{
public:
  double Seconds() const
  {
    return static_cast<double>(std::clock() - this->Start) / static_cast<double>(CLOCKS_PER_SEC);
  }

private:
  std::clock_t Start = std::clock();
};

void Judge(const Target& target, const Image& image, Measurement& measurement)
{
  const ImageDifference difference = Compare(image, target.reference);
  measurement.error = difference.relativeL1;
  measurement.rmse = difference.relativeRmse;
  measurement.bias = difference.relativeBias;
}

/// A run of one of the methods of the solver.
class SolverRun
{
public:
  SolverRun(const Target& target, const RunPlan& plan, const RunObserver& observer)
    : Goal(target)
    , Plan(plan)
    , Observer(observer)
    , Engine(target.scene, SettingsOf(plan))
  {
    const CpuWatch watch;
    this->Engine.SetCamera(target.camera);
    this->SolveCpu = watch.Seconds();
  }

  void Run()
  {
    const double example = this->ExampleBudget();
    bool hasTime = true;
    for (std::size_t k = 0; k < this->Plan.budgets.size() && hasTime; ++k)
    {
      const double error = this->Plan.budgets[k];
      hasTime = this->SolveTo(error, k);
      if (this->Plan.method != NameOf(Method::GoalOriented))
      {
        this->MeasureElements(error, !hasTime);
      }
      this->MeasureGathered(error, !hasTime);
      if (error == example || (!hasTime && error > example))
      {
        this->Observer.solved(this->Engine);
      }
    }
  }

private:
  static SolverSettings SettingsOf(const RunPlan& plan)
  {
    SolverSettings settings;
    settings.method = MethodFromName(plan.method);
    settings.seed = plan.seed;
    if (plan.powerTolerance)
    {
      RefinementSettings& refinement = settings.refinement;
      refinement.shadowTolerance *= *plan.powerTolerance / refinement.powerTolerance;
      refinement.powerTolerance = *plan.powerTolerance;
    }
    return settings;
  }

  double ExampleBudget() const
  {
    return *std::min_element(this->Plan.budgets.begin(), this->Plan.budgets.end(),
      [](double a, double b)
      { return std::abs(std::log(a / ExampleError)) < std::abs(std::log(b / ExampleError)); });
  }

  /// False when the time was up before.
  bool SolveTo(double error, std::size_t k)
  {
    Budget budget;
    budget.error = error;
    const double stops = static_cast<double>(this->Plan.budgets.size());
    const double left = std::max(this->Plan.seconds - this->SolveCpu, 1e-9);
    const CpuWatch watch;
    const RunEnd end = this->Engine.Run(budget,
      [&](const StepReport&)
      {
        const double spent = watch.Seconds() / left;
        this->Observer.progressed((static_cast<double>(k) + std::min(spent, 1.0)) / stops);
        return spent < 1.0;
      });
    this->SolveCpu += watch.Seconds();
    return end != RunEnd::Cancelled;
  }

  Measurement Begin(const std::string& picture, double budget, bool isCutShort) const
  {
    const std::vector<StepReport>& history = this->Engine.History();
    const StepReport last = history.empty() ? StepReport() : history.back();
    Measurement m;
    m.method = this->Plan.method;
    m.picture = picture;
    m.powerTolerance = this->Plan.powerTolerance.value_or(0.0);
    m.budget = budget;
    m.isCutShort = isCutShort;
    m.steps = last.step;
    m.elements = last.elements;
    m.interactions = last.interactions;
    m.evaluations = last.work.Evaluations();
    m.rays = last.work.Rays();
    m.errorEstimate = last.errorEstimate;
    m.solveCpuSeconds = this->SolveCpu;
    return m;
  }

  void MeasureElements(double error, bool isCutShort) const
  {
    ElementImageSettings settings;
    settings.width = this->Goal.width;
    settings.height = this->Goal.height;
    settings.pixelCentres = true;
    Measurement m = this->Begin(picture::Elements, error, isCutShort);
    const CpuWatch watch;
    const Image image = this->Engine.Render(this->Goal.camera, settings);
    m.imageCpuSeconds = watch.Seconds();
    m.rays += image.pixels.size();
    Judge(this->Goal, image, m);
    this->Observer.measured(m, image);
  }

  void MeasureGathered(double error, bool isCutShort) const
  {
    GatherSettings settings;
    settings.width = this->Goal.width;
    settings.height = this->Goal.height;
    settings.error = std::clamp(GatherShare * error, LeastGatherError, 1.0);
    settings.pixelCentres = true;
    settings.seed = this->Plan.seed;
    Measurement m = this->Begin(picture::Gathered, error, isCutShort);
    const CpuWatch watch;
    const GatheredView view = this->Engine.Gather(this->Goal.camera, settings);
    m.imageCpuSeconds = watch.Seconds();
    m.rays += view.report.primaryRays + view.report.shadowRays + view.report.gatherRays +
              view.report.hitShadowRays;
    m.errorEstimate = std::hypot(m.errorEstimate, view.report.errorEstimate);
    Judge(this->Goal, view.radiance, m);
    this->Observer.measured(m, view.radiance);
  }

  const Target& Goal;
  const RunPlan& Plan;
  const RunObserver& Observer;
  Solver Engine;
  double SolveCpu = 0.0; ///< so far, s
};

void RunPathTracer(const Target& target, const RunPlan& plan, const RunObserver& observer)
{
  const FacetSet facets = BuildFacets(target.scene);
  const OccluderScene occluders(facets);
  const PathTracer tracer(target.scene, facets, occluders);
  double left = plan.seconds;
  for (std::size_t k = 0; k < plan.budgets.size() && left > 0.0; ++k)
  {
    PathTracerSettings settings;
    settings.samplesPerPixel = static_cast<int>(plan.budgets[k]);
    settings.pixelCentres = true;
    settings.seed = plan.seed;
    PathTracerReport report;
    const CpuWatch watch;
    const Image image =
      tracer.Render(target.camera, target.width, target.height, settings, &report, {},
        [&](double part)
        {
          observer.progressed(
            (static_cast<double>(k) + part) / static_cast<double>(plan.budgets.size()));
          return watch.Seconds() < left;
        });
    Measurement m;
    m.imageCpuSeconds = watch.Seconds();
    left -= m.imageCpuSeconds;
    m.method = plan.method;
    m.picture = picture::Traced;
    m.budget = plan.budgets[k];
    m.steps = static_cast<std::uint64_t>(report.samplesPerPixel);
    m.isCutShort = report.samplesPerPixel < settings.samplesPerPixel;
    m.rays = report.rays;
    m.errorEstimate = report.relativeNoise;
    Judge(target, image, m);
    observer.measured(m, image);
  }
}

} // namespace

std::string RunPlan::Identity() const
{
  std::string text = "method " + this->method;
  if (this->powerTolerance)
  {
    text += " power-tolerance " + PrintNumber(*this->powerTolerance);
  }
  text += " budgets";
  for (const double budget : this->budgets)
  {
    text += ' ' + PrintNumber(budget);
  }
  return text + " seconds " + PrintNumber(this->seconds) + " seed " + std::to_string(this->seed) +
         " threads " + std::to_string(this->threads);
}

std::string RunPlan::Title() const
{
  return this->method + (this->powerTolerance
                            ? ", power tolerance " + PrintNumber(*this->powerTolerance)
                            : std::string());
}

void RunMethod(const Target& target, const RunPlan& plan, const RunObserver& observer)
{
  if (plan.method == PathTracingName)
  {
    RunPathTracer(target, plan, observer);
  }
  else
  {
    SolverRun(target, plan, observer).Run();
  }
}

} // namespace vantage
