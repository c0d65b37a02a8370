#include "core/math/Sampling.h"

#include <algorithm>
#include <cmath>

namespace vantage
{

double RadicalInverse2(std::uint32_t i)
{
  i = (i << 16) | (i >> 16);
  i = ((i & 0x00ff00ffu) << 8) | ((i & 0xff00ff00u) >> 8);
  i = ((i & 0x0f0f0f0fu) << 4) | ((i & 0xf0f0f0f0u) >> 4);
  i = ((i & 0x33333333u) << 2) | ((i & 0xccccccccu) >> 2);
  i = ((i & 0x55555555u) << 1) | ((i & 0xaaaaaaaau) >> 1);
  return static_cast<double>(i) * 0x1.0p-32;
}

Frame::Frame(const Vec3& normal)
  : z(normal)
{
  const double sign = std::copysign(1.0, normal.z);
  const double a = -1.0 / (sign + normal.z);
  const double b = normal.x * normal.y * a;
  this->x = Vec3(1.0 + sign * normal.x * normal.x * a, sign * b, -sign * normal.x);
  this->y = Vec3(b, sign + normal.y * normal.y * a, -normal.y);
}

Vec3 CosineHemisphere(const Vec2& u)
{
  const double r = std::sqrt(u.x);
  const double phi = 2.0 * Pi * u.y;
  return { r * std::cos(phi), r * std::sin(phi), std::sqrt(std::max(0.0, 1.0 - u.x)) };
}

} // namespace vantage
