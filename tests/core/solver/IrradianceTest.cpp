#include "core/Solver.h"

#include "support/TestScenes.h"

#include <gtest/gtest.h>

namespace vantage
{
namespace
{

Solver MakeSolver(const Scene& scene)
{
  SolverSettings settings;
  settings.viewRays = 4096;
  return Solver(Scene(scene), settings);
}

void SolveFor(Solver& solver, const Camera& camera)
{
  Budget budget;
  budget.error = 0.05;
  solver.SetCamera(camera);
  solver.Run(budget);
}

/// A wall tells its irradiance by its radiance; a lamp that reflects nothing receives light as
/// well.
TEST(Irradiance, IsWhatRadianceComesFrom)
{
  Scene scene = test::MakeLitBox();
  for (Material& material : scene.materials)
  {
    material.albedo = Color(0.5, 0.25, 0.8);
  }
  scene.materials[3].albedo = Color(0.0); // the lamp
  Camera camera = scene.cameras[0];
  camera.lookAt = Vec3(0.5, 0.5, 0.8); // the lamp as well
  Solver solver = MakeSolver(scene);
  SolveFor(solver, camera);
  GatherSettings settings;
  settings.width = 32;
  settings.height = 32;
  settings.pixelCentres = true;
  const GatheredView view = solver.Gather(camera, settings);
  int walls = 0;
  int lamps = 0;
  for (std::size_t k = 0; k < view.radiance.pixels.size(); ++k)
  {
    const Color& radiance = view.radiance.pixels[k];
    const Color& irradiance = view.irradiance.pixels[k];
    if (radiance == scene.materials[3].emission)
    {
      EXPECT_GT(Mean(irradiance), 0.0);
      ++lamps;
    }
    else if (view.patch[k] != None)
    {
      const Color expected = Color(0.5, 0.25, 0.8) / Pi * irradiance;
      ASSERT_LT(MaxChannel(glm::abs(radiance - expected)), 1e-12 * MaxChannel(radiance)) << k;
      ++walls;
    }
  }
  EXPECT_GT(walls, 500);
  EXPECT_GT(lamps, 3);
}

TEST(Irradiance, IsKnownOfElementsAndTheirPoints)
{
  const Scene scene = test::MakeLitBox();
  Solver solver = MakeSolver(scene);
  SolveFor(solver, scene.cameras[0]);
  const ElementSolution elements = solver.Elements();
  ASSERT_EQ(elements.irradiance.size(), elements.radiance.size());
  for (std::size_t k = 0; k < elements.radiance.size(); ++k)
  {
    const Color expected = elements.emission[k] + elements.albedo[k] / Pi * elements.irradiance[k];
    EXPECT_LT(MaxChannel(glm::abs(elements.radiance[k] - expected)), 1e-12 * MaxChannel(expected));
  }
  // Gathered, it is another estimate of the same: their means differ by the error.
  const ElementSolution gathered = solver.GatherElements(scene.cameras[0], 0.05).elements;
  ASSERT_EQ(gathered.pointIrradiance.size(), gathered.surface.points.size());
  double byPoints = 0.0;
  double byElements = 0.0;
  for (std::size_t p = 0; p < gathered.surface.PolygonCount(); ++p)
  {
    const double area = (*gathered.tree)[gathered.surface.elements[p]].area;
    const std::uint32_t first = gathered.surface.offsets[p];
    const std::uint32_t last = gathered.surface.offsets[p + 1];
    for (std::uint32_t i = first; i < last; ++i)
    {
      byPoints +=
        area / (last - first) * Mean(gathered.pointIrradiance[gathered.surface.indices[i]]);
    }
    byElements += area * Mean(gathered.irradiance[p]);
  }
  EXPECT_NEAR(byPoints / byElements, 1.0, 0.05);
}

} // namespace
} // namespace vantage
