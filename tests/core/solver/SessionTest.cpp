#include "core/Solver.h"
#include "core/scene/Labyrinth.h"
#include "support/TestScenes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace vantage
{
namespace
{

SolverSettings CoarseSettings(Method method, Granularity granularity = Granularity::Patch)
{
  SolverSettings settings;
  settings.method = method;
  settings.granularity = granularity;
  settings.refinement.minimumElementSize = 0.3;
  settings.viewRays = 4096;
  return settings;
}

Solver MakeSolver(const Scene& scene, Method method)
{
  Solver solver(scene, CoarseSettings(method));
  solver.SetCamera(scene.cameras[0]);
  return solver;
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

TEST(Session, TwoRunsContinueAsOneWouldHaveGone)
{
  const Scene scene = test::MakeLitBox();
  for (const std::string& name : FixedGraphMethodNames())
  {
    SCOPED_TRACE(name);
    Solver whole = MakeSolver(scene, MethodFromName(name));
    whole.Run(Steps(30));
    Solver parts = MakeSolver(scene, MethodFromName(name));
    EXPECT_EQ(parts.Run(Steps(11)), RunEnd::Budget);
    parts.Run(Steps(19));
    ASSERT_EQ(whole.History().size(), parts.History().size());
    EXPECT_EQ(whole.History().back().work.Evaluations(), parts.History().back().work.Evaluations());
    EXPECT_EQ(whole.Elements().radiance, parts.Elements().radiance);
  }
}

/// Stops a run of 20 steps after each of its moves, and goes on.
void ExpectSameAfterCancelling(const Scene& scene, Method method)
{
  Solver whole = MakeSolver(scene, method);
  whole.Run(Steps(20));
  const std::size_t length = whole.History().size();
  for (std::size_t stopAt = 1; stopAt < length; ++stopAt)
  {
    Solver stopped = MakeSolver(scene, method);
    std::size_t seen = 0;
    EXPECT_EQ(stopped.Run(Steps(20), [&](const StepReport&) { return ++seen < stopAt; }),
      RunEnd::Cancelled);
    EXPECT_EQ(stopped.History().size(), stopAt);
    stopped.Run(Steps(20 - stopped.History().back().step));
    EXPECT_EQ(whole.Elements().radiance, stopped.Elements().radiance);
  }
}

TEST(Session, CancellingKeepsWhatIsDone)
{
  const Scene scene = test::MakeLitBox();
  for (const Method method : { Method::ProgressiveShooting, Method::ImportanceGathering })
  {
    SCOPED_TRACE(NameOf(method));
    ExpectSameAfterCancelling(scene, method);
  }
}

/// A method, and what a step of it moves.
struct Way
{
  Method method;
  Granularity granularity;
};

std::string NameOfWay(const testing::TestParamInfo<Way>& way)
{
  std::string name = NameOf(way.param.method) + "_" + NameOf(way.param.granularity);
  std::replace(name.begin(), name.end(), '-', '_');
  return name;
}

class ViewSession : public testing::TestWithParam<Way>
{
};

INSTANTIATE_TEST_SUITE_P(Methods, ViewSession,
  testing::Values(Way{ Method::ImportanceShooting, Granularity::Patch },
    Way{ Method::ImportanceShooting, Granularity::Interaction },
    Way{ Method::ImportanceGathering, Granularity::Patch }),
  NameOfWay);

TEST_P(ViewSession, ACameraMoveKeepsRadianceAndInteractions)
{
  const Scene scene = test::MakeLitBox();
  SolverSettings settings = CoarseSettings(GetParam().method, GetParam().granularity);
  if (settings.granularity == Granularity::Interaction)
  {
    settings.refinement.minimumElementSize = 2.0; // of as many steps as there are interactions
  }
  Solver solver(scene, settings);
  solver.SetCamera(scene.cameras[0]);
  solver.Run(Error(1e-3));
  const auto radiance = solver.Elements().radiance;
  const auto before = solver.History().back();
  Camera other = scene.cameras[0];
  std::swap(other.eye.x, other.lookAt.x);
  solver.SetCamera(other);
  EXPECT_EQ(solver.Elements().radiance, radiance);
  solver.Run(Steps(1));
  EXPECT_EQ(solver.History().back().interactions, before.interactions);
  EXPECT_EQ(solver.History().back().work.Evaluations(), before.work.Evaluations());

  // What it converges to is what a fresh solver finds on interactions of its own, up to the
  // tolerances of refinement.
  solver.Run(Error(1e-4));
  Solver fresh(scene, settings);
  fresh.SetCamera(other);
  fresh.Run(Error(1e-4));
  EXPECT_NEAR(Mean(solver.ViewFluxOfRadiance()) / Mean(fresh.ViewFluxOfRadiance()), 1.0, 0.01);
}

class MaterialSession : public testing::TestWithParam<Way>
{
};

INSTANTIATE_TEST_SUITE_P(Methods, MaterialSession,
  testing::Values(Way{ Method::ProgressiveShooting, Granularity::Patch },
    Way{ Method::ProgressiveShooting, Granularity::Interaction },
    Way{ Method::BasicShooting, Granularity::Interaction },
    Way{ Method::ImportanceGathering, Granularity::Patch }),
  NameOfWay);

TEST_P(MaterialSession, NewMaterialsKeepInteractions)
{
  const Scene scene = test::MakeLitBox();
  SolverSettings settings = CoarseSettings(GetParam().method, GetParam().granularity);
  settings.refinement.oracle = RefinementOracle::F;
  Solver solver(scene, settings);
  solver.SetCamera(scene.cameras[0]);
  solver.Run(Error(1e-10));
  const StepReport before = solver.History().back();

  Scene changed = scene;
  for (Material& material : changed.materials)
  {
    material.albedo *= 0.5;
    material.emission *= 3.0;
  }
  solver.SetMaterials(changed.materials);
  solver.Run(Error(1e-10));
  EXPECT_EQ(solver.History().back().interactions, before.interactions);
  EXPECT_EQ(solver.History().back().work.Evaluations(), before.work.Evaluations());

  Solver fresh(changed, settings);
  fresh.SetCamera(changed.cameras[0]);
  fresh.Run(Error(1e-10));
  const auto expected = fresh.Elements().radiance;
  const auto found = solver.Elements().radiance;
  ASSERT_EQ(found.size(), expected.size());
  for (std::size_t i = 0; i < found.size(); ++i)
  {
    // Both are within 1e-10 of the emitted power of the same solution.
    ASSERT_NEAR(Mean(found[i]), Mean(expected[i]), 1e-7);
  }
}

/// Of the first estimate there is no step yet.
TEST(Session, EstimatesBeforeTheFirstStepAreOfAllThereIsToDo)
{
  const Scene scene = test::MakeLitBox();
  for (const std::string& name : FixedGraphMethodNames())
  {
    for (const Granularity granularity : { Granularity::Patch, Granularity::Interaction })
    {
      const SolverSettings settings = CoarseSettings(MethodFromName(name), granularity);
      if (Gathers(settings.method) && granularity == Granularity::Interaction)
      {
        continue;
      }
      SCOPED_TRACE(name + ", " + NameOf(granularity));
      Solver solver(scene, settings);
      solver.SetCamera(scene.cameras[0]);
      EXPECT_EQ(solver.Run(Error(0.3)), RunEnd::Converged);
      EXPECT_GT(solver.History().back().step, 0u);
      for (const StepReport& report : solver.History())
      {
        EXPECT_GT(report.errorEstimate, 0.0);
      }
    }
  }
}

TEST(Session, WithoutLightThereIsNothingToDo)
{
  Scene dark = test::MakeLitBox();
  for (Material& material : dark.materials)
  {
    material.emission = Color(0.0);
  }
  for (const std::string& name : FixedGraphMethodNames())
  {
    SCOPED_TRACE(name);
    Solver solver = MakeSolver(dark, MethodFromName(name));
    EXPECT_EQ(solver.Run(Error(0.01)), RunEnd::Converged);
    EXPECT_EQ(Mean(solver.ViewFluxOfRadiance()), 0.0);
  }
}

TEST(Session, AViewOfNothingNeedsNothing)
{
  const Scene scene = test::MakeLitBox();
  Camera away = scene.cameras[0];
  away.eye = Vec3(10.0);
  away.lookAt = Vec3(20.0);
  for (const Method method : { Method::ImportanceShooting, Method::ImportanceGathering })
  {
    SCOPED_TRACE(NameOf(method));
    Solver solver = MakeSolver(scene, method);
    solver.SetCamera(away);
    EXPECT_EQ(solver.Run(Error(0.01)), RunEnd::Converged);
  }
}

/// A closed body has no light inside: that its material has two sides changes nothing, to the bit.
TEST(Session, InsidesOfClosedBodiesTakeNoPart)
{
  for (const Method method : { Method::ImportanceShooting, Method::GoalOriented })
  {
    ElementSolution ofOneSided;
    for (const bool twoSided : { false, true })
    {
      Scene scene = test::MakeLitBox();
      scene.materials[4].twoSided = twoSided; // of the block
      Solver solver = MakeSolver(scene, method);
      solver.SetCamera(scene.cameras[0]);
      solver.Run(Steps(5));
      const ElementSolution elements = solver.Elements();
      if (twoSided)
      {
        EXPECT_EQ(elements.radiance, ofOneSided.radiance);
      }
      ofOneSided = elements;
    }
  }
}

TEST(Session, ALampInsideAClosedBodyNeedsANewSolver)
{
  Scene scene = test::MakeLitBox();
  scene.materials.push_back(test::MakeMaterial(Color(0.5)));
  scene.materials[4].twoSided = true;
  test::AddBox(
    scene, Vec3(0.6, 0.6, 0.1), Vec3(0.7, 0.7, 0.2), false, { 5, 5, 5, 5, 5, 5 }); // in the block
  Solver solver = MakeSolver(scene, Method::GoalOriented);
  std::vector<Material> dimmed = scene.materials;
  dimmed[3].emission = Color(0.0);
  EXPECT_TRUE(solver.CanTake(dimmed));
  solver.SetMaterials(dimmed);
  dimmed[0].emission = Color(1.0); // the walls of the room
  EXPECT_TRUE(solver.CanTake(dimmed));
  std::vector<Material> lit = scene.materials;
  lit[5].emission = Color(1.0);
  EXPECT_FALSE(solver.CanTake(lit));
  EXPECT_THROW(solver.SetMaterials(lit), InputError);
  EXPECT_TRUE(Solver(Scene(scene)).CanTake(scene.materials));
}

TEST(Session, TheElementsOfAnyMethodCanBeGathered)
{
  const Scene scene = test::MakeLitBox();
  Solver solver(scene, CoarseSettings(Method::ProgressiveShooting));
  solver.Run(Steps(3));
  const ElementSolution elements = solver.GatherElements(scene.cameras[0], 0.2).elements;
  EXPECT_EQ(elements.pointRadiance.size(), elements.surface.points.size());
  EXPECT_TRUE(elements.irradiance.empty()); // only goal-oriented keeps it
  EXPECT_TRUE(elements.pointIrradiance.empty());
}

TEST(Session, ShootingNeedsACameraOnlyForImportance)
{
  const Scene scene = test::MakeLitBox();
  for (const Method method : { Method::ImportanceShooting, Method::ImportanceGathering })
  {
    Solver importance(scene, CoarseSettings(method));
    EXPECT_THROW(importance.Run(Steps(1)), InputError);
  }
  Solver progressive(scene, CoarseSettings(Method::ProgressiveShooting));
  EXPECT_EQ(progressive.Run(Steps(1)), RunEnd::Budget);
}

TEST(Session, BadValuesAreRefused)
{
  const Scene scene = test::MakeLitBox();
  SolverSettings settings;
  settings.visibilityRays = 0;
  EXPECT_THROW(Solver(scene, settings), InputError);
  settings = SolverSettings();
  settings.viewRays = 0;
  EXPECT_THROW(Solver(scene, settings), InputError);
  settings = SolverSettings();
  settings.granularity = Granularity::Interaction;
  for (const Method gathering : { Method::GaussSeidel, Method::ImportanceGathering })
  {
    settings.method = gathering;
    EXPECT_THROW(Solver(scene, settings), InputError);
  }
  settings = SolverSettings();
  settings.refinement.formFactorTolerance = 0.0;
  EXPECT_THROW(Solver(scene, settings), InputError);
  Solver solver = MakeSolver(scene, Method::ProgressiveShooting);
  EXPECT_THROW(solver.Run(Error(-0.1)), InputError);
  EXPECT_THROW(solver.Run(Error(NAN)), InputError);
  Budget budget;
  budget.seconds = 0.0;
  EXPECT_THROW(solver.Run(budget), InputError);
  EXPECT_THROW(solver.SetMaterials({}), InputError);
  EXPECT_THROW(MethodFromName("fast"), UnknownNameError);
  EXPECT_THROW(GranularityFromName("room"), UnknownNameError);
  EXPECT_THROW(RefinementOracleFromName("BFV"), UnknownNameError);
}

TEST(Session, UnusualScenesAreToldApartByWarnings)
{
  Scene dark = test::MakeFurnace(Color(0.5), Color(0.0));
  Solver solver = MakeSolver(dark, Method::ImportanceShooting);
  EXPECT_EQ(solver.Run(), RunEnd::Converged);
  ASSERT_EQ(solver.Warnings().size(), 1u);
  EXPECT_NE(solver.Warnings()[0].find("emits"), std::string::npos);
  for (const Color& radiance : solver.Elements().radiance)
  {
    EXPECT_EQ(radiance, Color(0.0));
  }

  const Scene lit = test::MakeLitBox();
  Solver buried(lit, CoarseSettings(Method::ImportanceShooting));
  Camera camera = lit.cameras[0];
  camera.eye = Vec3(0.7, 0.6, 0.2);
  camera.lookAt = Vec3(0.7, 0.7, 0.2);
  buried.SetCamera(camera);
  buried.Run();
  ASSERT_EQ(buried.Warnings().size(), 1u);
  EXPECT_NE(buried.Warnings()[0].find("camera"), std::string::npos);
}

TEST(Session, ASpecularPartThatIsLeftOutIsWarnedOf)
{
  Scene scene = test::MakeLitBox();
  EXPECT_TRUE(MakeSolver(scene, Method::GoalOriented).Warnings().empty());
  scene.materials[1].name = "steel";
  scene.materials[1].specular = Color(0.1);
  scene.materials[2].specular = Color(0.2);
  const std::vector<std::string> warnings = MakeSolver(scene, Method::GoalOriented).Warnings();
  ASSERT_EQ(warnings.size(), 1u);
  EXPECT_NE(warnings[0].find("'steel' and of 1 more"), std::string::npos) << warnings[0];
}

TEST(Session, TheFractionDoneIsThatOfTheNearestLimit)
{
  StepReport before;
  before.step = 5;
  before.seconds = 2.0;
  StepReport now;
  now.step = 7;
  now.seconds = 3.0;
  now.errorEstimate = 0.1;
  EXPECT_DOUBLE_EQ(FractionDone(Error(1e-4), before, now), 0.25);
  EXPECT_DOUBLE_EQ(FractionDone(Steps(4), before, now), 0.5);
  Budget budget = Error(1e-4);
  budget.seconds = 1.25;
  EXPECT_DOUBLE_EQ(FractionDone(budget, before, now), 0.8);
  now.errorEstimate = 0.0;
  EXPECT_DOUBLE_EQ(FractionDone(budget, before, now), 1.0);
  now.errorEstimate = std::numeric_limits<double>::infinity();
  EXPECT_NEAR(FractionDone(Error(0.5), before, now), 0.0, 1e-15); // 2 of all steps there can be
}

TEST(Session, TheFluxNeverFallsAndNeverExceedsTheConvergedOne)
{
  LabyrinthSettings size;
  size.rows = 1;
  size.columns = 3;
  const Scene scene = MakeLabyrinth(size);
  for (const Granularity granularity : { Granularity::Patch, Granularity::Interaction })
  {
    SolverSettings settings;
    settings.method = Method::ImportanceShooting;
    settings.granularity = granularity;
    settings.refinement.oracle = RefinementOracle::F;
    settings.refinement.formFactorTolerance = 0.3;
    Solver solver(scene, settings);
    solver.SetCamera(scene.FindCamera("view1"));
    Budget budget = Error(granularity == Granularity::Patch ? 0.0 : 1e-4);
    solver.Run(budget);
    const double converged = Mean(solver.ViewFluxOfRadiance());
    double last = 0.0;
    for (const StepReport& report : solver.History())
    {
      // Round-off of a sum of some 1e5 terms.
      ASSERT_GE(report.viewFlux, last * (1.0 - 1e-12)) << "step " << report.step;
      ASSERT_LE(
        report.viewFlux, converged * (granularity == Granularity::Patch ? 1.0 + 1e-10 : 1.01))
        << "step " << report.step;
      last = report.viewFlux;
    }
    if (granularity == Granularity::Patch)
    {
      EXPECT_NEAR(Mean(solver.ViewFluxOfImportance()) / converged, 1.0, 1e-9);
      EXPECT_NEAR(last / converged, 1.0, 1e-9);
    }
  }
}

TEST(Solver, NoLightPassesBelowAWall)
{
  // Two rooms under one roof and on one floor, a lamp in the left one.
  Scene scene;
  scene.materials = { test::MakeMaterial(Color(0.7)),
    test::MakeMaterial(Color(0.0), Color(9.0), false) };
  test::AddBox(scene, Vec3(0.0), Vec3(3.0, 2.0, 1.0), true, { 0, 0, 0, 0, 0, 0 });
  scene.AddPolygon({ Vec3(1.3, 0, 0), Vec3(1.3, 2, 0), Vec3(1.3, 2, 1), Vec3(1.3, 0, 1) }, 0);
  scene.AddPolygon(
    { Vec3(0.4, 0.8, 0.9), Vec3(0.4, 1.2, 0.9), Vec3(0.8, 1.2, 0.9), Vec3(0.8, 0.8, 0.9) }, 1);
  for (const Method method : { Method::GaussSeidel, Method::ProgressiveShooting })
  {
    SolverSettings settings;
    settings.method = method;
    Solver solver(scene, settings);
    Budget budget;
    budget.error = 1e-3;
    solver.Run(budget);
    const ElementSolution elements = solver.Elements();
    double lit = 0.0;
    for (std::size_t k = 0; k < elements.radiance.size(); ++k)
    {
      const ElementSurface& surface = elements.surface;
      double x = 0.0;
      for (std::uint32_t i = surface.offsets[k]; i < surface.offsets[k + 1]; ++i)
      {
        x += surface.points[surface.indices[i]].x / (surface.offsets[k + 1] - surface.offsets[k]);
      }
      const bool isRight = x > 1.3 + 1e-9;
      EXPECT_TRUE(!isRight || elements.radiance[k] == Color(0.0)) << "element " << k;
      lit = std::max(lit, Mean(elements.radiance[k]));
    }
    EXPECT_GT(lit, 1.0);
  }
}

} // namespace
} // namespace vantage
