#include "core/math/Sampling.h"
#include "core/scene/Labyrinth.h"
#include "properties/RandomScene.h"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <algorithm>

namespace vantage
{
namespace
{

std::vector<Color> Solved(const Scene& scene, Method method)
{
  Solver solver = test::MakeSolver(scene, test::CoarseSettings(method, RefinementOracle::BF));
  test::Solve(solver, 1e-10);
  return test::RadianceOfPolygonSides(solver);
}

template <typename Map>
Scene Moved(Scene scene, Map&& map)
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

void ExpectSameWithin(
  const std::vector<Color>& found, const std::vector<Color>& expected, double tolerance)
{
  ASSERT_EQ(found.size(), expected.size());
  double mean = 0.0;
  for (const Color& color : expected)
  {
    mean += Mean(color) / static_cast<double>(expected.size());
  }
  for (std::size_t i = 0; i < found.size(); ++i)
  {
    const double size = std::max(mean, MaxChannel(expected[i]));
    ASSERT_NEAR(MaxChannel(glm::abs(found[i] - expected[i])) / size, 0.0, tolerance)
      << "polygon " << i / 2 << (i % 2 ? " back" : " front");
  }
}

TEST(Invariance, DoublingTheEmissionDoublesEverythingExactly)
{
  for (std::uint64_t seed = 1; seed <= 5; ++seed)
  {
    SCOPED_TRACE("seed " + std::to_string(seed));
    const Scene scene = test::MakeRandomScene(seed);
    Scene brighter = scene;
    for (Material& material : brighter.materials)
    {
      material.emission *= 2.0;
    }
    std::vector<Color> expected = Solved(scene, Method::ImportanceShooting);
    for (Color& color : expected)
    {
      color *= 2.0;
    }
    EXPECT_EQ(Solved(brighter, Method::ImportanceShooting), expected);
  }
}

TEST(Invariance, TheNumberOfThreadsChangesNothing)
{
  LabyrinthSettings size;
  size.rows = 1;
  size.columns = 2;
  const Scene labyrinth = MakeLabyrinth(size);
  const auto solve = [&](int threads, Method method)
  {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
    SolverSettings settings;
    settings.method = method;
    settings.refinement.powerTolerance = 3e-3;
    Solver solver = test::MakeSolver(labyrinth, settings);
    test::Solve(solver, method == Method::GoalOriented ? 0.05 : 1e-3);
    const ElementSolution elements = solver.Elements();
    return std::make_pair(elements.radiance, elements.importance);
  };
  for (const Method method :
    { Method::ImportanceShooting, Method::ImportanceGathering, Method::GoalOriented })
  {
    const auto expected = solve(1, method);
    for (const int threads : { 2, 4 })
    {
      const auto found = solve(threads, method);
      EXPECT_TRUE(found.first == expected.first)
        << "radiance, " << NameOf(method) << ", " << threads;
      EXPECT_TRUE(found.second == expected.second)
        << "importance, " << NameOf(method) << ", " << threads;
    }
  }
}

/// Motions and scales round coordinates differently; sampled visibility then may change by a ray,
/// which is what the tolerance allows.
TEST(Invariance, RigidMotionsAndScalesChangeNextToNothing)
{
  for (std::uint64_t seed = 1; seed <= 5; ++seed)
  {
    SCOPED_TRACE("seed " + std::to_string(seed));
    const Scene scene = test::MakeRandomScene(seed);
    const auto expected = Solved(scene, Method::GaussSeidel);
    for (const double scale : { 1e-3, 1e-1, 7.0, 1e3 })
    {
      SCOPED_TRACE("scale " + std::to_string(scale));
      ExpectSameWithin(
        Solved(Moved(scene, [=](const Vec3& x) { return scale * x; }), Method::GaussSeidel),
        expected, 1e-3);
    }
    const Vec3 offset(1e4, -2e4, 5e3);
    ExpectSameWithin(
      Solved(Moved(scene, [=](const Vec3& x) { return x + offset; }), Method::GaussSeidel),
      expected, 1e-3);
    const Frame turned(glm::normalize(Vec3(0.3, -0.5, 0.8)));
    ExpectSameWithin(
      Solved(Moved(scene, [=](const Vec3& x) { return turned.ToWorld(x); }), Method::GaussSeidel),
      expected, 1e-3);
  }
}

} // namespace
} // namespace vantage
