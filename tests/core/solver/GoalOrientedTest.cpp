#include "core/Solver.h"

#include "core/goal/GoalScenes.h"
#include "core/math/Sampling.h"
#include "core/scene/Labyrinth.h"
#include "properties/RandomScene.h"
#include "support/TestScenes.h"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <algorithm>
#include <cmath>

namespace vantage
{
namespace
{

SolverSettings GoalSettings()
{
  SolverSettings settings;
  settings.method = Method::GoalOriented;
  settings.viewRays = 4096;
  return settings;
}

Solver MakeGoalSolver(const Scene& scene)
{
  return test::MakeSolver(scene, GoalSettings());
}

Budget Steps(std::uint64_t steps)
{
  Budget budget;
  budget.steps = steps;
  return budget;
}

Budget Error(double error)
{
  Budget budget;
  budget.error = error;
  return budget;
}

Image Picture(const Solver& solver, const Camera& camera, double error = 0.02)
{
  GatherSettings settings;
  settings.width = 24;
  settings.height = 24;
  settings.error = error;
  return solver.Gather(camera, settings).radiance;
}

double RelativeL1(const Image& found, const Image& expected)
{
  return Compare(found, expected).relativeL1;
}

/// What a camera sees of the radiance that gathering finds on fine interactions.
Image ReferencePicture(const Scene& scene, const Camera& camera)
{
  SolverSettings settings;
  settings.method = Method::GaussSeidel;
  settings.viewRays = 4096;
  settings.refinement.formFactorTolerance = 0.05;
  settings.refinement.powerTolerance = 3e-4;
  Solver solver = test::MakeSolver(scene, settings);
  solver.Run(Error(1e-4));
  return Picture(solver, camera, 0.01);
}

TEST(GoalOriented, TheEstimateFallsBelowTheGoalAndTheRunEnds)
{
  const Scene scene = test::MakeLitBox();
  std::size_t steps = 0;
  for (const double goal : { 0.3, 0.01, 0.003 })
  {
    SCOPED_TRACE("goal " + std::to_string(goal));
    Solver solver = MakeGoalSolver(scene);
    EXPECT_EQ(solver.Run(Error(goal)), RunEnd::Converged);
    const std::vector<StepReport>& history = solver.History();
    ASSERT_FALSE(history.empty());
    EXPECT_LE(history.back().errorEstimate, GoalShare * goal);
    EXPECT_GT(history.back().errorEstimate, 0.0);
    for (std::size_t i = 0; i < history.size(); ++i)
    {
      EXPECT_EQ(history[i].step, i + 1);
      EXPECT_EQ(history[i].phase, "refine");
      EXPECT_TRUE(i + 1 == history.size() || history[i].errorEstimate > GoalShare * goal);
      EXPECT_TRUE(i == 0 || history[i].work.Evaluations() > history[i - 1].work.Evaluations());
      EXPECT_TRUE(i == 0 || history[i].elements >= history[i - 1].elements);
    }
    EXPECT_EQ(history.back().interactions, solver.Interactions().size());
    EXPECT_GT(history.size(), steps);
    steps = history.size();
  }
}

TEST(GoalOriented, BeforeTheFirstStepThereIsWhatIsEmitted)
{
  const Scene scene = test::MakeLitBox();
  Solver solver(scene, GoalSettings());
  EXPECT_EQ(solver.Elements().radiance, solver.Elements().emission);
  solver.SetCamera(scene.cameras[0]);
  const ElementSolution elements = solver.Elements();
  EXPECT_EQ(elements.radiance, elements.emission);
  for (const Color& pixel : Picture(solver, scene.cameras[0]).pixels)
  {
    EXPECT_GE(std::min({ pixel.x, pixel.y, pixel.z }), 0.0);
  }
}

/// What links carry is what the elements have received: sum of the contributions = <P, L - E>.
TEST(GoalOriented, ContributionsOfTheLinksAddUpToWhatTheElementsReceive)
{
  Scene scene = test::MakeLitBox();
  for (Vec3& vertex : scene.vertices) // the block stands on nothing: all areas are exposed
  {
    vertex.z += vertex.x > 0.5 && vertex.x < 0.9 && vertex.z < 0.9 ? 0.1 : 0.0;
  }
  Solver solver = MakeGoalSolver(scene);
  solver.Run(Error(0.02));
  double carried = 0.0;
  double shot = 0.0;
  for (const InteractionRecord& link : solver.Interactions())
  {
    carried += link.contribution;
    shot += link.shotFlux;
  }
  const ElementSolution elements = solver.Elements();
  double received = 0.0;
  double incident = 0.0;
  for (std::size_t k = 0; k < elements.radiance.size(); ++k)
  {
    const double area = (*elements.tree)[elements.surface.elements[k]].area;
    const Color reflected = elements.radiance[k] - elements.emission[k];
    received += area * Mean(elements.importance[k] * reflected);
    incident += Pi * area * Mean(reflected / elements.albedo[k]);
  }
  // What the sweeps leave, a fiftieth of the error.
  EXPECT_NEAR(carried / received, 1.0, 0.02 / 50);
  EXPECT_NEAR(shot / incident, 1.0, 0.02 / 50);
}

TEST(GoalOriented, TwoRunsContinueAsOneWouldHaveGone)
{
  const Scene scene = test::MakeLitBox();
  Solver whole = MakeGoalSolver(scene);
  EXPECT_EQ(whole.Run(Steps(9)), RunEnd::Budget);
  Solver parts = MakeGoalSolver(scene);
  parts.Run(Steps(3));
  std::size_t seen = 0;
  EXPECT_EQ(parts.Run(Steps(4), [&](const StepReport&) { return ++seen < 2; }), RunEnd::Cancelled);
  parts.Run(Steps(4));
  ASSERT_EQ(whole.History().size(), 9u);
  ASSERT_EQ(parts.History().size(), 9u);
  for (std::size_t i = 0; i < 9; ++i)
  {
    EXPECT_EQ(parts.History()[i].errorEstimate, whole.History()[i].errorEstimate);
    EXPECT_EQ(parts.History()[i].work.Rays(), whole.History()[i].work.Rays());
  }
  EXPECT_EQ(parts.Elements().radiance, whole.Elements().radiance);
}

TEST(GoalOriented, APictureIsNotDarkWhereLittleIsReflected)
{
  // The first points that are drawn find all of it hidden: that is no estimate to stop at.
  LabyrinthSettings rooms;
  rooms.rows = 4;
  rooms.columns = 5;
  Scene scene = MakeLabyrinth(rooms);
  for (Material& material : scene.materials)
  {
    material.albedo *= 0.3;
  }
  Solver solver = MakeGoalSolver(scene);
  solver.Run(Error(0.2));
  EXPECT_GT(solver.Interactions().size(), 100u);
  EXPECT_GT(Mean(solver.ViewFluxOfRadiance()), 0.0);
}

TEST(GoalOriented, ACameraMoveKeepsLinksAndRadianceAndGoesOn)
{
  const Scene scene = test::MakeLitBox();
  Solver solver = MakeGoalSolver(scene);
  solver.Run(Error(0.05));
  const auto radiance = solver.Elements().radiance;
  const StepReport before = solver.History().back();
  Camera other = scene.cameras[0];
  std::swap(other.eye.x, other.lookAt.x);
  solver.SetCamera(other);
  EXPECT_EQ(solver.Elements().radiance, radiance);
  EXPECT_EQ(solver.Interactions().size(), before.interactions);
  // The first step looks at what is there, the next one refines.
  solver.Run(Steps(1));
  EXPECT_EQ(solver.History().back().interactions, before.interactions);
  EXPECT_EQ(solver.History().back().work.Evaluations(), before.work.Evaluations());
  EXPECT_EQ(solver.Run(Error(0.05)), RunEnd::Converged);
  const std::uint64_t moved = solver.History().back().work.Evaluations();

  Solver fresh(scene, GoalSettings());
  fresh.SetCamera(other);
  fresh.Run(Error(0.05));
  EXPECT_LT(moved - before.work.Evaluations(), fresh.History().back().work.Evaluations());
  EXPECT_LT(RelativeL1(Picture(solver, other), ReferencePicture(scene, other)), 0.06);
}

TEST(GoalOriented, TwiceTheEmissionIsTwiceTheLightOnTheSameLinks)
{
  Scene scene = test::MakeLitBox();
  Solver solver = MakeGoalSolver(scene);
  solver.Run(Error(0.05));
  const std::size_t links = solver.Interactions().size();
  const auto once = solver.Elements().radiance;
  for (Material& material : scene.materials)
  {
    material.emission *= 2.0;
  }
  solver.SetMaterials(scene.materials);
  EXPECT_EQ(solver.Interactions().size(), links);
  solver.Run(Steps(1));
  EXPECT_EQ(solver.Interactions().size(), links);
  const auto twice = solver.Elements().radiance;
  ASSERT_EQ(twice.size(), once.size());
  for (std::size_t i = 0; i < once.size(); ++i)
  {
    ASSERT_NEAR(Mean(twice[i]), 2.0 * Mean(once[i]), 0.02 * Mean(once[i])) << "element " << i;
  }
}

TEST(GoalOriented, TheSameMaterialsGiveTheSameLight)
{
  // Much light is reflected: what is left after some sweeps counts.
  for (const double albedo : { 0.5, 0.9, 0.97 })
  {
    SCOPED_TRACE("albedo " + std::to_string(albedo));
    const Scene scene = test::MakeFurnace(Color(albedo));
    Solver solver = MakeGoalSolver(scene);
    for (int run = 0; run < 2; ++run)
    {
      // At the largest albedo, elements are too large for an estimate of 2 %.
      EXPECT_EQ(solver.Run(Error(0.02)), albedo < 0.95 ? RunEnd::Converged : RunEnd::Exhausted);
      for (const Color& radiance : solver.Elements().radiance)
      {
        ASSERT_NEAR(Mean(radiance) * (1.0 - albedo), 1.0, 0.05) << "run " << run;
      }
      solver.SetMaterials(scene.materials);
    }
  }
}

TEST(GoalOriented, TheNumberOfThreadsChangesNothing)
{
  const Scene scene = test::MakeRandomScene(3);
  const auto solve = [&](int threads)
  {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
    Solver solver = MakeGoalSolver(scene);
    solver.Run(Error(0.05));
    return std::make_pair(solver.Elements().radiance, Picture(solver, scene.cameras[0]).pixels);
  };
  const auto expected = solve(1);
  EXPECT_EQ(solve(2), expected);
  EXPECT_EQ(solve(4), expected);
}

template <typename Map>
Scene Moved(Scene scene, const Map& map)
{
  for (Vec3& vertex : scene.vertices)
  {
    vertex = map(vertex);
  }
  for (Camera& camera : scene.cameras)
  {
    camera.up = map(camera.eye + camera.up) - map(camera.eye);
    camera.eye = map(camera.eye);
    camera.lookAt = map(camera.lookAt);
  }
  return scene;
}

TEST(GoalOriented, MotionsAndScalesChangeNoMoreThanTheErrorThatIsAskedFor)
{
  const auto solved = [](const Scene& scene)
  {
    Solver solver = MakeGoalSolver(scene);
    solver.Run(Error(0.05));
    return Picture(solver, scene.cameras[0]);
  };
  for (std::uint64_t seed = 1; seed <= 3; ++seed)
  {
    SCOPED_TRACE("seed " + std::to_string(seed));
    const Scene scene = test::MakeRandomScene(seed);
    const Image expected = solved(scene);
    const Frame turned(glm::normalize(Vec3(0.3, -0.5, 0.8)));
    EXPECT_LT(
      RelativeL1(solved(Moved(scene, [](const Vec3& x) { return 1e3 * x; })), expected), 0.07);
    EXPECT_LT(
      RelativeL1(solved(Moved(scene, [](const Vec3& x) { return 1e-3 * x; })), expected), 0.07);
    EXPECT_LT(RelativeL1(solved(Moved(scene, [](const Vec3& x) { return x + Vec3(50, -20, 10); })),
                expected),
      0.07);
    EXPECT_LT(
      RelativeL1(solved(Moved(scene, [&](const Vec3& x) { return turned.ToWorld(x); })), expected),
      0.07);
  }
}

TEST(GoalOriented, AgreesWithGatheringOnFineInteractions)
{
  std::vector<Scene> scenes{ test::MakeLitBox() };
  for (std::uint64_t seed = 1; seed <= 6; ++seed)
  {
    scenes.push_back(test::MakeRandomScene(seed));
  }
  std::vector<Image> references;
  for (const Scene& scene : scenes)
  {
    references.push_back(ReferencePicture(scene, scene.cameras[0]));
  }
  // The estimate is that of a random error: a single picture may miss its goal, by less than twice.
  for (const double goal : { 0.1, 0.05, 0.02 })
  {
    double sum = 0.0;
    for (std::size_t i = 0; i < scenes.size(); ++i)
    {
      Solver solver = MakeGoalSolver(scenes[i]);
      solver.Run(Error(goal));
      const double error =
        RelativeL1(Picture(solver, scenes[i].cameras[0], GatherShare * goal), references[i]);
      EXPECT_LT(error, 2.0 * goal) << "goal " << goal << ", scene " << i;
      sum += error / goal;
    }
    EXPECT_LT(sum / scenes.size(), 1.0) << "goal " << goal;
  }
}

/// Links, both of whose ends are in the last room of a row of four, after some thousand were made.
std::size_t LinksInTheLastRoom(const Scene& scene, bool importance)
{
  SolverSettings settings = GoalSettings();
  settings.importance = importance;
  Solver solver(scene, settings);
  solver.SetCamera(scene.FindCamera("view1"));
  solver.Run(Steps(200), [](const StepReport& report) { return report.interactions < 4000; });
  EXPECT_GE(solver.History().back().interactions, 4000u);
  const auto isThere = [](const InteractionRecord& link)
  { return link.shooterCentre.x > 12.0 && link.receiverCentre.x > 12.0; };
  const std::vector<InteractionRecord> links = solver.Interactions();
  return static_cast<std::size_t>(std::count_if(links.begin(), links.end(), isThere));
}

TEST(GoalOriented, ImportanceLeavesRoomsAloneThatTheCameraDoesNotSee)
{
  LabyrinthSettings size;
  size.rows = 1;
  size.columns = 4;
  const Scene scene = MakeLabyrinth(size);
  const std::size_t with = LinksInTheLastRoom(scene, true);
  const std::size_t without = LinksInTheLastRoom(scene, false);
  EXPECT_GT(without, 400u);
  EXPECT_LT(10 * with, without) << with;
}

TEST(GoalOriented, WithoutImportanceTheEstimateFallsBelowTheGoalAsWell)
{
  const Scene scene = test::MakeLitBox();
  SolverSettings settings = GoalSettings();
  settings.importance = false;
  Solver solver = test::MakeSolver(scene, settings);
  EXPECT_EQ(
    solver.Run(Error(0.2), [](const StepReport& report) { return report.interactions < 50000; }),
    RunEnd::Converged);
}

TEST(GoalOriented, ABudgetWithoutAnyLimitIsRefused)
{
  const Scene scene = test::MakeLitBox();
  Solver solver = MakeGoalSolver(scene);
  EXPECT_THROW(solver.Run(), InputError);
  EXPECT_TRUE(solver.History().empty());
  EXPECT_EQ(solver.Run(Steps(1)), RunEnd::Budget);
  Budget seconds;
  seconds.seconds = 0.01;
  EXPECT_EQ(solver.Run(seconds), RunEnd::Budget);
}

TEST(GoalOriented, NeedsACameraOnlyForImportance)
{
  const Scene scene = test::MakeLitBox();
  Solver refused(scene, GoalSettings());
  EXPECT_THROW(refused.Run(Steps(1)), InputError);
  SolverSettings settings = GoalSettings();
  settings.importance = false;
  Solver solver(scene, settings);
  EXPECT_EQ(solver.Run(Steps(5)), RunEnd::Budget);
  EXPECT_EQ(solver.History().size(), 5u);
}

TEST(GoalOriented, AClosedWhiteSceneIsRefused)
{
  const Scene scene = test::MakeFurnace(Color(1.0));
  Solver solver = MakeGoalSolver(scene);
  EXPECT_THROW(solver.Run(Error(0.1)), DivergenceError);
}

TEST(GoalOriented, AnErrorThatElementsAreTooLargeForEndsTheRun)
{
  SolverSettings settings;
  settings.refinement.minimumElementSize = 0.5;
  Solver solver = test::MakeSolver(test::MakeLitBox(), settings);
  EXPECT_EQ(solver.Run(Error(1e-4)), RunEnd::Exhausted);
  const StepReport last = solver.History().back();
  EXPECT_GT(last.errorEstimate, GoalShare * 1e-4);
  // It stays so, whatever else is asked for that is too much; what is not too much is there.
  EXPECT_EQ(solver.Run(Error(2e-4)), RunEnd::Exhausted);
  EXPECT_EQ(solver.History().back().step, last.step);
  EXPECT_EQ(
    solver.Run(Error(std::min(1.0, 1.01 * last.errorEstimate / GoalShare))), RunEnd::Converged);
}

TEST(GoalOriented, ADarkSceneIsBlack)
{
  const Scene scene = test::MakeFurnace(Color(0.5), Color(0.0));
  Solver solver = MakeGoalSolver(scene);
  EXPECT_EQ(solver.Run(Error(0.01)), RunEnd::Converged);
  EXPECT_EQ(solver.Warnings().size(), 1u);
  for (const Color& radiance : solver.Elements().radiance)
  {
    EXPECT_EQ(radiance, Color(0.0));
  }
  const Image picture = Picture(solver, scene.cameras[0]);
  EXPECT_EQ(picture.At(12, 12), Color(0.0));
}

TEST(GoalOriented, ACameraThatSeesNothingEndsAtOnce)
{
  const Scene scene = test::MakeLitBox();
  Solver solver = MakeGoalSolver(scene);
  Camera buried = scene.cameras[0];
  buried.eye = Vec3(0.7, 0.6, 0.2);
  buried.lookAt = Vec3(0.7, 0.7, 0.2);
  solver.SetCamera(buried);
  EXPECT_EQ(solver.Run(Error(0.05)), RunEnd::Converged);
  EXPECT_LE(solver.History().size(), 2u);
  EXPECT_EQ(solver.Warnings().size(), 1u);
  // Looking up again, it works.
  solver.SetCamera(scene.cameras[0]);
  EXPECT_EQ(solver.Run(Error(0.05)), RunEnd::Converged);
  EXPECT_GT(Mean(solver.ViewFluxOfRadiance()), 0.0);
}

} // namespace
} // namespace vantage
