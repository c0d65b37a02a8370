#include "core/scene/Camera.h"

#include "core/Error.h"

#include <gtest/gtest.h>

#include <cmath>

namespace vantage
{
namespace
{

void ExpectFault(const Camera& camera, const std::string& expected)
{
  try
  {
    camera.Validate();
    FAIL() << "no error for: " << expected;
  }
  catch (const InputError& error)
  {
    const std::string message = error.what();
    EXPECT_NE(message.find(expected), std::string::npos) << message;
    EXPECT_EQ(message.find('\n'), std::string::npos);
  }
}

TEST(Camera, DefaultIsValid)
{
  EXPECT_NO_THROW(Camera().Validate());
}

TEST(Camera, NumbersMustBeFinite)
{
  for (const double bad : { std::nan(""), HUGE_VAL, -HUGE_VAL })
  {
    for (Vec3 Camera::*vector : { &Camera::eye, &Camera::lookAt, &Camera::up })
    {
      Camera camera;
      (camera.*vector).y = bad;
      ExpectFault(camera, "finite");
    }
    Camera camera;
    camera.fieldOfView = bad;
    ExpectFault(camera, "field of view");
    camera = Camera();
    camera.aspect = bad;
    ExpectFault(camera, "aspect");
  }
}

TEST(Camera, AnglesAndAspectMustBeInRange)
{
  for (const double bad : { 0.0, -45.0, 180.0, 360.0 })
  {
    Camera camera;
    camera.fieldOfView = bad;
    ExpectFault(camera, "field of view");
  }
  for (const double bad : { 0.0, -1.0 })
  {
    Camera camera;
    camera.aspect = bad;
    ExpectFault(camera, "aspect");
  }
}

TEST(Camera, SightNeedsADirectionAndAnUp)
{
  Camera camera;
  camera.name = "here";
  camera.lookAt = camera.eye;
  ExpectFault(camera, "camera 'here': eye and look-at are the same point");
  for (const Vec3& up : { Vec3(0, 0, 2), Vec3(0, 0, -1e-3), Vec3(0, 0, 0) })
  {
    camera = Camera();
    camera.up = up;
    ExpectFault(camera, "up is parallel");
  }
}

TEST(Camera, ImagesHaveAnArea)
{
  Camera camera;
  camera.fieldOfView = 1e-60;
  ExpectFault(camera, "no or endless extent");
  camera.fieldOfView = 45.0;
  camera.aspect = 1e101;
  ExpectFault(camera, "no or endless extent");
  camera.aspect = 5e-324;
  ExpectFault(camera, "no or endless extent");
}

/// The squares of such lengths are no numbers any more.
TEST(ImagePlane, DirectionsOfAnyLengthAreTheSame)
{
  Camera camera;
  camera.lookAt = { 1, 2, -2 };
  camera.up = { 0, 1, 1 };
  const ImagePlane expected(camera);
  for (const double scale : { 1e-300, 1e-160, 1e160, 1e300 })
  {
    Camera scaled = camera;
    scaled.lookAt *= scale;
    scaled.up *= scale;
    scaled.Validate();
    const ImagePlane plane(scaled);
    EXPECT_NEAR(glm::length(plane.forward - expected.forward), 0.0, 1e-15) << scale;
    EXPECT_NEAR(glm::length(plane.right - expected.right), 0.0, 1e-15) << scale;
    EXPECT_NEAR(glm::length(plane.up - expected.up), 0.0, 1e-15) << scale;
  }
}

TEST(ImagePlane, SpansTheFieldOfView)
{
  Camera camera;
  camera.eye = { 1, 2, 3 };
  camera.lookAt = { 1, 2, -7 };
  camera.up = { 0.3, 5, 0.2 }; // need not be perpendicular to the sight
  camera.fieldOfView = 90.0;
  camera.aspect = 2.0;
  const ImagePlane plane(camera);
  // Round-off of a few operations.
  EXPECT_NEAR(glm::length(plane.forward - Vec3(0, 0, -1)), 0.0, 1e-15);
  EXPECT_NEAR(glm::length(plane.right), 2.0, 1e-15);
  EXPECT_NEAR(glm::length(plane.up), 1.0, 1e-15);
  EXPECT_NEAR(plane.Area(), 8.0, 1e-14);
  EXPECT_NEAR(glm::dot(plane.right, plane.up), 0.0, 1e-15);
  EXPECT_NEAR(glm::dot(plane.right, plane.forward), 0.0, 1e-15);
  EXPECT_GT(glm::dot(plane.up, camera.up), 0.0);
  // Right-handed: forward x up points to the right.
  EXPECT_GT(glm::dot(glm::cross(plane.forward, plane.up), plane.right), 0.0);
  const Vec3 topRight = plane.Direction(1.0, 1.0);
  EXPECT_NEAR(glm::dot(topRight, plane.forward), 1.0, 1e-15);
  EXPECT_NEAR(glm::length(topRight - (plane.forward + plane.right + plane.up)), 0.0, 1e-15);
}

TEST(ImagePlane, FieldOfViewIsVertical)
{
  for (const double degrees : { 1.0, 45.0, 120.0 })
  {
    Camera camera;
    camera.fieldOfView = degrees;
    camera.aspect = 3.0;
    const ImagePlane plane(camera);
    const double cosine = glm::dot(
      glm::normalize(plane.Direction(0.0, 1.0)), glm::normalize(plane.Direction(0.0, -1.0)));
    EXPECT_NEAR(std::acos(cosine) * 180.0 / Pi, degrees, 1e-11); // acos near 1 loses digits
  }
}

} // namespace
} // namespace vantage
