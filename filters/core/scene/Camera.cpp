#include "core/scene/Camera.h"

#include "core/Error.h"

#include <algorithm>
#include <cmath>

namespace vantage
{

namespace
{

bool IsFinite(const Vec3& v)
{
  return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

/// The same direction with length 1, however long or short it is; not a number for (0,0,0). A power
/// of two leaves the bits alone.
Vec3 UnitDirection(const Vec3& v)
{
  const double longest = std::max({ std::abs(v.x), std::abs(v.y), std::abs(v.z) });
  const int exponent = longest > 0.0 && std::isfinite(longest) ? std::ilogb(longest) : 0;
  return glm::normalize(
    Vec3(std::scalbn(v.x, -exponent), std::scalbn(v.y, -exponent), std::scalbn(v.z, -exponent)));
}

/// Areas of the image on the plane at distance 1, between which importance can be computed.
constexpr double SmallestImage = 1e-100;
constexpr double LargestImage = 1e100;

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
  const double halfHeight = std::tan(this->fieldOfView * Pi / 360.0);
  const double area = 4.0 * halfHeight * halfHeight * this->aspect;
  if (!(area >= SmallestImage && area <= LargestImage))
  {
    throw InputError(who + "field of view and aspect ratio leave an image of no or endless extent; "
                           "choose others");
  }
  if (this->lookAt == this->eye)
  {
    throw InputError(who + "eye and look-at are the same point; move one of them");
  }
  const Vec3 sight = UnitDirection(this->lookAt - this->eye);
  if (!(glm::length(glm::cross(sight, UnitDirection(this->up))) > 1e-9))
  {
    throw InputError(who + "up is parallel to the line of sight; choose another up vector");
  }
}

ImagePlane::ImagePlane(const Camera& camera)
{
  const double halfHeight = std::tan(camera.fieldOfView * Pi / 360.0);
  this->eye = camera.eye;
  this->forward = UnitDirection(camera.lookAt - camera.eye);
  const Vec3 side = glm::normalize(glm::cross(this->forward, UnitDirection(camera.up)));
  this->right = side * (halfHeight * camera.aspect);
  this->up = glm::cross(side, this->forward) * halfHeight;
}

} // namespace vantage
