#include "core/reference/DenseSolve.h"

#include "core/Error.h"
#include "core/reference/TestRooms.h"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <cmath>

namespace vantage
{
namespace
{

using namespace testing;

TEST(DenseSolve, FurnaceHasTheRadianceOfAGeometricSeries)
{
  for (int level = 0; level <= 1; ++level)
  {
    DenseSettings settings;
    settings.level = level;
    const Color albedo(0.5, 0.9, 0.0);
    const DenseSolution solution = SolveDense(Furnace(albedo, Color(1.0)), settings);
    ASSERT_EQ(solution.elements.size(), level == 0 ? 12u : 48u);
    for (std::size_t i = 0; i < solution.elements.size(); ++i)
    {
      // Insides glow; the outsides of the box see nothing and are not the fronts of lamps.
      const bool isInside = solution.tree.PatchOfNode(solution.elements[i]).side == Side::Front;
      for (int channel = 0; channel < 3; ++channel)
      {
        const double expected = isInside ? 1.0 / (1.0 - albedo[channel]) : 0.0;
        // Form factors are good to 1e-5, and 1 / (1 - 0.9) = 10 times that comes out.
        EXPECT_NEAR(solution.radiance[i][channel], expected, 1e-4 * expected);
      }
    }
  }
}

TEST(DenseSolve, FacingPlatesExchangeLightInClosedForm)
{
  Scene scene;
  scene.materials = { Diffuse(Color(0.5), Color(1.0)), Diffuse(Color(0.8)) };
  scene.AddPolygon({ { 0, 0, 0 }, { 1, 0, 0 }, { 1, 1, 0 }, { 0, 1, 0 } }, 0);
  scene.AddPolygon({ { 0, 0, 1 }, { 0, 1, 1 }, { 1, 1, 1 }, { 1, 0, 1 } }, 1);
  const DenseSolution solution = SolveDense(scene);
  const double f = 0.199824895698387; // unit squares at distance 1
  const double lower = 1.0 / (1.0 - 0.5 * f * 0.8 * f);
  for (std::size_t i = 0; i < solution.elements.size(); ++i)
  {
    const Patch& patch = solution.tree.PatchOfNode(solution.elements[i]);
    const bool isLower = solution.tree[solution.elements[i]].centre.z < 0.5;
    const double expected = patch.side == Side::Back ? 0.0 : (isLower ? lower : 0.8 * f * lower);
    EXPECT_NEAR(solution.radiance[i].x, expected, 1e-5); // the accuracy of form factors
  }
}

TEST(DenseSolve, AnOccluderHidesTheExactPart)
{
  Scene scene;
  scene.materials = { Diffuse(Color(0.5)) };
  scene.AddPolygon({ { 0, 0, 0 }, { 1, 0, 0 }, { 1, 1, 0 }, { 0, 1, 0 } }, 0);
  scene.AddPolygon({ { 0, 0, 1 }, { 0, 1, 1 }, { 1, 1, 1 }, { 1, 0, 1 } }, 0);
  scene.AddPolygon({ { 0, 0, 0.5 }, { 0.5, 0, 0.5 }, { 0.5, 0.5, 0.5 }, { 0, 0.5, 0.5 } }, 0);
  const auto between = [](const DenseSolution& s)
  {
    std::size_t ends[2] = { 0, 0 };
    for (std::size_t i = 0; i < s.elements.size(); ++i)
    {
      const double z = s.tree[s.elements[i]].centre.z;
      if (s.tree.PatchOfNode(s.elements[i]).side == Side::Front && z != 0.5)
      {
        ends[z > 0.5 ? 1 : 0] = i;
      }
    }
    return s.throughput[ends[0] * s.elements.size() + ends[1]];
  };
  const double exact = 0.149868671773790 * Pi;
  EXPECT_NEAR(between(SolveDense(scene)) / exact, 1.0, 1e-4);
  DenseSettings sampled;
  sampled.exactVisibility = false;
  sampled.rays = 4096;
  // The mean visibility of segments is 1/4 hidden as is the flux here, by symmetry of this case;
  // a lattice of 4096 points leaves a few thousandths.
  EXPECT_NEAR(between(SolveDense(scene, sampled)) / exact, 1.0, 0.02);
}

TEST(DenseSolve, AlbedoOneInAClosedSceneDiverges)
{
  try
  {
    SolveDense(Furnace(Color(1.0), Color(1.0)));
    FAIL();
  }
  catch (const DivergenceError& error)
  {
    EXPECT_NE(std::string(error.what()).find("lower the albedo"), std::string::npos);
  }
  EXPECT_NO_THROW(SolveDense(Furnace(Color(0.999), Color(1.0))));
}

TEST(DenseSolve, AlbedoOneInAnOpenSceneDoesNot)
{
  Scene scene = Furnace(Color(1.0), Color(1.0));
  scene.offsets.pop_back();
  scene.materialOfPolygon.pop_back();
  EXPECT_NO_THROW(SolveDense(scene));
}

TEST(DenseSolve, BadSettingsAreNamed)
{
  DenseSettings settings;
  settings.level = 7;
  EXPECT_THROW(SolveDense(Furnace(Color(0.5), Color(1.0)), settings), InputError);
  settings.level = 6;
  try
  {
    SolveDense(Furnace(Color(0.5), Color(1.0)), settings);
    FAIL();
  }
  catch (const InputError& error)
  {
    EXPECT_NE(std::string(error.what()).find("49152 elements"), std::string::npos);
  }
}

TEST(DenseSolve, IsTheSameForAnyNumberOfThreads)
{
  const auto solve = [](int threads)
  {
    const tbb::global_control control(tbb::global_control::max_allowed_parallelism, threads);
    DenseSettings settings;
    settings.level = 1;
    return SolveDense(ShadedRoom(), settings).radiance;
  };
  EXPECT_EQ(solve(1), solve(4));
}

TEST(DenseSolve, AClosedRoomLosesNoLight)
{
  DenseSettings settings;
  settings.level = 1;
  const DenseSolution solution = SolveDense(ShadedRoom(), settings);
  const std::size_t n = solution.elements.size();
  for (std::size_t i = 0; i < n; ++i)
  {
    const Vec3& centre = solution.tree[solution.elements[i]].centre;
    const Vec3& normal = solution.tree.PatchOfNode(solution.elements[i]).normal;
    const bool isInside =
      glm::all(glm::lessThan(glm::abs(centre + 0.01 * normal - 1.0), Vec3(1.0)));
    double row = 0.0;
    for (std::size_t j = 0; j < n; ++j)
    {
      row += solution.throughput[i * n + j] / solution.tree[solution.elements[i]].area;
    }
    // What every form factor may be off, relative to the sum.
    EXPECT_NEAR(row / Pi, isInside ? 1.0 : 0.0, 1e-4) << i;
  }
}

} // namespace
} // namespace vantage
