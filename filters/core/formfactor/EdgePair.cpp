#include "core/formfactor/EdgePair.h"

#include "core/formfactor/PanelQuadrature.h"

#include <algorithm>
#include <cmath>

namespace vantage
{
namespace
{

// Directions with a smaller sine are parallel up to rounding.
constexpr double ParallelSine = 1e-14;

// Rounding in the point where two lines are nearest costs 1e-16 over the sine of their angle.
constexpr double SkewSine = 1e-4;

// The terms on the border cancel, the more so the farther outside the edges the lines are nearest;
// in units of the lengths of the edges and their distance.
constexpr double NearestReach = 16.0;

/// ln |x - y|^2; where it is asked for points that touch, the value is multiplied by zero.
double LogOfSquare(const Vec3& x, const Vec3& y)
{
  const Vec3 d = x - y;
  const double squared = glm::dot(d, d);
  return squared > 0.0 ? std::log(squared) : 0.0;
}

EndLogs LogsBetween(const Edge& e, const Edge& f)
{
  const Vec3 endE = e.At(e.length);
  const Vec3 endF = f.At(f.length);
  return { { { LogOfSquare(e.start, f.start), LogOfSquare(e.start, endF) },
    { LogOfSquare(endE, f.start), LogOfSquare(endE, endF) } } };
}

/// Integral of ln |x - y|^2 over y on the edge f, plus 2 |f|. Lines through x included.
double PointLogIntegral(const Vec3& x, const Edge& f, double logStart, double logEnd)
{
  const Vec3 toStart = f.start - x;
  const double u0 = glm::dot(toStart, f.direction);
  const double u1 = u0 + f.length;
  const double h = glm::length(glm::cross(toStart, f.direction));
  return u1 * logEnd - u0 * logStart + 2.0 * h * std::atan2(h * f.length, h * h + u0 * u1);
}

/// Edges on parallel lines at distance h: Q = u^2 + h^2 with u the offset along the lines, so the
/// integral is the second difference of an antiderivative of the second order.
double ParallelLogIntegral(const Edge& e, const Edge& f, const EndLogs& logs)
{
  const Vec3 between = f.start - e.start;
  const double sign = glm::dot(e.direction, f.direction) > 0.0 ? 1.0 : -1.0;
  const double h = glm::length(glm::cross(between, f.direction));
  const double offset = glm::dot(between, f.direction);
  const auto second = [h](double u, double log)
  { return 0.5 * (u - h) * (u + h) * log + 2.0 * h * u * std::atan2(u, h); };
  const double back = sign * e.length;
  return sign * (second(offset + f.length, logs[0][1]) - second(offset, logs[0][0]) -
                  second(offset + f.length - back, logs[1][1]) + second(offset - back, logs[1][0]));
}

/// Two lines at an angle, and where they are nearest.
struct LinePair
{
  double sine;
  double nearestOnE, nearestOnF; ///< s0, t0
  double distance;               ///< d

  LinePair(const Edge& e, const Edge& f, const Vec3& normal, double sineOfAngle)
    : sine(sineOfAngle)
  {
    const Vec3 w = e.start - f.start;
    // Not from dot products: when the angle is small these cancel.
    this->nearestOnE = -glm::dot(glm::cross(w, f.direction), normal) / (sine * sine);
    this->nearestOnF =
      glm::dot(w, f.direction) + glm::dot(e.direction, f.direction) * this->nearestOnE;
    this->distance = std::abs(glm::dot(w, normal)) / sine;
  }
};

/// Where integrands over e are singular: at the ends of f, and where the lines are nearest.
AnalyticStrip StripOf(const Edge& e, const Edge& f, const LinePair& lines)
{
  AnalyticStrip strip;
  for (const Vec3& end : { f.start, f.At(f.length) })
  {
    const Vec3 d = end - e.start;
    strip.Add({ glm::dot(d, e.direction), glm::length(glm::cross(d, e.direction)) });
  }
  if (lines.nearestOnF >= 0.0 && lines.nearestOnF <= f.length)
  {
    strip.Add({ lines.nearestOnE, lines.distance / lines.sine });
  }
  return strip;
}

/// Edges at a small angle: closed form over f, rules over e.
double NearlyParallelLogIntegral(
  const Edge& e, const Edge& f, const LinePair& lines, double tolerance)
{
  const Vec3 endF = f.At(f.length);
  const auto overF = [&](double s)
  {
    const Vec3 x = e.At(s);
    return PointLogIntegral(x, f, LogOfSquare(x, f.start), LogOfSquare(x, endF));
  };
  // What is singular is of the kind u ln u^2 with u about the length of the panel.
  const auto bound = [](const Panel& panel) { return 8.0 * panel.Length() * panel.Length(); };
  const double integral =
    IntegrateOnPanels(e.length, StripOf(e, f, lines), tolerance, overF, bound);
  // The closed forms leave out three times the product of the lengths, the inner one alone two.
  return integral + e.length * f.length;
}

/// Integral over both edges of d^2 / Q.
double GapIntegral(const Edge& e, const Edge& f, const LinePair& lines, double tolerance)
{
  const double d2 = lines.distance * lines.distance;
  // Over t it is an angle over a distance h, both from e(s) to f.
  const Vec3 w = e.start - f.start;
  const Vec3 moment = glm::cross(w, f.direction);
  const Vec3 momentPerLength = glm::cross(e.direction, f.direction);
  const double along = -glm::dot(w, f.direction);
  const double alongPerLength = -glm::dot(e.direction, f.direction);
  const auto overF = [&](double s)
  {
    const Vec3 m = moment + s * momentPerLength;
    const double h2 = glm::dot(m, m);
    const double h = std::sqrt(h2);
    const double u0 = along + s * alongPerLength;
    return h > 0.0 ? d2 * std::atan2(h * f.length, h2 + u0 * (u0 + f.length)) / h : 0.0;
  };
  const auto bound = [&](const Panel& panel)
  {
    const double s = std::clamp(lines.nearestOnE, panel.from, panel.to);
    const double h = glm::length(moment + s * momentPerLength);
    return h > 0.0 ? d2 * std::min(Pi, f.length / h) / h * panel.Length() : 0.0;
  };
  return IntegrateOnPanels(e.length, StripOf(e, f, lines), tolerance, overF, bound);
}

double SkewLogIntegral(
  const Edge& e, const Edge& f, const EndLogs& logs, const LinePair& lines, double tolerance)
{
  const double s0 = lines.nearestOnE;
  const double t0 = lines.nearestOnF;
  const double border =
    (e.length - s0) * PointLogIntegral(e.At(e.length), f, logs[1][0], logs[1][1]) +
    s0 * PointLogIntegral(e.start, f, logs[0][0], logs[0][1]) +
    (f.length - t0) * PointLogIntegral(f.At(f.length), e, logs[0][1], logs[1][1]) +
    t0 * PointLogIntegral(f.start, e, logs[0][0], logs[1][0]);
  return 0.5 * border + GapIntegral(e, f, lines, tolerance);
}

} // namespace

double LogIntegral(const Edge& e, const Edge& f, const EndLogs& logs, double tolerance)
{
  const Vec3 normal = glm::cross(e.direction, f.direction);
  const double sine = glm::length(normal);
  if (sine < ParallelSine)
  {
    return ParallelLogIntegral(e, f, logs);
  }
  // Turning e into the direction of f moves its points by up to the sine times its length, and the
  // integral by that times the shorter length times a logarithm.
  constexpr double change = 32.0;
  if (change * sine * e.length * std::min(e.length, f.length) < tolerance)
  {
    const double sign = glm::dot(e.direction, f.direction) > 0.0 ? 1.0 : -1.0;
    const Edge turned{ e.start, sign * f.direction, e.length };
    return ParallelLogIntegral(turned, f, LogsBetween(turned, f));
  }
  const LinePair lines(e, f, normal, sine);
  const double reach = NearestReach * (e.length + f.length + glm::distance(e.start, f.start));
  if (sine > SkewSine && std::abs(lines.nearestOnE) <= reach)
  {
    return SkewLogIntegral(e, f, logs, lines, tolerance);
  }
  return NearlyParallelLogIntegral(e, f, lines, tolerance);
}

} // namespace vantage
