#include "core/scene/Camera.h"

#include "core/Error.h"

#include <cmath>

namespace vantage
{

namespace
{

bool IsFinite(const Vec3& v)
{
  return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

} // namespace

void Camera::Validate() const
{
  const std::string who = this->name.empty() ? "camera: " : "camera '" + this->name + "': ";
  if (!IsFinite(this->eye) || !IsFinite(this->lookAt) || !IsFinite(this->up))
  {
    throw InputError(who + "eye, look-at and up must be finite numbers");
  }
  if (!(this->fieldOfView > 0.0 && this->fieldOfView < 180.0))
  {
    throw InputError(who + "field of view is " + std::to_string(this->fieldOfView) +
                     " degrees; give one between 0 and 180, both excluded");
  }
  if (!(this->aspect > 0.0 && std::isfinite(this->aspect)))
  {
    throw InputError(who + "aspect ratio is " + std::to_string(this->aspect) +
                     "; give a width and a height above zero");
  }
  const Vec3 sight = this->lookAt - this->eye;
  if (!(glm::length(sight) > 0.0))
  {
    throw InputError(who + "eye and look-at are the same point; move one of them");
  }
  const double sine = glm::length(glm::cross(glm::normalize(sight), this->up));
  if (!(sine > 1e-9 * glm::length(this->up)))
  {
    throw InputError(who + "up is parallel to the line of sight; choose another up vector");
  }
}

ImagePlane::ImagePlane(const Camera& camera)
{
  const double halfHeight = std::tan(camera.fieldOfView * Pi / 360.0);
  this->eye = camera.eye;
  this->forward = glm::normalize(camera.lookAt - camera.eye);
  const Vec3 side = glm::normalize(glm::cross(this->forward, camera.up));
  this->right = side * (halfHeight * camera.aspect);
  this->up = glm::cross(side, this->forward) * halfHeight;
}

} // namespace vantage
