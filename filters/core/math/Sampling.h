#pragma once

#include "core/math/Types.h"

#include <cstdint>

/// \file Sampling.h
/// Random numbers that are a pure function of (seed, ids), so that results do not depend on the
/// number of threads or on the order of evaluation.

namespace vantage
{

/// Mixes a key into a 64-bit hash (finalizer of SplitMix64, Steele et al. 2014).
inline std::uint64_t Hash(std::uint64_t key)
{
  key += 0x9e3779b97f4a7c15ull;
  key = (key ^ (key >> 30)) * 0xbf58476d1ce4e5b9ull;
  key = (key ^ (key >> 27)) * 0x94d049bb133111ebull;
  return key ^ (key >> 31);
}

template <typename... Rest>
std::uint64_t Hash(std::uint64_t first, std::uint64_t second, Rest... rest)
{
  return Hash(Hash(first) ^ second, static_cast<std::uint64_t>(rest)...);
}

/// A uniform number in [0, 1) from the top 53 bits of a hash.
inline double ToUnit(std::uint64_t hash)
{
  return static_cast<double>(hash >> 11) * 0x1.0p-53;
}

/// A stream of uniform numbers in [0, 1): counter based, cheap to construct anywhere.
class RandomStream
{
public:
  template <typename... Ids>
  explicit RandomStream(std::uint64_t seed, Ids... ids)
    : State(Hash(seed, static_cast<std::uint64_t>(ids)...))
  {
  }

  double Next() { return ToUnit(Hash(this->State++)); }
  Vec2 Next2()
  {
    const double u = this->Next();
    return { u, this->Next() };
  }

private:
  std::uint64_t State;
};

/// Radical inverse of i in base 2 (van der Corput), in [0, 1).
double RadicalInverse2(std::uint32_t i);

/// A right-handed orthonormal frame whose z axis is the unit vector `normal` (Duff et al. 2017).
struct Frame
{
  Vec3 x, y, z;

  explicit Frame(const Vec3& normal);
  Vec3 ToWorld(const Vec3& local) const
  {
    return local.x * this->x + local.y * this->y + local.z * this->z;
  }
};

/// Direction in the hemisphere about +z with density cos(theta) / pi (Malley).
Vec3 CosineHemisphere(const Vec2& u);

} // namespace vantage
