#include "SolverSession.h"

#include "TestScenes.h"
#include "support/TestScenes.h"

#include <gtest/gtest.h>

#include <functional>

namespace vantage
{
namespace
{

constexpr std::uint64_t Enough = 6; // patch steps, of which some carry radiance

/// All that a session is asked with.
struct Question
{
  Scene scene = MakeLitBox();
  SolverSettings settings;
  Camera camera = MakeLitBox().cameras.front();
  std::uint64_t steps = Enough;

  Question()
  {
    this->settings.method = Method::ImportanceShooting;
    this->settings.viewRays = 1024;
    this->settings.refinement.maximumLevel = 1;
  }
};

/// Asks, and does the steps that are asked for.
const Solver& Ask(SolverSession& session, const Question& question)
{
  Solver& solver =
    session.Prepare(question.scene, question.settings, question.camera, question.steps);
  Budget budget;
  budget.steps = question.steps - session.StepsDone();
  solver.Run(budget);
  return solver;
}

using Change = std::pair<const char*, std::function<void(Question&)>>;

/// Asks twice, with one change in between; hands the solver to `check` before it runs again.
void ChangeOneThing(
  const Change& change, const std::function<void(SolverSession&, const Solver&)>& check)
{
  SCOPED_TRACE(change.first);
  SolverSession session;
  Question question;
  ASSERT_EQ(Ask(session, question).History().back().step, Enough);
  change.second(question);
  const Solver& solver =
    session.Prepare(question.scene, question.settings, question.camera, question.steps);
  check(session, solver);
}

TEST(SolverSession, NothingChangedNothingIsRedone)
{
  ChangeOneThing({ "nothing", [](Question&) {} },
    [](const SolverSession& session, const Solver& solver)
    {
      EXPECT_FALSE(session.HasChanged());
      EXPECT_EQ(session.StepsDone(), Enough);
      EXPECT_EQ(solver.History().size(), Enough);
    });
}

TEST(SolverSession, NamesDoNotCount)
{
  const Change changes[] = {
    { "material", [](Question& q) { q.scene.materials[0].name = "paint"; } },
    { "camera", [](Question& q) { q.camera.name = "window"; } },
    { "cameras of the scene", [](Question& q) { q.scene.cameras.clear(); } },
  };
  for (const Change& change : changes)
  {
    ChangeOneThing(change,
      [](const SolverSession& session, const Solver&) { EXPECT_FALSE(session.HasChanged()); });
  }
}

TEST(SolverSession, MoreStepsContinueAndGiveWhatOneRunGives)
{
  SolverSession session, whole;
  Question question;
  const std::vector<StepReport> before = Ask(session, question).History();
  question.steps = 2 * Enough;
  const std::vector<StepReport> after = Ask(session, question).History();
  const std::vector<StepReport> atOnce = Ask(whole, question).History();
  ASSERT_EQ(after.size(), 2 * Enough);
  ASSERT_EQ(atOnce.size(), 2 * Enough);
  for (std::size_t k = 0; k < before.size(); ++k)
  {
    EXPECT_EQ(after[k].viewFlux, before[k].viewFlux);
    EXPECT_EQ(after[k].work.Evaluations(), before[k].work.Evaluations());
    EXPECT_EQ(after[k].seconds, before[k].seconds); // not even done again
  }
  for (std::size_t k = 0; k < after.size(); ++k)
  {
    EXPECT_EQ(after[k].viewFlux, atOnce[k].viewFlux);
    EXPECT_EQ(after[k].work.Evaluations(), atOnce[k].work.Evaluations());
  }
}

TEST(SolverSession, FewerStepsStartAnew)
{
  ChangeOneThing({ "steps", [](Question& q) { q.steps = Enough - 1; } },
    [](const SolverSession& session, const Solver& solver)
    {
      EXPECT_TRUE(session.HasChanged());
      EXPECT_EQ(session.StepsDone(), 0u);
      EXPECT_TRUE(solver.History().empty());
    });
}

TEST(SolverSession, AnotherCameraKeepsRadianceAndInteractions)
{
  const Change changes[] = {
    { "eye", [](Question& q) { q.camera.eye.x += 0.01; } },
    { "look-at", [](Question& q) { q.camera.lookAt.z += 0.01; } },
    { "up", [](Question& q) { q.camera.up.y += 0.01; } },
    { "field of view", [](Question& q) { q.camera.fieldOfView += 1.0; } },
    { "aspect", [](Question& q) { q.camera.aspect += 0.01; } },
  };
  SolverSession reference;
  const ElementSolution before = Ask(reference, Question()).Elements();
  const std::size_t interactions = reference.Current().Interactions().size();
  ASSERT_GT(interactions, 0u);
  for (const Change& change : changes)
  {
    ChangeOneThing(change,
      [&](const SolverSession& session, const Solver& solver)
      {
        EXPECT_TRUE(session.HasChanged());
        EXPECT_EQ(session.StepsDone(), 0u); // steps are counted for each view
        EXPECT_EQ(solver.History().size(), Enough);
        EXPECT_EQ(solver.Interactions().size(), interactions);
        EXPECT_EQ(solver.Elements().radiance, before.radiance);
        EXPECT_NE(solver.Elements().viewImportance, before.viewImportance);
      });
  }
}

TEST(SolverSession, OtherLightsAndColoursKeepInteractions)
{
  const Change changes[] = {
    { "albedo", [](Question& q) { q.scene.materials[1].albedo.y = 0.4; } },
    { "emission", [](Question& q) { q.scene.materials[2].emission.z = 5.0; } },
    { "specular", [](Question& q) { q.scene.materials[0].specular.x = 0.1; } }, // warned of
    { "shininess", [](Question& q) { q.scene.materials[0].shininess = 3.0; } },
  };
  SolverSession reference;
  const std::size_t interactions = Ask(reference, Question()).Interactions().size();
  for (const Change& change : changes)
  {
    ChangeOneThing(change,
      [&](const SolverSession& session, const Solver& solver)
      {
        EXPECT_TRUE(session.HasChanged());
        EXPECT_EQ(session.StepsDone(), 0u);
        EXPECT_EQ(solver.History().size(), Enough);
        EXPECT_EQ(solver.Interactions().size(), interactions);
        const ElementSolution elements = solver.Elements();
        EXPECT_EQ(elements.radiance, elements.emission); // nothing has been shot
      });
  }
}

TEST(SolverSession, AnyOtherChangeStartsAnew)
{
  const Change changes[] = {
    { "vertex", [](Question& q) { q.scene.vertices[24].x += 0.01; } },
    { "orientation", [](Question& q) { std::swap(q.scene.indices[24], q.scene.indices[26]); } },
    { "polygons",
      [](Question& q) {
        q.scene.AddPolygon({ { .4, .4, .2 }, { .6, .4, .2 }, { .6, .6, .2 } }, 0);
      } },
    { "material of a polygon", [](Question& q) { q.scene.materialOfPolygon[3] = 1; } },
    { "number of materials", [](Question& q) { q.scene.materials.emplace_back(); } },
    { "sidedness", [](Question& q) { q.scene.materials[0].twoSided = false; } },
    { "method", [](Question& q) { q.settings.method = Method::ProgressiveShooting; } },
    { "granularity", [](Question& q) { q.settings.granularity = Granularity::Interaction; } },
    { "oracle", [](Question& q) { q.settings.refinement.oracle = RefinementOracle::F; } },
    { "form factor tolerance",
      [](Question& q) { q.settings.refinement.formFactorTolerance = 0.2; } },
    { "power tolerance", [](Question& q) { q.settings.refinement.powerTolerance = 0.01; } },
    { "shadow tolerance", [](Question& q) { q.settings.refinement.shadowTolerance = 0.01; } },
    { "minimum element size", [](Question& q) { q.settings.refinement.minimumElementSize = 0.1; } },
    { "maximum level", [](Question& q) { q.settings.refinement.maximumLevel = 0; } },
    { "accuracy", [](Question& q) { q.settings.accuracy = Accuracy::Reference; } },
    { "visibility rays", [](Question& q) { q.settings.visibilityRays = 4; } },
    { "view rays", [](Question& q) { q.settings.viewRays = 512; } },
    { "initial phase", [](Question& q) { q.settings.initialPhase = false; } },
    { "seed", [](Question& q) { q.settings.seed = 2; } },
  };
  for (const Change& change : changes)
  {
    ChangeOneThing(change,
      [](const SolverSession& session, const Solver& solver)
      {
        EXPECT_TRUE(session.HasChanged());
        EXPECT_TRUE(solver.History().empty());
        EXPECT_TRUE(solver.Interactions().empty());
      });
  }
}

TEST(SolverSession, ALampInsideAClosedBodyStartsAnew)
{
  SolverSession session;
  Question question;
  Scene& scene = question.scene;
  scene.materials.resize(5);
  test::AddBox(scene, Vec3(0.5), Vec3(0.8), false, { 3, 3, 3, 3, 3, 3 });
  test::AddBox(scene, Vec3(0.6), Vec3(0.7), false, { 4, 4, 4, 4, 4, 4 });
  const std::size_t before = Ask(session, question).Elements().radiance.size();
  scene.materials[4].emission = Color(1.0);
  EXPECT_GT(Ask(session, question).Elements().radiance.size(), before);
  EXPECT_EQ(session.StepsDone(), Enough);
}

TEST(SolverSession, AChangedViewGetsItsOwnSteps)
{
  SolverSession session;
  Question question;
  Ask(session, question);
  question.camera.eye.x += 0.2;
  EXPECT_EQ(Ask(session, question).History().size(), 2 * Enough);
  EXPECT_EQ(session.StepsDone(), Enough);
}

TEST(SolverSession, RowsOfTheInitialPhaseAreNotSteps)
{
  SolverSession session;
  Question question;
  question.settings.method = Method::ProgressiveShooting;
  const Solver& solver = Ask(session, question);
  EXPECT_EQ(session.StepsDone(), Enough);
  EXPECT_EQ(solver.History().front().phase, "initial");
  EXPECT_EQ(solver.History().size(), Enough + 1); // one lamp
}

TEST(SolverSession, WhatIsSolvedSurvivesABadQuestion)
{
  const Change changes[] = {
    { "scene", [](Question& q) { q.scene.materials[0].albedo.x = 1.5; } },
    { "settings", [](Question& q) { q.settings.viewRays = 0; } },
    { "camera", [](Question& q) { q.camera.aspect = 0.0; } },
  };
  for (const Change& change : changes)
  {
    SCOPED_TRACE(change.first);
    SolverSession session;
    const Question good;
    Ask(session, good);
    Question bad;
    change.second(bad);
    EXPECT_THROW(Ask(session, bad), InputError);
    session.Prepare(good.scene, good.settings, good.camera, good.steps);
    EXPECT_FALSE(session.HasChanged());
    EXPECT_EQ(session.StepsDone(), Enough);
  }
}

} // namespace
} // namespace vantage
