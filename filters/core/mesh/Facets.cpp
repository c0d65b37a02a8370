#include "core/mesh/Facets.h"

#include "core/Error.h"
#include "core/math/Sampling.h"
#include "core/mesh/Triangulate.h"
#include "core/mesh/Weld.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>
#include <sstream>
#include <tuple>

namespace vantage
{

namespace
{

/// Diagonals between which the fourth power of a length neither vanishes nor overflows, with room
/// for what is smaller than the scene.
constexpr double SmallestScene = 1e-70;
constexpr double LargestScene = 1e75;

/// Indices of welded points; these are ranks by geometry, so comparing them compares geometry.
using Loop = std::vector<std::uint32_t>;

/// Departure from a plane, relative to the polygon's size, that still counts as flat.
constexpr double FlatTolerance = 1e-5;

/// Departure from a straight line, relative to the polygon's size, that still counts as straight.
/// Narrower than the above: what lies within is lost, and thin strips should not be.
constexpr double StraightTolerance = 1e-6;

/// A triangle or quadrilateral before the final order is known.
struct RawFacet
{
  std::array<std::uint32_t, 4> corners{ None, None, None, None };
  int count = 0;
  std::uint32_t polygon = None;
  std::uint32_t material = None;

  std::array<std::uint32_t, 4> key{}; ///< the corners from the smallest on, the smaller way round
  bool isReversed = false;            ///< that is against the order of `corners`
};

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

/// The same ring of corners from its smallest corner on, in the direction that is smaller; tells
/// whether that direction is against the loop's own.
std::pair<Loop, bool> Canonical(const Loop& loop)
{
  std::pair<Loop, bool> best;
  Loop forward = loop;
  Loop backward(loop.rbegin(), loop.rend());
  const std::uint32_t smallest = *std::min_element(loop.begin(), loop.end());
  for (std::size_t i = 0; i < loop.size(); ++i)
  {
    if (forward.front() == smallest && (best.first.empty() || forward < best.first))
    {
      best = { forward, false };
    }
    if (backward.front() == smallest && (best.first.empty() || backward < best.first))
    {
      best = { backward, true };
    }
    std::rotate(forward.begin(), forward.begin() + 1, forward.end());
    std::rotate(backward.begin(), backward.begin() + 1, backward.end());
  }
  return best;
}

/// Triangles of a loop. They do not depend on where the loop starts or on its direction, so that
/// polygons back to back fall into triangles back to back.
std::vector<Loop> TriangulateLoop(const Loop& loop, const std::vector<Vec3>& points)
{
  const auto [ring, isReversed] = Canonical(loop);
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
      isReversed ? Loop{ ring[c], ring[b], ring[a] } : Loop{ ring[a], ring[b], ring[c] });
  }
  return triangles;
}

/// Takes the polygons of a scene apart.
class FacetBuilder
{
public:
  FacetBuilder(const std::vector<Vec3>& points, double weldDistance)
    : Points(points)
    , WeldDistance(weldDistance)
  {
  }

  void Add(Loop loop, std::uint32_t polygon, std::uint32_t material)
  {
    RemoveRedundantCorners(loop, this->Points, this->WeldDistance);
    const double size = SizeOf(loop, this->Points);
    Vec3 normal = loop.size() < 3 ? Vec3(0.0) : AreaNormal(loop, this->Points);
    const double area = glm::length(normal);
    if (area <= std::max(this->WeldDistance, StraightTolerance * size) * size)
    {
      ++this->Report.degeneratePolygons;
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
    ++(!isPlanar   ? this->Report.nonPlanarPolygons
       : !isConvex ? this->Report.concavePolygons
                   : this->Report.largePolygons);
    for (Loop triangle : TriangulateLoop(loop, this->Points))
    {
      RemoveRedundantCorners(triangle, this->Points, this->WeldDistance);
      if (triangle.size() == 3)
      {
        this->Emit(triangle, polygon, material);
      }
    }
  }

  std::vector<RawFacet> Facets;
  FacetReport Report;

private:
  void Emit(const Loop& loop, std::uint32_t polygon, std::uint32_t material)
  {
    RawFacet facet;
    facet.count = static_cast<int>(loop.size());
    facet.polygon = polygon;
    facet.material = material;
    std::copy(loop.begin(), loop.end(), facet.corners.begin());
    const auto [ring, isReversed] = Canonical(loop);
    facet.key.fill(None);
    std::copy(ring.begin(), ring.end(), facet.key.begin());
    facet.isReversed = isReversed;
    this->Facets.push_back(facet);
  }

  const std::vector<Vec3>& Points;
  double WeldDistance;
};

Facet MakeFacet(const RawFacet& raw, const std::vector<Vec3>& points)
{
  Facet facet;
  for (int i = 0; i < raw.count; ++i)
  {
    facet.shape.Add(points[raw.corners[i]]);
  }
  facet.scenePolygon = raw.polygon;
  facet.material = raw.material;
  return facet;
}

/// One facet for each place: drops repetitions and makes one of two that lie back to back.
std::vector<Facet> ResolveCoincident(
  std::vector<RawFacet> raw, const std::vector<Vec3>& points, FacetReport& report)
{
  std::sort(raw.begin(), raw.end(),
    [](const RawFacet& a, const RawFacet& b)
    {
      return std::tie(a.key, a.isReversed, a.material, a.corners, a.polygon) <
             std::tie(b.key, b.isReversed, b.material, b.corners, b.polygon);
    });
  std::vector<Facet> facets;
  facets.reserve(raw.size());
  for (std::size_t i = 0; i < raw.size(); ++i)
  {
    if (i == 0 || raw[i].key != raw[i - 1].key)
    {
      facets.push_back(MakeFacet(raw[i], points));
    }
    else if (raw[i].isReversed != raw[i - 1].isReversed)
    {
      facets.back().backPolygon = raw[i].polygon;
      facets.back().backMaterial = raw[i].material;
      ++report.mergedFacets;
    }
    else
    {
      ++report.duplicateFacets;
    }
  }
  return facets;
}

/// A frame that moves with the scene: axes along moments of its area, so that coordinates in it do
/// not depend on how the scene is placed. A scene whose moments vanish by symmetry gets some frame.
struct MovingFrame
{
  Vec3 origin{ 0.0 };
  std::array<Vec3, 3> axes;

  MovingFrame(const std::vector<Facet>& facets, const std::vector<Vec3>& centroids)
  {
    const auto sum = [&](auto&& term)
    {
      Vec3 total(0.0);
      for (std::size_t f = 0; f < facets.size(); ++f)
      {
        total += Area(facets[f].shape) * term(centroids[f] - this->origin);
      }
      return total;
    };
    double area = 0.0;
    for (const Facet& facet : facets)
    {
      area += Area(facet.shape);
    }
    this->origin = centroids.front();
    this->origin += sum([](const Vec3& r) { return r; }) / area;
    const Vec3 skew = sum([](const Vec3& r) { return glm::dot(r, r) * r; });
    this->axes[0] = Direction(skew, Vec3(1.0, 0.0, 0.0));
    const Vec3 spread = sum([this](const Vec3& r) { return glm::dot(r, this->axes[0]) * r; });
    const Frame any(this->axes[0]);
    this->axes[1] = Direction(spread - glm::dot(spread, this->axes[0]) * this->axes[0], any.x);
    this->axes[2] = glm::cross(this->axes[0], this->axes[1]);
  }

  Vec3 Coordinates(const Vec3& x) const
  {
    const Vec3 r = x - this->origin;
    return { glm::dot(r, this->axes[0]), glm::dot(r, this->axes[1]), glm::dot(r, this->axes[2]) };
  }

private:
  static Vec3 Direction(const Vec3& v, const Vec3& otherwise)
  {
    const double length = glm::length(v);
    return length > 0.0 ? v / length : otherwise;
  }
};

/// Sorts by centroid, in a frame of the scene's own: a moved or turned scene has its facets, and
/// all that is made of them, in the same order. Facets in different places with the same centroid
/// stay in the order they have, which is one of geometry, too.
std::vector<Facet> SortByPlace(const std::vector<Facet>& facets)
{
  std::vector<Vec3> centroids;
  centroids.reserve(facets.size());
  for (const Facet& facet : facets)
  {
    centroids.push_back(Centroid(facet.shape));
  }
  const MovingFrame frame(facets, centroids);
  for (Vec3& centroid : centroids)
  {
    centroid = frame.Coordinates(centroid);
  }
  std::vector<std::uint32_t> order(facets.size());
  std::iota(order.begin(), order.end(), 0u);
  std::sort(order.begin(), order.end(),
    [&](std::uint32_t i, std::uint32_t j)
    {
      const Vec3& a = centroids[i];
      const Vec3& b = centroids[j];
      return std::tie(a.x, a.y, a.z, i) < std::tie(b.x, b.y, b.z, j);
    });
  std::vector<Facet> sorted;
  sorted.reserve(facets.size());
  for (const std::uint32_t i : order)
  {
    sorted.push_back(facets[i]);
  }
  return sorted;
}

/// Where each corner of each polygon is, from offsets[0] on. Adding zero turns -0 into 0, so that
/// equal numbers are equal to the bit.
std::vector<Vec3> CornerPositions(const Scene& scene)
{
  std::vector<Vec3> positions;
  positions.reserve(scene.offsets.back() - scene.offsets.front());
  for (std::uint32_t i = scene.offsets.front(); i < scene.offsets.back(); ++i)
  {
    positions.push_back(scene.vertices[scene.indices[i]] + Vec3(0.0));
  }
  return positions;
}

} // namespace

FacetShapes::FacetShapes(const std::vector<Facet>& facets)
{
  std::size_t corners = 0;
  for (const Facet& facet : facets)
  {
    corners += facet.shape.Size();
  }
  this->Corners.reserve(corners);
  this->Starts.reserve(facets.size() + 1);
  for (const Facet& facet : facets)
  {
    this->Starts.push_back(static_cast<std::uint32_t>(this->Corners.size()));
    this->Corners.insert(this->Corners.end(), facet.shape.begin(), facet.shape.end());
  }
  this->Starts.push_back(static_cast<std::uint32_t>(this->Corners.size()));
}

double FacetSet::Tolerance() const
{
  constexpr double OfDiagonal = 1e-9;
  const Vec3 furthest = glm::max(glm::abs(this->low), glm::abs(this->high));
  const double rounding = 16.0 * std::numeric_limits<double>::epsilon() * MaxChannel(furthest);
  return OfDiagonal * glm::length(this->high - this->low) + rounding;
}

FacetSet BuildFacets(const Scene& scene, double weldTolerance)
{
  scene.Validate();
  if (!(weldTolerance >= 0.0 && weldTolerance <= 0.1))
  {
    throw InputError("weld tolerance is " + std::to_string(weldTolerance) +
                     " of the scene's diagonal; give one between 0 and 0.1");
  }
  const std::vector<Vec3> positions = CornerPositions(scene);
  FacetSet result;
  result.low = result.high = positions.front();
  for (const Vec3& p : positions)
  {
    result.low = glm::min(result.low, p);
    result.high = glm::max(result.high, p);
  }
  const double diagonal = glm::length(result.high - result.low);
  if (diagonal > 0.0 && !(diagonal >= SmallestScene && diagonal <= LargestScene))
  {
    std::ostringstream size;
    size << diagonal;
    throw InputError("scene: it is " + size.str() +
                     " across, and squares of areas cannot be told from zero or infinity; choose "
                     "another unit of length");
  }
  const double weldDistance = weldTolerance * diagonal;
  const WeldedPoints welded = Weld(positions, weldDistance);

  FacetBuilder builder(welded.points, weldDistance);
  for (std::uint32_t p = 0; p < scene.PolygonCount(); ++p)
  {
    const auto corners = welded.indices.begin() - scene.offsets.front();
    builder.Add(Loop(corners + scene.offsets[p], corners + scene.offsets[p + 1]), p,
      scene.materialOfPolygon[p]);
  }
  if (builder.Facets.empty())
  {
    throw InputError("scene: none of its polygons has an area; add one that has, or lower the weld "
                     "tolerance");
  }
  result.report = builder.Report;
  result.report.weldedVertices = welded.moved;
  result.facets =
    SortByPlace(ResolveCoincident(std::move(builder.Facets), welded.points, result.report));
  for (const Facet& facet : result.facets)
  {
    result.meanArea += Area(facet.shape);
  }
  result.meanArea /= static_cast<double>(result.facets.size());
  return result;
}

} // namespace vantage
