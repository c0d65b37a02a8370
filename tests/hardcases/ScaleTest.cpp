#include "hardcases/HardCase.h"
#include "support/TestScenes.h"

#include <gtest/gtest.h>

namespace vantage
{
namespace
{

Scene Mapped(Scene scene, double scale, const Vec3& offset)
{
  for (Vec3& vertex : scene.vertices)
  {
    vertex = scale * vertex + offset;
  }
  for (Camera& camera : scene.cameras)
  {
    camera.eye = scale * camera.eye + offset;
    camera.lookAt = scale * camera.lookAt + offset;
  }
  return scene;
}

/// Oracle: invariance. Millimetres, kilometres, and 1e7 sizes away from the origin, where
/// coordinates have nine digits left.
TEST(HardCase, UnitsAndPlaceDoNotMatter)
{
  const Scene scene = test::MakeLitBox();
  const Image expected = test::CasePicture(scene, 0.02);
  const Vec3 away(1.0, -0.5, 0.3);
  for (const auto& [scale, offset] : { std::pair(1e-3, 0.0), std::pair(1e3, 0.0),
         std::pair(1e6, 0.0), std::pair(1.0, 1e7), std::pair(1e-3, 1e4) })
  {
    const Image found = test::CasePicture(Mapped(scene, scale, offset * away), 0.02);
    // Errors of both; rounding moves samples.
    EXPECT_LT(Compare(found, expected).relativeL1, 0.03) << scale << " at " << offset;
  }
}

/// A floor of a kilometre under a box of a millimetre that the camera looks at.
TEST(HardCase, AMillionToOne)
{
  Scene scene;
  scene.materials = { test::MakeMaterial(Color(0.5)), test::MakeMaterial(Color(0.5), Color(4.0)) };
  scene.AddPolygon(
    { Vec3(-500, -500, 0), Vec3(500, -500, 0), Vec3(500, 500, 0), Vec3(-500, 500, 0) }, 0);
  test::AddBox(scene, Vec3(0.0), Vec3(1e-3), false, { 0, 0, 0, 0, 0, 0 });
  scene.AddPolygon({ Vec3(-2e-3, -2e-3, 4e-3), Vec3(-2e-3, 3e-3, 4e-3), Vec3(3e-3, 3e-3, 4e-3),
                     Vec3(3e-3, -2e-3, 4e-3) },
    1);
  Camera camera = test::InsideCamera();
  camera.eye = Vec3(-3e-3, -4e-3, 3e-3);
  camera.lookAt = Vec3(5e-4, 5e-4, 3e-4);
  scene.cameras.push_back(camera);
  EXPECT_NEAR(test::RelativeToTraced(scene, 0.02, 256), 1.0, 0.02);
}

} // namespace
} // namespace vantage
