#pragma once

#include "core/math/Types.h"

#include <array>

/// \file EdgePair.h
/// The logarithm of the squared distance, integrated over two edges.

namespace vantage
{

struct Edge
{
  Vec3 start;
  Vec3 direction; ///< unit
  double length;  ///< > 0

  Vec3 At(double s) const { return this->start + s * this->direction; }
};

/// Logarithms of the squared distances between the start and the end of e (first index) and those
/// of f (second index); any number where they touch.
using EndLogs = std::array<std::array<double, 2>, 2>;

/// Integral over both edges of ln |x - y|^2, plus a multiple of the product of their lengths (the
/// same multiple for each pair). Around closed contours such a multiple adds up to nothing.
///
/// - Parallel edges: closed form.
/// - Skew edges: with x = e(s), y = f(t), Q = |x - y|^2, and (s0, t0) where the two lines are
///   nearest, at distance d,
///
///     div((s - s0, t - t0) ln Q) = 2 ln Q + 2 - 2 d^2 / Q
///
///   so the integral of ln Q is one over the border of the rectangle, four times a point and an
///   edge in closed form, and d^2 times the integral of 1 / Q: nothing when the lines meet, small
///   and smooth otherwise, and left to Gauss-Legendre rules.
/// - Edges askew so little that their lines are nearest far away: closed form over f,
///   Gauss-Legendre rules over e.
///
/// \param tolerance absolute error allowed
double LogIntegral(const Edge& e, const Edge& f, const EndLogs& logs, double tolerance);

} // namespace vantage
