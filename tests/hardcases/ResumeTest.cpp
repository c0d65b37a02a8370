#include "hardcases/HardCase.h"
#include "support/TestScenes.h"

namespace vantage
{
namespace
{

/// What a run leaves behind, but for its times.
struct Trace
{
  std::vector<Color> radiance, importance;
  std::vector<double> numbers; ///< of the history and of the interactions

  bool operator==(const Trace& other) const
  {
    return this->radiance == other.radiance && this->importance == other.importance &&
           this->numbers == other.numbers;
  }
};

Trace TraceOf(const Solver& solver)
{
  Trace trace;
  const ElementSolution elements = solver.Elements();
  trace.radiance = elements.radiance;
  trace.importance = elements.importance;
  for (const StepReport& report : solver.History())
  {
    trace.numbers.insert(trace.numbers.end(),
      { double(report.step), report.errorEstimate, report.viewFlux, double(report.interactions),
        double(report.work.Evaluations()), double(report.work.Rays()) });
  }
  for (const InteractionRecord& link : solver.Interactions())
  {
    trace.numbers.insert(
      trace.numbers.end(), { double(link.shooter), double(link.receiver), link.formFactor,
                             link.shotFlux, double(link.step) });
  }
  return trace;
}

struct Run
{
  Method method;
  Granularity granularity;
  std::uint64_t steps;
};

void PrintTo(const Run& run, std::ostream* stream)
{
  *stream << NameOf(run.method) << " " << NameOf(run.granularity);
}

class Resumed : public testing::TestWithParam<Run>
{
protected:
  Solver MakeSolver() const
  {
    SolverSettings settings;
    settings.method = this->GetParam().method;
    settings.granularity = this->GetParam().granularity;
    const Scene scene = test::MakeLitBox();
    Solver solver(scene, settings);
    solver.SetCamera(scene.cameras[0]);
    return solver;
  }

  /// Runs to the same step in pieces that end wherever `runPiece` lets them.
  template <typename Function>
  Trace InPieces(const Function& runPiece) const
  {
    Solver solver = this->MakeSolver();
    const std::uint64_t last = this->GetParam().steps;
    std::uint64_t done = 0;
    for (int piece = 0; done < last; ++piece)
    {
      Budget budget;
      budget.steps = last - done;
      runPiece(solver, budget, piece);
      done = solver.History().empty() ? 0 : solver.History().back().step;
    }
    return TraceOf(solver);
  }
};

/// Oracle: the run that nobody interrupts. The same to the bit.
TEST_P(Resumed, WhereverItIsCutARunGoesOnAsIfNothingHadHappened)
{
  Solver whole = this->MakeSolver();
  Budget budget;
  budget.steps = this->GetParam().steps;
  whole.Run(budget);
  const Trace expected = TraceOf(whole);
  EXPECT_TRUE(expected == this->InPieces([](Solver& solver, const Budget& rest, int)
                            { solver.Run(rest, [](const StepReport&) { return false; }); }))
    << "cancelled after every step";
  EXPECT_TRUE(expected == this->InPieces(
                            [](Solver& solver, Budget rest, int)
                            {
                              rest.steps = 1;
                              solver.Run(rest);
                            }))
    << "one step at a time";
  EXPECT_TRUE(expected == this->InPieces(
                            [](Solver& solver, Budget rest, int piece)
                            {
                              // From no time at all to a few milliseconds: in the middle of steps.
                              rest.seconds = 1e-6 * std::pow(1.5, piece % 24);
                              solver.Run(rest);
                            }))
    << "out of time again and again";
}

INSTANTIATE_TEST_SUITE_P(HardCase, Resumed,
  testing::Values(Run{ Method::BasicShooting, Granularity::Patch, 8 },
    Run{ Method::BasicShooting, Granularity::Interaction, 25 },
    Run{ Method::ProgressiveShooting, Granularity::Patch, 8 },
    Run{ Method::ProgressiveShooting, Granularity::Interaction, 25 },
    Run{ Method::ImportanceShooting, Granularity::Patch, 8 },
    Run{ Method::ImportanceShooting, Granularity::Interaction, 25 },
    Run{ Method::GaussSeidel, Granularity::Patch, 8 },
    Run{ Method::GoalOriented, Granularity::Patch, 8 }));

} // namespace
} // namespace vantage
