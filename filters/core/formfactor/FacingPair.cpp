#include "core/formfactor/FacingPair.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace vantage
{
namespace
{

// Rounding moves vertices by a few units in the last place: of their coordinates before they come
// here, and of the extent of their polygon after.
constexpr double LastPlace = std::numeric_limits<double>::epsilon();
constexpr double MovedInput = 2.0 * LastPlace;
constexpr double MovedHere = 8.0 * LastPlace;

// A polygon is degenerate when its area is below this part of its squared extent.
constexpr double NoArea = 1e-15;

/// Largest coordinate of the polygon, seen from the origin given.
double LargestCoordinate(const Polygon& p, const Vec3& origin)
{
  double largest = 0.0;
  for (const Vec3& vertex : p)
  {
    const Vec3 v = vertex - origin;
    largest = std::max({ largest, std::abs(v.x), std::abs(v.y), std::abs(v.z) });
  }
  return largest;
}

Polygon Moved(const Polygon& p, const Vec3& origin, double scale)
{
  Polygon moved;
  for (const Vec3& v : p)
  {
    moved.Add((v - origin) * scale);
  }
  return moved;
}

//// How far from its true place the plane of p may be over the extent of the pair, which is 1, when
/// the vertices are off by `moved`. Points nearer than that lie on the plane: the two sides of a
/// wall must not see each other. More for slivers, whose planes turn more easily.
double PlaneTolerance(const Polygon& p, double moved)
{
  const double extent = LargestCoordinate(p, p[0]);
  const double width = Area(p) / extent;
  return (moved + MovedHere * extent) * std::max(1.0, 1.0 / width) + MovedHere;
}

/// An order of polygons that looks at their geometry only: the smaller one first.
bool Before(const Polygon& a, const Polygon& b)
{
  const double extentA = LargestCoordinate(a, a[0]);
  const double extentB = LargestCoordinate(b, b[0]);
  if (extentA != extentB)
  {
    return extentA < extentB;
  }
  if (a.Size() != b.Size())
  {
    return a.Size() < b.Size();
  }
  for (int i = 0; i < a.Size(); ++i)
  {
    for (int axis = 0; axis < 3; ++axis)
    {
      if (a[i][axis] != b[i][axis])
      {
        return a[i][axis] < b[i][axis];
      }
    }
  }
  return false;
}

/// Area, centroid and the radius around it of a polygon whose normal is known.
void MeasureOne(const Polygon& p, const Vec3& normal, double& area, Vec3& centre, double& radius)
{
  double twiceArea = 0.0;
  Vec3 moment(0.0);
  for (int i = 2; i < p.Size(); ++i)
  {
    const Vec3 e = p[i - 1] - p[0];
    const Vec3 f = p[i] - p[0];
    const double part = glm::dot(glm::cross(e, f), normal);
    twiceArea += part;
    moment += part * (e + f);
  }
  area = 0.5 * twiceArea;
  centre = twiceArea > 0.0 ? p[0] + moment / (3.0 * twiceArea) : p[0];
  radius = RadiusAround(p, centre);
}

void Swap(FacingPair& pair)
{
  std::swap(pair.a, pair.b);
  std::swap(pair.normalA, pair.normalB);
  std::swap(pair.areaA, pair.areaB);
  std::swap(pair.centreA, pair.centreB);
  std::swap(pair.radiusA, pair.radiusB);
}

} // namespace

bool Measure(FacingPair& pair)
{
  MeasureOne(pair.a, pair.normalA, pair.areaA, pair.centreA, pair.radiusA);
  MeasureOne(pair.b, pair.normalB, pair.areaB, pair.centreB, pair.radiusB);
  return pair.areaA > NoArea * pair.radiusA * pair.radiusA &&
         pair.areaB > NoArea * pair.radiusB * pair.radiusB;
}

std::optional<FacingPair> Face(const Polygon& first, const Polygon& second)
{
  if (first.Empty() || second.Empty())
  {
    return std::nullopt;
  }
  const bool inOrder = !Before(second, first);
  const Polygon& one = inOrder ? first : second;
  const Polygon& two = inOrder ? second : first;

  // On the smaller one, so that it keeps all its digits.
  const Vec3 origin = one[0];
  const Vec3 zero(0.0);
  const double extent = std::max(LargestCoordinate(one, origin), LargestCoordinate(two, origin));
  if (!(extent > 0.0) || !std::isfinite(extent))
  {
    return std::nullopt;
  }
  // A power of two, so that scaling rounds nothing.
  const double unit = std::ldexp(1.0, std::ilogb(extent));

  FacingPair pair;
  pair.origin = origin;
  pair.unit = unit;
  pair.a = Moved(one, origin, 1.0 / unit);
  pair.b = Moved(two, origin, 1.0 / unit);
  const Plane planeA = SupportingPlane(pair.a);
  const Plane planeB = SupportingPlane(pair.b);
  if (planeA.normal == zero || planeB.normal == zero)
  {
    return std::nullopt;
  }
  pair.normalA = planeA.normal;
  pair.normalB = planeB.normal;
  const double moved =
    MovedInput * std::max(LargestCoordinate(one, zero), LargestCoordinate(two, zero)) / unit;
  const double toleranceA = PlaneTolerance(pair.a, moved);
  const double toleranceB = PlaneTolerance(pair.b, moved);
  pair.a = ClipToFront(pair.a, planeB, toleranceB);
  pair.b = ClipToFront(pair.b, planeA, toleranceA);
  if (pair.a.Empty() || pair.b.Empty() || !Measure(pair))
  {
    return std::nullopt;
  }
  if (pair.radiusB < pair.radiusA)
  {
    Swap(pair);
  }
  return pair;
}

} // namespace vantage
