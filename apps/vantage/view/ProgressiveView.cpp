#include "view/ProgressiveView.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace vantage
{

namespace
{

struct Stage
{
  double error;
  int pixelsInOne; ///< in a row
};

/// Before the last one.
constexpr std::array<Stage, 4> Stages{ { { 0.3, 4 }, { 0.1, 2 }, { 0.05, 1 }, { 0.02, 1 } } };

} // namespace

ProgressiveView::ProgressiveView(Scene scene, const SolverSettings& settings, double error)
  : Error(error)
  , Worker([this, settings, given = std::move(scene)]() mutable
      { this->Work(std::move(given), settings); })
{
}

ProgressiveView::~ProgressiveView()
{
  {
    const std::lock_guard<std::mutex> lock(this->Guard);
    this->IsOver = true;
  }
  this->Change.notify_one();
  this->Worker.join();
}

void ProgressiveView::LookFrom(const Camera& camera, int width, int height)
{
  {
    const std::lock_guard<std::mutex> lock(this->Guard);
    this->Wanted = { camera, width, height };
  }
  this->Change.notify_one();
}

std::optional<ProgressiveView::Picture> ProgressiveView::Take()
{
  const std::lock_guard<std::mutex> lock(this->Guard);
  if (this->Failure)
  {
    std::rethrow_exception(this->Failure);
  }
  return std::exchange(this->Newest, std::nullopt);
}

void ProgressiveView::Work(Scene scene, const SolverSettings& settings)
{
  try
  {
    Solver solver(std::move(scene), settings);
    while (const std::optional<Request> request = this->NextRequest())
    {
      this->Show(solver, *request);
    }
  }
  catch (...)
  {
    const std::lock_guard<std::mutex> lock(this->Guard);
    this->Failure = std::current_exception();
  }
}

/// Waits for it. Nothing when all is over.
std::optional<ProgressiveView::Request> ProgressiveView::NextRequest()
{
  std::unique_lock<std::mutex> lock(this->Guard);
  this->Change.wait(lock, [this] { return this->IsOver || this->Wanted; });
  return this->IsOver ? std::nullopt : std::exchange(this->Wanted, std::nullopt);
}

void ProgressiveView::Show(Solver& solver, const Request& request)
{
  solver.SetCamera(request.camera);
  bool isFirst = true;
  for (const auto& [error, pixelsInOne] : Stages)
  {
    if (error > this->Error)
    {
      if (!this->ShowAt(solver, request, { error, pixelsInOne, isFirst, false }))
      {
        return;
      }
      isFirst = false;
    }
  }
  this->ShowAt(solver, request, { this->Error, 1, isFirst, true });
}

bool ProgressiveView::ShowAt(Solver& solver, const Request& request, const Step& step)
{
  const auto isWanted = [&] { return !this->IsGivenUp(step.isFirst); };
  Budget budget;
  budget.error = step.error;
  if (solver.Run(budget, [&](const StepReport&) { return isWanted(); }) == RunEnd::Cancelled)
  {
    return false;
  }
  GatherSettings settings;
  settings.width = std::max(1, request.width / step.pixelsInOne);
  settings.height = std::max(1, request.height / step.pixelsInOne);
  settings.error = std::clamp(GatherShare * step.error, LeastGatherError, 1.0);
  settings.seed = solver.Settings().seed;
  GatheredView view = solver.Gather(request.camera, settings, [&](double) { return isWanted(); });
  const std::lock_guard<std::mutex> lock(this->Guard);
  if (view.radiance.pixels.empty())
  {
    return false;
  }
  const StepReport& last = solver.History().back();
  this->Newest = Picture{ std::move(view.radiance),
    std::hypot(last.errorEstimate, view.report.errorEstimate), last.interactions, step.isLast };
  return true;
}

/// The first picture of a camera is given up at the end of all only.
bool ProgressiveView::IsGivenUp(bool isFirst)
{
  const std::lock_guard<std::mutex> lock(this->Guard);
  return this->IsOver || (this->Wanted && !isFirst);
}

} // namespace vantage
