#include "hardcases/HardCase.h"
#include "support/TestScenes.h"

namespace vantage
{
namespace
{

/// A closed room of one albedo that glows: radiance is 1 / (1 - albedo) everywhere, whatever its
/// shape. Oracle: closed form.
double FurthestFromFurnace(const Scene& scene, double albedo, double asked = 0.05)
{
  const Solver solver = test::SolvedCase(scene, asked);
  double furthest = 0.0;
  for (const Color& radiance : solver.Elements().radiance)
  {
    furthest = std::max(furthest, std::abs(Mean(radiance) * (1.0 - albedo) - 1.0));
  }
  return furthest;
}

TEST(HardCase, ConcavePolygonsCloseARoom)
{
  const std::vector<Vec2> l = { { 0, 0 }, { 2, 0 }, { 2, 1 }, { 1, 1 }, { 1, 3 }, { 0, 3 } };
  for (const std::vector<Vec2>& plan : { l, test::CombPlan() })
  {
    SCOPED_TRACE(std::to_string(plan.size()) + " corners");
    const Scene scene = test::MakeGlowingRoom(plan, 1.0, 0.5);
    const Image picture = test::CasePicture(scene, 0.01);
    for (const Color& pixel : picture.pixels)
    {
      ASSERT_NEAR(Mean(pixel) * (1.0 - 0.5), 1.0, 0.02);
    }
    // Every element, those that no view needs as well, however coarse the links are: sweeps end
    // when 5e-4 is left.
    for (const double asked : { 0.2, 0.1, 0.05, 0.02 })
    {
      EXPECT_LT(FurthestFromFurnace(scene, 0.5, asked), 1e-3) << asked;
    }
  }
}

/// The ceiling is bent across its diagonal, and the walls reach up to it.
TEST(HardCase, NonPlanarQuadsCloseARoom)
{
  for (const double bend : { 1e-6, 1e-4, 1e-2, 0.5 })
  {
    Scene scene = test::MakeFurnace(Color(0.5));
    for (Vec3& vertex : scene.vertices)
    {
      if (vertex == Vec3(1.0))
      {
        vertex.z += bend;
      }
    }
    EXPECT_LT(FurthestFromFurnace(scene, 0.5), 1e-3) << bend;
  }
}

TEST(HardCase, NothingButFacesWithoutAreaIsRefused)
{
  Scene scene;
  scene.materials = { test::MakeMaterial(Color(0.5)) };
  scene.AddPolygon({ Vec3(0.1), Vec3(0.5), Vec3(0.9) }, 0);
  scene.AddPolygon({ Vec3(0.2), Vec3(0.2), Vec3(0.2) }, 0);
  EXPECT_THROW(Solver{ scene }, InputError);
}

/// Alone, a lamp shows its emission, and anything else is black.
TEST(HardCase, ASinglePatch)
{
  Scene scene;
  scene.materials = { test::MakeMaterial(Color(0.5), Color(3.0)) };
  scene.AddPolygon({ Vec3(0, 0, 0), Vec3(2, 0, 0), Vec3(2, 2, 0), Vec3(0, 2, 0) }, 0);
  scene.cameras = { test::InsideCamera() };
  const Image lit = test::CasePicture(scene, 0.01);
  for (const Color& pixel : lit.pixels)
  {
    EXPECT_TRUE(pixel == Color(3.0) || pixel == Color(0.0));
  }
  EXPECT_GT(test::MeanRadiance(lit), 1.5);
  scene.materials[0].emission = Color(0.0);
  EXPECT_EQ(test::MeanRadiance(test::CasePicture(scene, 0.01)), 0.0);
}

} // namespace
} // namespace vantage
