#pragma once

#include "core/math/Sampling.h"

#include <array>
#include <cstdint>

/// \file ScrambledSobol.h
/// Well spread points of the unit square and of the unit cube of four dimensions, as many as are
/// asked for, independent for each seed.

namespace vantage
{

inline std::uint32_t ReverseBits(std::uint32_t x)
{
  x = (x << 16) | (x >> 16);
  x = ((x & 0x00ff00ffu) << 8) | ((x & 0xff00ff00u) >> 8);
  x = ((x & 0x0f0f0f0fu) << 4) | ((x & 0xf0f0f0f0u) >> 4);
  x = ((x & 0x33333333u) << 2) | ((x & 0xccccccccu) >> 2);
  return ((x & 0x55555555u) << 1) | ((x & 0xaaaaaaaau) >> 1);
}

/// A hash in which a bit depends on the lower bits only (Laine, Karras 2011; constants of Vegdahl
/// 2021).
inline std::uint32_t HashUpwards(std::uint32_t x, std::uint32_t seed)
{
  x ^= x * 0x3d20adeau;
  x += seed;
  x *= (seed >> 16) | 1u;
  x ^= x * 0x05526c56u;
  return x ^ (x * 0x53a22864u);
}

/// Owen's nested uniform scrambling of a binary fraction.
inline std::uint32_t OwenScramble(std::uint32_t x, std::uint32_t seed)
{
  return ReverseBits(HashUpwards(ReverseBits(x), seed));
}

/// The second dimension of Sobol's sequence, its first digit in bit 0. Its matrix is Pascal's
/// triangle modulo 2: digit j is the sum of all bits whose index has all ones of j (Lucas).
inline std::uint32_t SecondOfSobol(std::uint32_t index)
{
  index ^= (index >> 1) & 0x55555555u;
  index ^= (index >> 2) & 0x33333333u;
  index ^= (index >> 4) & 0x0f0f0f0fu;
  index ^= (index >> 8) & 0x00ff00ffu;
  return index ^ (index >> 16);
}

/// Point `index` of the first two dimensions of Sobol's sequence, order and digits scrambled by
/// the seed (Burley 2020). Every point is uniform on [0, 1)^2 over the seeds; the first 2^k points
/// have one in each of 2^k equal cells of any shape; points of two seeds are independent, so that
/// several streams can be put side by side.
inline Vec2 ScrambledSobol(std::uint32_t index, std::uint64_t seed)
{
  const auto low = static_cast<std::uint32_t>(seed);
  const auto high = static_cast<std::uint32_t>(seed >> 32);
  const std::uint32_t shuffled = OwenScramble(index, low);
  // Both coordinates have their first digit in bit 0, as scrambling wants them.
  const std::uint32_t x = ReverseBits(HashUpwards(shuffled, high));
  const std::uint32_t y =
    ReverseBits(HashUpwards(SecondOfSobol(shuffled), low ^ (high * 0x9e3779b9u)));
  return { x * 0x1.0p-32, y * 0x1.0p-32 };
}

/// Direction numbers of the first four dimensions of Sobol's sequence: primitive polynomials 1,
/// x + 1, x^2 + x + 1, x^3 + x + 1 and the initial numbers of Joe and Kuo (2008).
inline constexpr std::array<std::array<std::uint32_t, 32>, 4> SobolDirections = []
{
  std::array<std::array<std::uint32_t, 32>, 4> v{};
  constexpr int Degree[4] = { 0, 1, 2, 3 };
  constexpr std::uint32_t Coefficients[4] = { 0, 0, 1, 1 };
  constexpr std::uint32_t Initial[4][3] = { { 1, 1, 1 }, { 1, 1, 1 }, { 1, 3, 1 }, { 1, 3, 1 } };
  for (int d = 0; d < 4; ++d)
  {
    const int s = Degree[d];
    for (int k = 0; k < 32; ++k)
    {
      if (d == 0 || k < s)
      {
        v[d][k] = (d == 0 ? 1u : Initial[d][k]) << (31 - k);
        continue;
      }
      v[d][k] = v[d][k - s] ^ (v[d][k - s] >> s);
      for (int i = 1; i < s; ++i)
      {
        v[d][k] ^= ((Coefficients[d] >> (s - 1 - i)) & 1u) * v[d][k - i];
      }
    }
  }
  return v;
}();

/// Point `index` of the first four dimensions of Sobol's sequence, digits scrambled by the seed. In
/// each coordinate the first 2^k points have one in each of 2^k equal parts.
inline std::array<double, 4> ScrambledSobol4(std::uint32_t index, std::uint64_t seed)
{
  std::array<double, 4> point{};
  for (std::uint64_t d = 0; d < 4; ++d)
  {
    std::uint32_t x = 0;
    for (int k = 0; index >> k != 0; ++k)
    {
      x ^= ((index >> k) & 1u) * SobolDirections[d][k];
    }
    point[d] = OwenScramble(x, static_cast<std::uint32_t>(Hash(seed, d))) * 0x1.0p-32;
  }
  return point;
}

} // namespace vantage
