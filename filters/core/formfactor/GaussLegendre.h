#pragma once

/// \file GaussLegendre.h
/// Gauss-Legendre rules on the unit interval.

namespace vantage
{

/// Integral over [0, 1] of f = sum of weights[i] f(nodes[i]), exact for polynomials of degree
/// 2 count - 1.
struct GaussRule
{
  int count;
  const double* nodes;   ///< ascending, in (0, 1)
  const double* weights; ///< positive, sum 1
};

inline constexpr int MaxGaussPoints = 16;

/// The smallest rule in the table with at least that many points: 1 .. 6, 8, 10, 12 and 16 exist.
/// \pre points <= MaxGaussPoints
const GaussRule& GaussLegendre(int points);

} // namespace vantage
