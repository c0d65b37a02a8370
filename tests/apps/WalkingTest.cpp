#include "view/Walking.h"

#include <gtest/gtest.h>

#include <cmath>

namespace vantage
{
namespace
{

Camera LookingAlongX()
{
  Camera camera;
  camera.eye = Vec3(1, 2, 3);
  camera.lookAt = Vec3(3, 2, 3);
  camera.up = Vec3(0, 0, 2); // of any length
  return camera;
}

void ExpectNear(const Vec3& found, const Vec3& expected)
{
  EXPECT_LT(glm::distance(found, expected), 1e-12) << found.x << ' ' << found.y << ' ' << found.z;
}

TEST(Walking, TurnsToTheRightAndUp)
{
  const Camera camera = LookingAlongX();
  const Camera right = Turned(camera, 0.5 * Pi, 0.0);
  ExpectNear(right.lookAt, Vec3(1, 0, 3));
  const Camera up = Turned(camera, 0.0, 0.25 * Pi);
  ExpectNear(up.lookAt, Vec3(1 + std::sqrt(2.0), 2, 3 + std::sqrt(2.0)));
  for (const Camera& turned : { right, up })
  {
    EXPECT_EQ(turned.eye, camera.eye);
    EXPECT_EQ(turned.up, camera.up);
  }
  const Camera back = Turned(Turned(camera, 0.3, 0.0), -0.3, 0.0);
  ExpectNear(back.lookAt, camera.lookAt);
}

TEST(Walking, NeverLooksStraightUpOrDown)
{
  const double least = 5.0 * Pi / 180.0;
  for (const double upward : { 10.0, -10.0 })
  {
    Camera camera = LookingAlongX();
    for (int i = 0; i < 100; ++i)
    {
      camera = Turned(camera, 0.1, upward / 50.0);
      camera.Validate();
    }
    const Vec3 gaze = glm::normalize(camera.lookAt - camera.eye);
    EXPECT_NEAR(std::acos(std::abs(gaze.z)), least, 1e-9); // round-off near the pole
    EXPECT_EQ(gaze.z > 0.0, upward > 0.0);
  }
}

TEST(Walking, GoesWhereItLooks)
{
  const Camera camera = LookingAlongX();
  const Camera moved = Moved(camera, 0.5, 0.25, 0.125);
  ExpectNear(moved.eye, Vec3(1.5, 1.75, 3.125));
  ExpectNear(moved.lookAt - moved.eye, camera.lookAt - camera.eye);
  const Camera down = Moved(Turned(camera, 0.0, -0.25 * Pi), std::sqrt(2.0), 0.0, 0.0);
  ExpectNear(down.eye, Vec3(2, 2, 2));
}

} // namespace
} // namespace vantage
