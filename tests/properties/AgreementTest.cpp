#include "core/math/Polygon.h"
#include "properties/RandomScene.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace vantage
{
namespace
{

constexpr std::uint64_t Scenes = 25; ///< solved to round-off; IdentitiesTest has more

double LargestDifference(const std::vector<Color>& a, const std::vector<Color>& b)
{
  double largest = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i)
  {
    const double size = std::max(1e-300, MaxChannel(glm::max(a[i], b[i])));
    largest = std::max(largest, MaxChannel(glm::abs(a[i] - b[i])) / size);
  }
  return largest;
}

/// Makes all interactions the scene has, so that methods differ in order only.
std::vector<Color> Converged(const Scene& scene, Method method, RefinementOracle oracle)
{
  Solver solver = test::MakeSolver(scene, test::CoarseSettings(method, oracle));
  test::Solve(solver, 0.0);
  return test::RadianceOfPolygonSides(solver);
}

TEST(Agreement, InteractionStepsConvergeToTheSameSolution)
{
  for (std::uint64_t seed = 1; seed <= 3; ++seed)
  {
    const Scene scene = test::MakeRandomScene(seed);
    const auto expected = Converged(scene, Method::GaussSeidel, RefinementOracle::F);
    for (const Method method :
      { Method::BasicShooting, Method::ProgressiveShooting, Method::ImportanceShooting })
    {
      SCOPED_TRACE("seed " + std::to_string(seed) + ", " + NameOf(method));
      SolverSettings settings = test::CoarseSettings(method);
      settings.granularity = Granularity::Interaction;
      Solver solver = test::MakeSolver(scene, settings);
      test::Solve(solver, 1e-9);
      // What is left unshot, at most, of a radiance that is not much darker than the mean.
      ASSERT_LT(LargestDifference(test::RadianceOfPolygonSides(solver), expected), 1e-6);
    }
  }
}

TEST(Agreement, RadianceAndImportanceGiveTheSameFlux)
{
  for (std::uint64_t seed = 1; seed <= Scenes; ++seed)
  {
    SCOPED_TRACE("seed " + std::to_string(seed));
    for (const Method method : { Method::ImportanceShooting, Method::ImportanceGathering })
    {
      const RefinementOracle oracle = seed % 2 == 0 ? RefinementOracle::F : RefinementOracle::BF;
      Solver solver =
        test::MakeSolver(test::MakeRandomScene(seed), test::CoarseSettings(method, oracle));
      test::Solve(solver, 0.0);
      const Color radiance = solver.ViewFluxOfRadiance();
      const Color importance = solver.ViewFluxOfImportance();
      for (int k = 0; k < 3; ++k)
      {
        ASSERT_NEAR(importance[k] / radiance[k], 1.0, 1e-9);
      }
      const StepReport& last = solver.History().back();
      ASSERT_NEAR(last.viewFlux / Mean(radiance), 1.0, 1e-9);
      double before = 0.0;
      for (const StepReport& report : solver.History())
      {
        // Round-off of some thousand additions.
        ASSERT_GE(report.viewFlux, before * (1.0 - 1e-12));
        before = report.viewFlux;
      }
    }
  }
}

/// Power that leaves the emitters is absorbed somewhere: emitted = sum A (1 - rho) pi H, with
/// H = (L - E) / rho the irradiance over pi. Returns what of it is missing or too much.
double EnergyError(const Scene& scene, double tolerance)
{
  SolverSettings settings = test::CoarseSettings(Method::GaussSeidel, RefinementOracle::BF);
  settings.refinement.powerTolerance = tolerance;
  settings.refinement.shadowTolerance = tolerance / 3.0;
  settings.refinement.minimumElementSize = 0.02;
  Solver solver = test::MakeSolver(scene, settings);
  test::Solve(solver, 1e-9);
  const auto radiance = test::RadianceOfPolygonSides(solver);
  double emitted = 0.0;
  double absorbed = 0.0;
  for (std::size_t p = 0; p < scene.PolygonCount(); ++p)
  {
    Polygon shape;
    for (std::uint32_t i = scene.offsets[p]; i < scene.offsets[p + 1]; ++i)
    {
      shape.Add(scene.vertices[scene.indices[i]]);
    }
    const Material& material = scene.materials[scene.materialOfPolygon[p]];
    emitted += Area(shape) * Mean(material.emission);
    for (const Side side : { Side::Front, Side::Back })
    {
      const Color emission = side == Side::Front ? material.emission : Color(0.0);
      const Color leaving = radiance[2 * p + (side == Side::Back)];
      if (leaving != Color(0.0))
      {
        absorbed +=
          Area(shape) * Mean((leaving - emission) * (Color(1.0) / material.albedo - Color(1.0)));
      }
    }
  }
  return std::abs(absorbed / emitted - 1.0);
}

TEST(Agreement, EmittedPowerIsAbsorbedTheBetterTheFiner)
{
  // Discretisation: constant kernels, 16 rays a pair, and rows closed at the cost of the columns.
  double coarse = 0.0;
  double fine = 0.0;
  for (std::uint64_t seed = 1; seed <= 10; ++seed)
  {
    SCOPED_TRACE("seed " + std::to_string(seed));
    const Scene scene = test::MakeRandomScene(seed);
    coarse += EnergyError(scene, 1e-2) / 10.0;
    const double error = EnergyError(scene, 5e-4);
    EXPECT_LT(error, 0.03);
    fine += error / 10.0;
  }
  EXPECT_LT(coarse, 0.04);
  EXPECT_LT(fine, 0.6 * coarse) << coarse;
}

} // namespace
} // namespace vantage
