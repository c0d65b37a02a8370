#include "core/view/LampKernel.h"

#include <algorithm>
#include <cmath>

namespace vantage
{

namespace
{

constexpr int SeriesTerms = 16;
/// sin^2 of half an angle up to which that many terms, or half of them, err by less than 1e-13.
constexpr double SeriesReach = 0.14;
constexpr double ShortReach = 0.02;

/// Coefficients of angle / sine in powers of sin^2(angle / 2).
constexpr std::array<double, SeriesTerms> Series = []
{
  std::array<double, SeriesTerms> c{};
  c[0] = 1.0;
  for (int k = 1; k < SeriesTerms; ++k)
  {
    c[k] = c[k - 1] * (2.0 * k) / (2.0 * k + 1.0);
  }
  return c;
}();

/// The first terms of the series, in two chains, since each step of one waits for the one before.
template <int Terms>
double SumOfSeries(double y)
{
  const double square = y * y;
  double even = Series[Terms - 2];
  double odd = Series[Terms - 1];
  for (int k = Terms - 4; k >= 0; k -= 2)
  {
    even = even * square + Series[k];
    odd = odd * square + Series[k + 1];
  }
  return even + odd * y;
}

/// angle / sin(angle), from y = sin^2(angle / 2).
double AngleOverSine(double y)
{
  if (y <= ShortReach)
  {
    return SumOfSeries<SeriesTerms / 2>(y);
  }
  if (y <= SeriesReach)
  {
    return SumOfSeries<SeriesTerms>(y);
  }
  // Of an edge through the point itself nothing is seen: what this is multiplied with is 0.
  const double cosine = std::sqrt(std::max(1.0 - y, 1e-300));
  const double sine = std::sqrt(y);
  return std::atan2(sine, cosine) / (sine * cosine);
}

} // namespace

double LambertTerm(double from, double to, double square, double wedge)
{
  const double product = from * to;
  if (!(product > 0.0))
  {
    return 0.0;
  }
  const double inverse = 1.0 / product;
  const double difference = from - to;
  const double y = 0.25 * (square - difference * difference) * inverse;
  return AngleOverSine(y) * wedge * inverse;
}

LampKernel::LampKernel(const Polygon& lamp)
  : Count(lamp.Size())
{
  for (int i = 0; i < this->Count; ++i)
  {
    const Vec3 along = lamp[(i + 1) % this->Count] - lamp[i];
    this->Edges[i] = { lamp[i].x, lamp[i].y, lamp[i].z, along.x, along.y, glm::dot(along, along) };
  }
}

double LampKernel::At(const Vec2& x) const
{
  std::array<double, Polygon::Capacity> lengths;
  for (int i = 0; i < this->Count; ++i)
  {
    const Edge& edge = this->Edges[i];
    const double dx = edge.x - x.x;
    const double dy = edge.y - x.y;
    lengths[i] = std::sqrt(dx * dx + dy * dy + edge.z * edge.z);
  }
  double sum = 0.0;
  for (int i = 0; i < this->Count; ++i)
  {
    const Edge& edge = this->Edges[i];
    const double from = lengths[i];
    const double to = lengths[i + 1 < this->Count ? i + 1 : 0];
    const double wedge = edge.alongX * (edge.y - x.y) - edge.alongY * (edge.x - x.x);
    sum += LambertTerm(from, to, edge.square, wedge);
  }
  return std::clamp(0.5 * sum, 0.0, Pi);
}

} // namespace vantage
