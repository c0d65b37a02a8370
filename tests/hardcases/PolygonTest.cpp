#include "hardcases/HardCase.h"
#include "support/TestScenes.h"

namespace vantage
{
namespace
{

/// A closed room of one albedo that glows: radiance is 1 / (1 - albedo) everywhere, whatever its
/// shape. Oracle: closed form.
double FurthestFromFurnace(const Scene& scene, double albedo)
{
  const Solver solver = test::SolvedCase(scene, 0.05);
  double furthest = 0.0;
  for (const Color& radiance : solver.Elements().radiance)
  {
    furthest = std::max(furthest, std::abs(Mean(radiance) * (1.0 - albedo) - 1.0));
  }
  return furthest;
}

/// A room over any floor, with its walls: floor and ceiling have as many corners as there are
/// walls.
Scene MakeRoomOver(const std::vector<Vec2>& plan, double height, double albedo)
{
  Scene scene;
  scene.materials = { test::MakeMaterial(Color(albedo), Color(1.0)) };
  std::vector<Vec3> floor, ceiling;
  for (const Vec2& p : plan)
  {
    floor.emplace_back(p.x, p.y, 0.0);
    ceiling.emplace(ceiling.begin(), p.x, p.y, height);
  }
  scene.AddPolygon(floor, 0);
  scene.AddPolygon(ceiling, 0);
  for (std::size_t k = 0; k < plan.size(); ++k)
  {
    const Vec2& a = plan[k];
    const Vec2& b = plan[(k + 1) % plan.size()];
    scene.AddPolygon(
      { Vec3(a.x, a.y, 0), Vec3(a.x, a.y, height), Vec3(b.x, b.y, height), Vec3(b.x, b.y, 0) }, 0);
  }
  scene.cameras = { test::InsideCamera() };
  return scene;
}

TEST(HardCase, ConcavePolygonsCloseARoom)
{
  const std::vector<Vec2> l = { { 0, 0 }, { 2, 0 }, { 2, 1 }, { 1, 1 }, { 1, 3 }, { 0, 3 } };
  std::vector<Vec2> comb = { { 0, 0 }, { 5, 0 } };
  for (int k = 4; k >= 0; --k) // teeth of 0.5 with gaps of 0.5
  {
    comb.insert(comb.end(), { { k + 1.0, 3 }, { k + 0.5, 3 }, { k + 0.5, 1 }, { k + 0.0, 1 } });
  }
  for (const std::vector<Vec2>& plan : { l, comb })
  {
    const Image picture = test::CasePicture(MakeRoomOver(plan, 1.0, 0.5), 0.01);
    for (const Color& pixel : picture.pixels)
    {
      ASSERT_NEAR(Mean(pixel) * (1.0 - 0.5), 1.0, 0.02) << plan.size() << " corners";
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
