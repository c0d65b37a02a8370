#include "core/Solver.h"
#include "support/TestScenes.h"

#include <gtest/gtest.h>

#include <cmath>
#include <ostream>

namespace vantage
{
namespace
{

/// In a furnace what an element lacks or has too much is the error of the row sums of its form
/// factors, amplified by at most albedo / (1 - albedo).
struct FurnaceCase
{
  double albedo;
  Accuracy accuracy;
  double tolerance; ///< relative, on every element
};

void PrintTo(const FurnaceCase& furnace, std::ostream* out)
{
  *out << "albedo " << furnace.albedo
       << (furnace.accuracy == Accuracy::Default ? ", default" : ", reference");
}

class Furnace : public testing::TestWithParam<FurnaceCase>
{
};

TEST_P(Furnace, EveryMethodConvergesToEmissionOverOneMinusAlbedo)
{
  const FurnaceCase& furnace = GetParam();
  for (const std::string& name : FixedGraphMethodNames())
  {
    for (const RefinementOracle oracle : { RefinementOracle::F, RefinementOracle::BF })
    {
      SCOPED_TRACE(name + " " + NameOf(oracle));
      SolverSettings settings;
      settings.method = MethodFromName(name);
      settings.accuracy = furnace.accuracy;
      settings.refinement.oracle = oracle;
      settings.refinement.minimumElementSize = 0.25;
      const Scene scene = test::MakeFurnace(Color(furnace.albedo));
      Solver solver(scene, settings);
      solver.SetCamera(scene.cameras[0]);
      Budget budget;
      budget.error = 0.1 * furnace.tolerance;
      EXPECT_EQ(solver.Run(budget), RunEnd::Converged);
      const double expected = 1.0 / (1.0 - furnace.albedo);
      const ElementSolution solution = solver.Elements();
      EXPECT_GE(solution.radiance.size(), 6u * 4u);
      for (const Color& radiance : solution.radiance)
      {
        ASSERT_NEAR(Mean(radiance) / expected, 1.0, furnace.tolerance);
      }
    }
  }
}

INSTANTIATE_TEST_SUITE_P(ClosedBox, Furnace,
  testing::Values(FurnaceCase{ 0.5, Accuracy::Default, 1e-4 },
    FurnaceCase{ 0.9, Accuracy::Default, 1e-4 }, FurnaceCase{ 0.99, Accuracy::Default, 1e-2 },
    FurnaceCase{ 0.5, Accuracy::Reference, 1e-6 }, FurnaceCase{ 0.9, Accuracy::Reference, 1e-6 },
    FurnaceCase{ 0.99, Accuracy::Reference, 1e-4 }));

TEST(Furnace, InteractionStepsConvergeToTheSame)
{
  for (const Method method :
    { Method::BasicShooting, Method::ProgressiveShooting, Method::ImportanceShooting })
  {
    SCOPED_TRACE(NameOf(method));
    SolverSettings settings;
    settings.method = method;
    settings.granularity = Granularity::Interaction;
    settings.refinement.minimumElementSize = 0.5;
    const Scene scene = test::MakeFurnace(Color(0.5));
    Solver solver(scene, settings);
    solver.SetCamera(scene.cameras[0]);
    Budget budget;
    budget.error = 1e-6;
    EXPECT_EQ(solver.Run(budget), RunEnd::Converged);
    for (const Color& radiance : solver.Elements().radiance)
    {
      ASSERT_NEAR(Mean(radiance) / 2.0, 1.0, 1e-4);
    }
  }
}

TEST(Furnace, AClosedWhiteSceneIsRefusedAndAnOpenOneSolved)
{
  const Scene closed = test::MakeFurnace(Color(1.0));
  SolverSettings settings;
  settings.method = Method::ProgressiveShooting;
  Solver refused(closed, settings);
  EXPECT_THROW(refused.Run(), DivergenceError);

  Scene open = closed;
  open.offsets.pop_back();
  open.indices.resize(open.offsets.back());
  open.materialOfPolygon.pop_back();
  Solver solver(open, settings);
  Budget budget;
  budget.error = 1e-6;
  EXPECT_EQ(solver.Run(budget), RunEnd::Converged);
  for (const Color& radiance : solver.Elements().radiance)
  {
    EXPECT_GT(Mean(radiance), 1.0);
    EXPECT_LT(Mean(radiance), 100.0);
  }
}

} // namespace
} // namespace vantage
