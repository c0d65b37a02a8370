#include "core/formfactor/ContourIntegral.h"

#include "core/formfactor/EdgePair.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace vantage
{
namespace
{

// Edges at right angles add nothing; below this cosine what they add is rounding.
constexpr double RightAngle = 1e-15;

struct Contour
{
  std::array<Edge, Polygon::Capacity> edges;
  int count = 0;

  explicit Contour(const Polygon& p)
  {
    for (int i = 0; i < p.Size(); ++i)
    {
      const Vec3 along = p[(i + 1) % p.Size()] - p[i];
      const double length = glm::length(along);
      if (length > 0.0)
      {
        this->edges[this->count++] = { p[i], along / length, length };
      }
    }
  }
};

/// ln |x - y|^2 for the starts of all edges x of one contour and y of another: each serves in four
/// pairs of edges.
using LogTable = std::array<std::array<double, Polygon::Capacity>, Polygon::Capacity>;

void FillLogs(LogTable& logs, const Contour& a, const Contour& b)
{
  for (int i = 0; i < a.count; ++i)
  {
    for (int j = 0; j < b.count; ++j)
    {
      const Vec3 d = a.edges[i].start - b.edges[j].start;
      const double squared = glm::dot(d, d);
      // Where vertices touch, the logarithm is multiplied by a distance that is zero.
      logs[i][j] = squared > 0.0 ? std::log(squared) : 0.0;
    }
  }
}

} // namespace

double ContourIntegral(const Polygon& a, const Polygon& b, double tolerance)
{
  const Contour contourA(a);
  const Contour contourB(b);
  LogTable logs;
  FillLogs(logs, contourA, contourB);
  const double pairTolerance = tolerance * 4.0 / (contourA.count * contourB.count);
  double sum = 0.0;
  for (int i = 0; i < contourA.count; ++i)
  {
    const int nextI = i + 1 < contourA.count ? i + 1 : 0;
    for (int j = 0; j < contourB.count; ++j)
    {
      const int nextJ = j + 1 < contourB.count ? j + 1 : 0;
      const Edge& e = contourA.edges[i];
      const Edge& f = contourB.edges[j];
      const double cosine = glm::dot(e.direction, f.direction);
      if (std::abs(cosine) > RightAngle)
      {
        const EndLogs ends{ { { logs[i][j], logs[i][nextJ] },
          { logs[nextI][j], logs[nextI][nextJ] } } };
        sum += cosine * LogIntegral(e, f, ends, pairTolerance);
      }
    }
  }
  return 0.25 * sum;
}

} // namespace vantage
