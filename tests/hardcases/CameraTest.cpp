#include "hardcases/HardCase.h"
#include "support/TestScenes.h"

#include <gtest/gtest.h>

namespace vantage
{
namespace
{

/// The lit box seen by another camera. Oracle: the slow twin.
double RelativeMean(const Vec3& eye, const Vec3& lookAt, double fieldOfView)
{
  Scene scene = test::MakeLitBox();
  scene.cameras[0].eye = eye;
  scene.cameras[0].lookAt = lookAt;
  scene.cameras[0].fieldOfView = fieldOfView;
  return test::RelativeToTraced(scene, 0.02, 256);
}

TEST(HardCase, ViewsOfOneAndOfManyDegrees)
{
  EXPECT_NEAR(RelativeMean(Vec3(.2, .3, .8), Vec3(.7, .2, 0), 1.0), 1.0, 0.03);
  EXPECT_NEAR(RelativeMean(Vec3(.2, .3, .8), Vec3(.7, .6, .1), 170.0), 1.0, 0.03);
}

TEST(HardCase, TheCameraOnASurfaceAndInACorner)
{
  EXPECT_NEAR(RelativeMean(Vec3(0.0, .3, .5), Vec3(.7, .6, .1), 60.0), 1.0, 0.03);
  EXPECT_NEAR(RelativeMean(Vec3(1e-9), Vec3(.7, .6, .3), 60.0), 1.0, 0.03);
}

TEST(HardCase, TheCameraInsideABody)
{
  Scene scene = test::MakeLitBox();
  scene.cameras[0].eye = Vec3(0.7, 0.6, 0.2);
  scene.cameras[0].lookAt = Vec3(0.7, 0.7, 0.2);
  EXPECT_EQ(test::MeanRadiance(test::CasePicture(scene, 0.05)), 0.0);
}

TEST(HardCase, ACameraThatLooksAwayFromAll)
{
  Scene scene = test::MakeLitBox();
  scene.cameras[0].eye = Vec3(5.0, 5.0, 5.0);
  scene.cameras[0].lookAt = Vec3(9.0, 9.0, 9.0);
  EXPECT_EQ(test::MeanRadiance(test::CasePicture(scene, 0.05)), 0.0);
}

} // namespace
} // namespace vantage
