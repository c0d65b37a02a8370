#include "view/Walking.h"

#include <glm/gtc/matrix_transform.hpp>

#include <algorithm>
#include <cmath>

namespace vantage
{

namespace
{

constexpr double LeastFromUp = 5.0 * Pi / 180.0;

Vec3 Rotated(const Vec3& v, double angle, const Vec3& axis)
{
  return Vec3(glm::rotate(glm::dmat4(1.0), angle, axis) * glm::dvec4(v, 0.0));
}

} // namespace

Camera Turned(const Camera& camera, double toRight, double upward)
{
  const Vec3 up = glm::normalize(camera.up);
  const Vec3 gaze = Rotated(camera.lookAt - camera.eye, -toRight, up);
  const Vec3 right = glm::normalize(glm::cross(gaze, up));
  const double fromUp = std::acos(std::clamp(glm::dot(glm::normalize(gaze), up), -1.0, 1.0));
  const double wanted = std::clamp(fromUp - upward, LeastFromUp, Pi - LeastFromUp);
  Camera turned = camera;
  turned.lookAt = camera.eye + Rotated(gaze, fromUp - wanted, right);
  return turned;
}

Camera Moved(const Camera& camera, double forward, double toRight, double upward)
{
  const Vec3 up = glm::normalize(camera.up);
  const Vec3 gaze = glm::normalize(camera.lookAt - camera.eye);
  const Vec3 right = glm::normalize(glm::cross(gaze, up));
  const Vec3 step = forward * gaze + toRight * right + upward * up;
  Camera moved = camera;
  moved.eye += step;
  moved.lookAt += step;
  return moved;
}

} // namespace vantage
