#pragma once

#include "core/math/Types.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

/// \file SmoothFit.h
/// A function of two variables from a few of its values, where it is smooth enough.

namespace vantage
{

/// The polynomial, quadratic along both axes, with given values at 3 x 3 places that are spread
/// evenly over a rectangle, corners included.
class BiquadraticFit
{
public:
  static constexpr int Count = 9;

  BiquadraticFit(const Vec2& low, const Vec2& high)
    : Low(low)
    , Size(high - low)
    , Scale(1.0 / glm::max(this->Size, Vec2(1e-300)))
  {
  }

  /// `u` from 0 to 1 over the rectangle.
  Vec2 PlaceAt(const Vec2& u) const { return this->Low + u * this->Size; }
  /// Of a given value: row by row from the low corner.
  Vec2 Place(int k) const { return this->PlaceAt(0.5 * Vec2(k % 3, k / 3)); }
  double& operator[](int k) { return this->Values[k]; }
  double operator[](int k) const { return this->Values[k]; }

  double At(const Vec2& place) const
  {
    const Vec2 u = (place - this->Low) * this->Scale;
    const std::array<double, 3> x = Weights(u.x);
    const std::array<double, 3> y = Weights(u.y);
    double sum = 0.0;
    for (int row = 0; row < 3; ++row)
    {
      const double* v = &this->Values[3 * row];
      sum += y[row] * (x[0] * v[0] + x[1] * v[1] + x[2] * v[2]);
    }
    return sum;
  }

private:
  static std::array<double, 3> Weights(double u)
  {
    return { (1.0 - u) * (1.0 - 2.0 * u), 4.0 * u * (1.0 - u), u * (2.0 * u - 1.0) };
  }

  Vec2 Low, Size, Scale;
  std::array<double, Count> Values{};
};

/// A fit to f(place) >= 0 over a rectangle, if at four more places it is within `tolerance` of f
/// and, at the places of its values, f is nearly linear: within `LargestBend` tolerances of what
/// its neighbours in a row say. Thirteen values of f, mostly five where it fails.
/// \param relativeTolerance the tolerance, relative to the largest of five of these values
template <typename Function>
std::optional<BiquadraticFit> FitSmooth(
  const Vec2& low, const Vec2& high, double relativeTolerance, const Function& f)
{
  constexpr double LargestBend = 8.0;
  BiquadraticFit fit(low, high);
  const auto isNear = [](double a, double b, double distance)
  { return std::abs(a - b) <= distance; };
  double largest = 0.0;
  for (const int k : { 0, 2, 6, 8, 4 })
  {
    fit[k] = f(fit.Place(k));
    largest = std::max(largest, fit[k]);
  }
  const double tolerance = relativeTolerance * largest;
  if (!isNear(0.25 * (fit[0] + fit[2] + fit[6] + fit[8]), fit[4], LargestBend * tolerance))
  {
    return std::nullopt;
  }
  for (const int side : { 1, 3, 5, 7 })
  {
    fit[side] = f(fit.Place(side));
    const int step = side % 3 == 1 ? 1 : 3;
    if (!isNear(0.5 * (fit[side - step] + fit[side + step]), fit[side], LargestBend * tolerance))
    {
      return std::nullopt;
    }
  }
  for (const Vec2& u : { Vec2(0.25, 0.25), Vec2(0.75, 0.25), Vec2(0.25, 0.75), Vec2(0.75, 0.75) })
  {
    const Vec2 place = fit.PlaceAt(u);
    if (!isNear(fit.At(place), f(place), tolerance))
    {
      return std::nullopt;
    }
  }
  return fit;
}

} // namespace vantage
