#pragma once

#include "core/math/Types.h"

#include <cstdint>

/// \file ScrambledSobol.h
/// Well spread points of the unit square, as many as are asked for, independent for each seed.

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

/// Owen's nested uniform scrambling of a binary fraction by a hash in which a bit depends on the
/// higher bits only (Laine, Karras 2011; constants of Vegdahl 2021).
inline std::uint32_t OwenScramble(std::uint32_t x, std::uint32_t seed)
{
  x = ReverseBits(x);
  x ^= x * 0x3d20adeau;
  x += seed;
  x *= (seed >> 16) | 1u;
  x ^= x * 0x05526c56u;
  x ^= x * 0x53a22864u;
  return ReverseBits(x);
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
  std::uint32_t second = 0;
  std::uint32_t direction = 1u << 31;
  for (std::uint32_t bits = shuffled; bits != 0; bits >>= 1)
  {
    second ^= (bits & 1u) != 0 ? direction : 0u;
    direction ^= direction >> 1;
  }
  const std::uint32_t x = OwenScramble(ReverseBits(shuffled), high);
  const std::uint32_t y = OwenScramble(second, low ^ (high * 0x9e3779b9u));
  return { x * 0x1.0p-32, y * 0x1.0p-32 };
}

} // namespace vantage
