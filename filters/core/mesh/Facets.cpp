#include "core/mesh/Facets.h"

#include "core/Error.h"
#include "core/math/Sampling.h"
#include "core/mesh/PackedLists.h"
#include "core/mesh/RawFacets.h"
#include "core/mesh/Weld.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
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

TriangleOrQuadrilateral ShapeOf(const RawFacet& raw, const std::vector<Vec3>& points)
{
  TriangleOrQuadrilateral shape;
  for (const std::uint32_t corner : raw.corners)
  {
    if (corner != None)
    {
      shape.Add(points[corner]);
    }
  }
  return shape;
}

/// By key, and what else tells facets apart.
std::vector<RawFacet> SortByKey(const std::vector<RawFacet>& raw, std::size_t pointCount)
{
  return BucketSorted<RawFacet>(
    pointCount, [&](const auto& visit) { std::for_each(raw.begin(), raw.end(), visit); },
    [](const RawFacet& facet) { return facet.key[0]; },
    [](const RawFacet& a, const RawFacet& b)
    {
      return std::tie(a.key, a.isReversed, a.material, a.corners, a.polygon) <
             std::tie(b.key, b.isReversed, b.material, b.corners, b.polygon);
    });
}

/// One facet for each place: drops repetitions and makes one of two that lie back to back.
/// \pre sorted by key
void ResolveCoincident(std::vector<RawFacet>& facets, FacetReport& report)
{
  std::size_t count = 0;
  bool isLastReversed = false; ///< of the facet before, dropped or not
  for (const RawFacet& facet : facets)
  {
    RawFacet* const place = count > 0 ? &facets[count - 1] : nullptr;
    const bool isReversed = facet.isReversed;
    if (!place || place->key != facet.key)
    {
      facets[count++] = facet;
    }
    else if (isReversed != isLastReversed)
    {
      place->backPolygon = facet.polygon;
      place->backMaterial = facet.material;
      ++report.mergedFacets;
    }
    else
    {
      ++report.duplicateFacets;
    }
    isLastReversed = isReversed;
  }
  facets.resize(count);
}

/// A frame that moves with the scene: axes along moments of its area, so that coordinates in it do
/// not depend on how the scene is placed. A scene whose moments vanish by symmetry gets some frame.
struct MovingFrame
{
  Vec3 origin;
  std::array<Vec3, 3> axes;

  MovingFrame(const std::vector<double>& areas, const std::vector<Vec3>& centroids)
    : origin(centroids.front())
  {
    double area = 0.0;
    for (const double one : areas)
    {
      area += one;
    }
    const auto sum = [&](auto&& term)
    {
      Vec3 total(0.0);
      for (std::size_t f = 0; f < areas.size(); ++f)
      {
        total += areas[f] * term(centroids[f] - this->origin);
      }
      return total;
    };
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

/// The facets sorted by centroid, in a frame of the scene's own: a moved or turned scene has its
/// facets, and all that is made of them, in the same order. Facets in different places with the
/// same centroid stay in the order they have, which is one of geometry, too.
std::vector<Facet> InOrderOfPlace(const std::vector<RawFacet>& raw, const std::vector<Vec3>& points)
{
  std::vector<double> areas;
  std::vector<Vec3> centroids;
  areas.reserve(raw.size());
  centroids.reserve(raw.size());
  for (const RawFacet& facet : raw)
  {
    const TriangleOrQuadrilateral shape = ShapeOf(facet, points);
    areas.push_back(Area(shape));
    centroids.push_back(Centroid(shape));
  }
  const MovingFrame frame(areas, centroids);
  struct Entry
  {
    Vec3 place;
    std::uint32_t facet;
  };
  std::vector<Entry> order;
  order.reserve(raw.size());
  for (const Vec3& centroid : centroids)
  {
    order.push_back({ frame.Coordinates(centroid), static_cast<std::uint32_t>(order.size()) });
  }
  std::sort(order.begin(), order.end(),
    [](const Entry& a, const Entry& b)
    {
      return std::tie(a.place.x, a.place.y, a.place.z, a.facet) <
             std::tie(b.place.x, b.place.y, b.place.z, b.facet);
    });
  std::vector<Facet> facets;
  facets.reserve(raw.size());
  for (const Entry& entry : order)
  {
    const RawFacet& facet = raw[entry.facet];
    facets.push_back({ ShapeOf(facet, points), facet.polygon, facet.material, facet.backPolygon,
      facet.backMaterial });
  }
  return facets;
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
  builder.facets.reserve(scene.PolygonCount());
  for (std::uint32_t p = 0; p < scene.PolygonCount(); ++p)
  {
    const std::uint32_t* const corners = welded.indices.data();
    builder.Add(corners + (scene.offsets[p] - scene.offsets.front()),
      corners + (scene.offsets[p + 1] - scene.offsets.front()), p, scene.materialOfPolygon[p]);
  }
  if (builder.facets.empty())
  {
    throw InputError("scene: none of its polygons has an area; add one that has, or lower the weld "
                     "tolerance");
  }
  result.report = builder.report;
  result.report.weldedVertices = welded.moved;
  std::vector<RawFacet> raw = SortByKey(builder.facets, welded.points.size());
  ResolveCoincident(raw, result.report);
  result.facets = InOrderOfPlace(raw, welded.points);
  for (const Facet& facet : result.facets)
  {
    result.meanArea += Area(facet.shape);
  }
  result.meanArea /= static_cast<double>(result.facets.size());
  return result;
}

} // namespace vantage
