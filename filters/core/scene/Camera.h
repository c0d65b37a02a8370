#pragma once

#include "core/math/Types.h"

#include <string>

/// \file Camera.h
/// A pinhole camera.

namespace vantage
{

struct Camera
{
  std::string name;
  Vec3 eye{ 0.0, 0.0, 0.0 };
  Vec3 lookAt{ 0.0, 0.0, -1.0 };
  Vec3 up{ 0.0, 1.0, 0.0 };
  double fieldOfView = 45.0; ///< vertical, degrees, in (0, 180)
  double aspect = 1.0;       ///< width / height, > 0

  /// \throw InputError when a number is not finite, the field of view or aspect is out of range or
  /// both leave an image whose area at distance 1 is not within [1e-100, 1e100], eye and lookAt
  /// coincide, or up is parallel to the line of sight.
  void Validate() const;
};

/// The camera's image plane at distance 1 from the eye: the point (s, t) of the image, both in
/// [-1, 1], s to the right and t up, lies at eye + forward + s * right + t * up.
struct ImagePlane
{
  Vec3 eye, forward, right, up; ///< forward has length 1; right and up are half the image's extent

  explicit ImagePlane(const Camera& camera);

  /// Direction through (s, t), not normalised: its component along `forward` is 1.
  Vec3 Direction(double s, double t) const
  {
    return this->forward + s * this->right + t * this->up;
  }
  /// Area of the whole image on the plane at distance 1.
  double Area() const { return 4.0 * glm::length(this->right) * glm::length(this->up); }
};

} // namespace vantage
