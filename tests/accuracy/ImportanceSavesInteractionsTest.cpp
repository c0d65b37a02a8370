#include "accuracy/References.h"
#include "core/scene/Labyrinth.h"

#include <gtest/gtest.h>

#include <limits>

namespace vantage
{
namespace
{

constexpr double Goal = 0.05; ///< relative L1 of the view

/// Evaluations of pairs at the last look that missed the goal and at the first that reached it.
struct Bracket
{
  double missing = 0.0;
  double reached = std::numeric_limits<double>::infinity();
};

/// A labyrinth, its first view, and the picture of that view when nothing is left to shoot.
/// Elements and interactions are the same for all methods and orders, so the picture is that of all
/// of them, without any error of discretisation in between.
class Rooms
{
public:
  Rooms(int rows, int columns)
  {
    LabyrinthSettings size;
    size.rows = rows;
    size.columns = columns;
    this->TheScene = MakeLabyrinth(size);
    this->View = test::SquareCamera(this->TheScene, "view1");
    this->Pixels.width = this->Pixels.height = 64;
    this->Pixels.pixelCentres = true;
    this->Pixels.flat = true;
    SolverSettings settings;
    settings.method = Method::ImportanceShooting;
    const Solver solver = test::Solved(this->TheScene, this->View, settings, 1e-4);
    this->Converged = solver.Render(this->View, this->Pixels);
  }

  /// Runs a method until its picture is within the goal, looking at it every `stepsBetween` steps;
  /// gives up when it is not after `mostEvaluations`.
  Bracket EvaluationsToGoal(Method method, std::uint64_t stepsBetween,
    double mostEvaluations = std::numeric_limits<double>::infinity()) const
  {
    SolverSettings settings;
    settings.method = method;
    Solver solver(this->TheScene, settings);
    solver.SetCamera(this->View);
    Budget budget;
    budget.steps = stepsBetween;
    Bracket bracket;
    while (bracket.missing <= mostEvaluations)
    {
      const RunEnd end = solver.Run(budget);
      const double evaluations = static_cast<double>(solver.History().back().work.Evaluations());
      const Image image = solver.Render(this->View, this->Pixels);
      const double error = Compare(image, this->Converged).relativeL1;
      if (error <= Goal)
      {
        bracket.reached = evaluations;
        break;
      }
      bracket.missing = evaluations;
      if (end == RunEnd::Converged)
      {
        ADD_FAILURE() << NameOf(method) << " converged with an error of " << error;
        break;
      }
    }
    return bracket;
  }

private:
  Scene TheScene;
  Camera View;
  ElementImageSettings Pixels;
  Image Converged;
};

/// The claim of Bekaert and Willems (1995). The ratio is bounded from below: importance is charged
/// up to the look that found the goal reached, progressive shooting up to the last that did not.
TEST(ImportanceSavesInteractions, FourTimesIn20RoomsAndMoreIn100)
{
  const Rooms few(4, 5);
  const double importanceFew = few.EvaluationsToGoal(Method::ImportanceShooting, 50).reached;
  const double progressiveFew = few.EvaluationsToGoal(Method::ProgressiveShooting, 25).missing;
  const double ratioFew = progressiveFew / importanceFew;
  test::Record("20 rooms importance", importanceFew);
  test::Record("20 rooms progressive", progressiveFew);
  test::Record("20 rooms ratio", ratioFew);
  EXPECT_GE(ratioFew, 4.0);

  // Progressive shooting goes on only until the ratio of the small scene is surpassed for sure.
  const Rooms many(10, 10);
  const double importanceMany = many.EvaluationsToGoal(Method::ImportanceShooting, 100).reached;
  const double enough = 1.5 * ratioFew * importanceMany;
  const double progressiveMany =
    many.EvaluationsToGoal(Method::ProgressiveShooting, 100, enough).missing;
  test::Record("100 rooms importance", importanceMany);
  test::Record("100 rooms progressive is not there after", progressiveMany);
  EXPECT_GT(progressiveMany, enough);
}

} // namespace
} // namespace vantage
