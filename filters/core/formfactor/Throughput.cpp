#include "core/formfactor/ContourIntegral.h"
#include "core/formfactor/FacingPair.h"
#include "core/formfactor/FormFactor.h"
#include "core/formfactor/Subdivision.h"
#include "core/formfactor/SurfaceQuadrature.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace vantage
{
namespace
{

struct Targets
{
  double quadrature; ///< relative error allowed to the quadrature over each polygon
  double contour;    ///< the same of the contour integral
  int surfacePoints; ///< a side; with more, contours cost less than points that see a polygon
};

// Well below the promise, which is a bound: row sums add many pairs, and the guesses of size and
// error are rough.
constexpr Targets TargetsOf(Accuracy accuracy)
{
  return accuracy == Accuracy::Default ? Targets{ 1e-6, 1e-6, 3 } : Targets{ 1e-11, 1e-12, 6 };
}

constexpr int MostPoints = SurfaceNodes::MaxPointsPerSide;

/// n Gauss points a side leave a relative error of at most q^(2 - 2 n) / 10, with q the distance
/// from the centre of a polygon to all of the other one, in radii: both cosines and the Jacobian of
/// a triangle take up a degree each. The factor is the worst of 400,000 random pairs, slivers and
/// grazing ones included.
double GaussError(double separation, int points)
{
  const double each = separation > 1.0 ? 1.0 / (separation * separation) : 1.0;
  double error = 0.1;
  for (int n = 1; n < points; ++n)
  {
    error *= each;
  }
  return error;
}

/// Fewest points a side whose error meets the target; MostPoints + 1 when none of the rules does.
int PointsFor(double separation, double target)
{
  int points = 1;
  while (points <= MostPoints && GaussError(separation, points) > target)
  {
    ++points;
  }
  return points;
}

/// The throughput as it is defined. The distance of x from the plane of b depends on x alone, and
/// that of y from the plane of a on y alone, so both cosines go into the weights, all terms are
/// positive, and nothing cancels.
double AreaQuadrature(const FacingPair& pair, int pointsA, int pointsB)
{
  SurfaceNodes nodesA = NodesOn(pair.a, pointsA);
  SurfaceNodes nodesB = NodesOn(pair.b, pointsB);
  for (int i = 0; i < nodesA.count; ++i)
  {
    nodesA.weights[i] *= std::max(glm::dot(pair.normalB, nodesA.Point(i) - pair.b[0]), 0.0);
  }
  std::array<double, SurfaceNodes::Capacity> received;
  for (int j = 0; j < nodesB.count; ++j)
  {
    nodesB.weights[j] *= std::max(glm::dot(pair.normalA, nodesB.Point(j) - pair.a[0]), 0.0);
    received[j] = 0.0;
  }
  for (int i = 0; i < nodesA.count; ++i)
  {
    // One sum for each j instead of one for all keeps the loop free of dependences: it vectorises.
    for (int j = 0; j < nodesB.count; ++j)
    {
      const double dx = nodesA.x[i] - nodesB.x[j];
      const double dy = nodesA.y[i] - nodesB.y[j];
      const double dz = nodesA.z[i] - nodesB.z[j];
      const double r2 = dx * dx + dy * dy + dz * dz;
      received[j] += nodesA.weights[i] / (r2 * r2);
    }
  }
  double sum = 0.0;
  for (int j = 0; j < nodesB.count; ++j)
  {
    sum += nodesB.weights[j] * received[j];
  }
  return sum;
}

/// The size of the throughput from the centres alone, as between two discs.
double RoughSize(const FacingPair& pair)
{
  const Vec3 d = pair.centreB - pair.centreA;
  const double r2 = glm::dot(d, d);
  const double heights = std::abs(glm::dot(pair.normalA, d) * glm::dot(pair.normalB, d));
  return heights * pair.areaA * pair.areaB / (r2 * (r2 + (pair.areaA + pair.areaB) / Pi));
}

/// Gauss points on a that see all of b in closed form (Baum et al. 1989 have it the other way
/// around: b seen from one point).
double PointQuadrature(const FacingPair& pair, int points)
{
  const SurfaceNodes nodes = NodesOn(pair.a, points);
  double sum = 0.0;
  for (int k = 0; k < nodes.count; ++k)
  {
    sum += nodes.weights[k] * PointToPolygon(nodes.Point(k), pair.normalA, pair.b);
  }
  return sum;
}

double DistanceToContour(const Vec3& x, const Polygon& p)
{
  double least = std::numeric_limits<double>::infinity();
  for (int i = 0; i < p.Size(); ++i)
  {
    const Vec3 along = p[(i + 1) % p.Size()] - p[i];
    const double length2 = glm::dot(along, along);
    const double t =
      length2 > 0.0 ? std::clamp(glm::dot(x - p[i], along) / length2, 0.0, 1.0) : 0.0;
    const Vec3 d = p[i] + t * along - x;
    least = std::min(least, glm::dot(d, d));
  }
  return std::sqrt(least);
}

double FacingThroughput(const FacingPair& pair, const Targets& targets);

/// Polygon b in parts, until they are about as large as a or far from it.
double SumOverParts(const FacingPair& pair, const Targets& targets)
{
  double sum = 0.0;
  for (const Polygon& half :
    pair.b.Size() < Polygon::Capacity ? AcrossTheMiddle(pair.b) : InHalves(pair.b))
  {
    FacingPair part = pair;
    part.b = half;
    sum += !half.Empty() && Measure(part) ? FacingThroughput(part, targets) : 0.0;
  }
  return sum;
}

double ContourThroughput(const FacingPair& pair, const Targets& targets, double separation)
{
  // Around the contours terms of the size of the larger polygon cancel.
  constexpr double rounding = 4e-16;
  const double noise = rounding * pair.radiusB * pair.radiusB;
  const double rough = RoughSize(pair);
  if (noise > targets.quadrature * rough && pair.radiusB > 4.0 * pair.radiusA)
  {
    return SumOverParts(pair, targets);
  }
  double contour = ContourIntegral(pair.a, pair.b, std::max(targets.contour * rough, noise));
  if (contour < 0.1 * rough)
  {
    const double size = std::max(contour, 0.0);
    contour = ContourIntegral(pair.a, pair.b, std::max(targets.contour * size, noise));
  }
  // Between grazing slivers only rounding is left.
  const bool areaIsBetter = GaussError(separation, MostPoints) * contour < noise;
  return areaIsBetter ? AreaQuadrature(pair, MostPoints, MostPoints) : contour;
}

/// The ladder, from the cheapest that is good enough to the one that is always good.
double FacingThroughput(const FacingPair& pair, const Targets& targets)
{
  const double distance = glm::distance(pair.centreA, pair.centreB);
  const double separationA = (distance - pair.radiusB) / pair.radiusA;
  const double separationB = (distance - pair.radiusA) / pair.radiusB;
  const int pointsA = PointsFor(separationA, targets.quadrature);
  const int pointsB = PointsFor(separationB, targets.quadrature);
  if (pointsA <= MostPoints && pointsB <= MostPoints)
  {
    return AreaQuadrature(pair, pointsA, pointsB);
  }
  const double separationContour = DistanceToContour(pair.centreA, pair.b) / pair.radiusA;
  const int pointsSeeing = PointsFor(separationContour, targets.quadrature);
  if (pointsSeeing <= targets.surfacePoints)
  {
    return PointQuadrature(pair, pointsSeeing);
  }
  return ContourThroughput(pair, targets, std::min(separationA, separationB));
}

} // namespace

double Throughput(const Polygon& a, const Polygon& b, Accuracy accuracy)
{
  const std::optional<FacingPair> pair = Face(a, b);
  if (!pair)
  {
    return 0.0;
  }
  const double most = Pi * std::min(pair->areaA, pair->areaB);
  return std::min(FacingThroughput(*pair, TargetsOf(accuracy)), most) * pair->unit * pair->unit;
}

} // namespace vantage
