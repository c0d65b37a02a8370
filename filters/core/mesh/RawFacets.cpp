#include "core/mesh/RawFacets.h"

#include "core/math/Sampling.h"
#include "core/mesh/Triangulate.h"

#include <algorithm>

namespace vantage
{

namespace
{

/// Departure from a plane, relative to the polygon's size, that still counts as flat.
constexpr double FlatTolerance = 1e-5;

/// Departure from a straight line, relative to the polygon's size, that still counts as straight.
/// Narrower than the above: what lies within is lost, and thin strips should not be.
constexpr double StraightTolerance = 1e-6;

double DistanceFromLine(const Vec3& x, const Vec3& a, const Vec3& b)
{
  return glm::length(glm::cross(x - a, b - a)) / glm::length(b - a);
}

double SizeOf(const Loop& loop, const std::vector<Vec3>& points)
{
  Vec3 low = points[loop.front()];
  Vec3 high = low;
  for (const std::uint32_t i : loop)
  {
    low = glm::min(low, points[i]);
    high = glm::max(high, points[i]);
  }
  return glm::length(high - low);
}

Vec3 AreaNormal(const Loop& loop, const std::vector<Vec3>& points)
{
  const Vec3& origin = points[loop.front()];
  Vec3 sum(0.0);
  for (std::size_t i = 2; i < loop.size(); ++i)
  {
    sum += glm::cross(points[loop[i - 1]] - origin, points[loop[i]] - origin);
  }
  return 0.5 * sum;
}

/// Removes repeated corners and corners on the line between their neighbours, T-vertices and
/// spikes among them. Leaves fewer than three corners of a polygon without area.
void RemoveRedundantCorners(Loop& loop, const std::vector<Vec3>& points, double weldDistance)
{
  const double tolerance = std::max(weldDistance, StraightTolerance * SizeOf(loop, points));
  std::size_t i = 0;
  std::size_t inARow = 0;
  while (loop.size() >= 3 && inARow < loop.size())
  {
    const std::size_t n = loop.size();
    i %= n;
    const std::uint32_t before = loop[(i + n - 1) % n];
    const std::uint32_t after = loop[(i + 1) % n];
    const bool isRedundant =
      loop[i] == before || before == after ||
      DistanceFromLine(points[loop[i]], points[before], points[after]) <= tolerance;
    if (isRedundant)
    {
      loop.erase(loop.begin() + static_cast<std::ptrdiff_t>(i));
      i = (i + loop.size() - 1) % loop.size();
      inARow = 0;
    }
    else
    {
      ++i;
      ++inARow;
    }
  }
}

bool IsPlanar(
  const Loop& loop, const std::vector<Vec3>& points, const Vec3& normal, double tolerance)
{
  double low = 0.0;
  double high = 0.0;
  for (const std::uint32_t i : loop)
  {
    const double height = glm::dot(points[i] - points[loop.front()], normal);
    low = std::min(low, height);
    high = std::max(high, height);
  }
  return high - low <= 2.0 * tolerance;
}

/// Whether all corners turn left. That is convex for up to four corners; a star of more has to be
/// triangulated anyway.
bool IsConvex(const Loop& loop, const std::vector<Vec3>& points, const Vec3& normal)
{
  const std::size_t n = loop.size();
  for (std::size_t i = 0; i < n; ++i)
  {
    const Vec3& before = points[loop[(i + n - 1) % n]];
    const Vec3& here = points[loop[i]];
    const Vec3& after = points[loop[(i + 1) % n]];
    if (!(glm::dot(glm::cross(here - before, after - here), normal) > 0.0))
    {
      return false;
    }
  }
  return true;
}

/// A ring of corners from its smallest corner on, in the direction that is smaller.
struct Canonical
{
  std::size_t start;
  bool isReversed; ///< against the loop's own direction

  std::size_t Place(std::size_t i, std::size_t count) const
  {
    return (this->isReversed ? this->start + count - i : this->start + i) % count;
  }
};

Canonical CanonicalOf(const Loop& loop)
{
  const std::size_t n = loop.size();
  const std::uint32_t smallest = *std::min_element(loop.begin(), loop.end());
  const auto isBefore = [&](const Canonical& a, const Canonical& b)
  {
    for (std::size_t i = 1; i < n; ++i)
    {
      const std::uint32_t cornerOfA = loop[a.Place(i, n)];
      const std::uint32_t cornerOfB = loop[b.Place(i, n)];
      if (cornerOfA != cornerOfB)
      {
        return cornerOfA < cornerOfB;
      }
    }
    return false;
  };
  Canonical best{ n, false };
  for (std::size_t i = 0; i < n; ++i)
  {
    for (const Canonical& ring : { Canonical{ i, false }, Canonical{ n - 1 - i, true } })
    {
      if (loop[ring.start] == smallest && (best.start == n || isBefore(ring, best)))
      {
        best = ring;
      }
    }
  }
  return best;
}

Loop InOrder(const Loop& loop, const Canonical& order)
{
  Loop ring;
  for (std::size_t i = 0; i < loop.size(); ++i)
  {
    ring.push_back(loop[order.Place(i, loop.size())]);
  }
  return ring;
}

/// Triangles of a loop. They do not depend on where the loop starts or on its direction, so that
/// polygons back to back fall into triangles back to back.
std::vector<Loop> TriangulateLoop(const Loop& loop, const std::vector<Vec3>& points)
{
  const Canonical order = CanonicalOf(loop);
  const Loop ring = InOrder(loop, order);
  const Frame frame(glm::normalize(AreaNormal(ring, points)));
  std::vector<Vec2> corners;
  for (const std::uint32_t i : ring)
  {
    const Vec3 offset = points[i] - points[ring.front()];
    corners.emplace_back(glm::dot(offset, frame.x), glm::dot(offset, frame.y));
  }
  std::vector<Loop> triangles;
  for (const auto& [a, b, c] : Triangulate(corners))
  {
    triangles.push_back(
      order.isReversed ? Loop{ ring[c], ring[b], ring[a] } : Loop{ ring[a], ring[b], ring[c] });
  }
  return triangles;
}

} // namespace

FacetBuilder::FacetBuilder(const std::vector<Vec3>& points, double weldDistance)
  : Points(points)
  , WeldDistance(weldDistance)
{
}

void FacetBuilder::Add(const std::uint32_t* first, const std::uint32_t* last, std::uint32_t polygon,
  std::uint32_t material)
{
  Loop& loop = this->Corners;
  loop.assign(first, last);
  RemoveRedundantCorners(loop, this->Points, this->WeldDistance);
  const double size = SizeOf(loop, this->Points);
  Vec3 normal = loop.size() < 3 ? Vec3(0.0) : AreaNormal(loop, this->Points);
  const double area = glm::length(normal);
  if (area <= std::max(this->WeldDistance, StraightTolerance * size) * size)
  {
    ++this->report.degeneratePolygons;
    return;
  }
  normal /= area;
  const bool isPlanar =
    IsPlanar(loop, this->Points, normal, std::max(this->WeldDistance, FlatTolerance * size));
  const bool isConvex = IsConvex(loop, this->Points, normal);
  if (loop.size() <= 4 && isPlanar && isConvex)
  {
    this->Emit(loop, polygon, material);
    return;
  }
  ++(!isPlanar   ? this->report.nonPlanarPolygons
     : !isConvex ? this->report.concavePolygons
                 : this->report.largePolygons);
  for (Loop triangle : TriangulateLoop(loop, this->Points))
  {
    RemoveRedundantCorners(triangle, this->Points, this->WeldDistance);
    if (triangle.size() == 3)
    {
      this->Emit(triangle, polygon, material);
    }
  }
}

void FacetBuilder::Emit(const Loop& loop, std::uint32_t polygon, std::uint32_t material)
{
  RawFacet facet;
  facet.polygon = polygon;
  facet.material = material;
  const Canonical order = CanonicalOf(loop);
  facet.isReversed = order.isReversed;
  for (std::size_t i = 0; i < loop.size(); ++i)
  {
    facet.corners[i] = loop[i];
    facet.key[i] = loop[order.Place(i, loop.size())];
  }
  this->facets.push_back(facet);
}

} // namespace vantage
