#pragma once

#include "core/math/Types.h"

#include <algorithm>
#include <array>
#include <limits>

/// \file Bounds.h
/// An axis-aligned box that grows.

namespace vantage
{

/// The upper corner is kept with its sign turned, so that all six numbers grow by one operation.
class Bounds
{
public:
  /// Of nothing yet.
  Bounds() { this->Least.fill(std::numeric_limits<double>::infinity()); }
  explicit Bounds(const Vec3& p)
    : Least{ p.x, p.y, p.z, -p.x, -p.y, -p.z }
  {
  }

  void Add(const Vec3& p) { this->Add(Bounds(p)); }
  void Add(const Bounds& other)
  {
    for (std::size_t i = 0; i < 6; ++i)
    {
      this->Least[i] = std::min(this->Least[i], other.Least[i]);
    }
  }

  /// Touching is enough.
  bool Meets(const Bounds& other) const
  {
    bool meets = true;
    for (std::size_t i = 0; i < 6; ++i)
    {
      meets = meets && this->Least[i] <= -other.Least[(i + 3) % 6];
    }
    return meets;
  }

  Vec3 Low() const { return { this->Least[0], this->Least[1], this->Least[2] }; }
  Vec3 High() const { return { -this->Least[3], -this->Least[4], -this->Least[5] }; }
  Vec3 Extent() const { return this->High() - this->Low(); }
  double Diagonal() const { return glm::length(this->Extent()); }

private:
  std::array<double, 6> Least;
};

} // namespace vantage
