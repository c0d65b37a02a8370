#include "core/mesh/CutSurfaces.h"

#include "core/mesh/DisjointSets.h"

#include <algorithm>
#include <cmath>

namespace vantage
{

namespace
{

/// Between normals that are not worth a closer look. Slivers have bad ones.
constexpr double LeastCosine = 0.5;
/// Of the area, what gaps may amount to.
constexpr double LargestGap = 1e-6;
/// Hulls with more corners are given up: whatever joins them, it will be no quadrilateral.
constexpr int MostCorners = 8;

/// Coordinates within the plane of a polygon: they move with the scene.
class PlaneFrame
{
public:
  PlaneFrame(const Polygon& shape, const Vec3& normal)
    : Origin(shape[0])
    , U(glm::normalize(shape[1] - shape[0]))
    , V(glm::cross(normal, this->U))
  {
  }
  Vec2 Of(const Vec3& p) const
  {
    return { glm::dot(p - this->Origin, this->U), glm::dot(p - this->Origin, this->V) };
  }

private:
  Vec3 Origin, U, V;
};

double Cross(const Vec2& a, const Vec2& b)
{
  return a.x * b.y - a.y * b.x;
}

/// A direction that sides of polygons do not tend to be at right angles to: the furthest point
/// along it is a corner of the hull, and no other one is about as far.
constexpr Vec2 Askew(0.87, 0.49);

std::size_t FurthestAskew(const std::vector<Vec2>& points)
{
  const auto isNearer = [](const Vec2& p, const Vec2& q)
  { return glm::dot(p, Askew) < glm::dot(q, Askew); };
  return static_cast<std::size_t>(
    std::max_element(points.begin(), points.end(), isNearer) - points.begin());
}

/// The corner of the hull that follows `corner` counter-clockwise: no point lies to the right of
/// the way to it, and those on the way are nearer.
std::size_t NextCorner(const std::vector<Vec2>& points, std::size_t corner, double tolerance)
{
  std::size_t next = corner;
  Vec2 way(0.0);
  for (std::size_t i = 0; i < points.size(); ++i)
  {
    const Vec2 other = points[i] - points[corner];
    const double length = glm::length(other);
    if (length <= tolerance)
    {
      continue;
    }
    const double aside = Cross(way, other);
    const double slack = tolerance * std::max(length, glm::length(way));
    if (next == corner || aside < -slack || (aside <= slack && length > glm::length(way)))
    {
      next = i;
      way = other;
    }
  }
  return next;
}

/// The convex hull of two polygons in one plane, counter-clockwise (Jarvis 1973: there are sixteen
/// points at most). Which corner is the first does not depend on where the scene is. Empty if there
/// are too many.
Polygon Hull(const Polygon& a, const Polygon& b, const Vec3& normal, double tolerance)
{
  const PlaneFrame frame(a, normal);
  std::vector<Vec3> points(a.begin(), a.end());
  points.insert(points.end(), b.begin(), b.end());
  std::vector<Vec2> inPlane;
  for (const Vec3& point : points)
  {
    inPlane.push_back(frame.Of(point));
  }
  Polygon hull;
  const std::size_t first = FurthestAskew(inPlane);
  std::size_t corner = first;
  do
  {
    if (hull.Size() == MostCorners)
    {
      return {};
    }
    hull.Add(points[corner]);
    corner = NextCorner(inPlane, corner, tolerance);
  } while (glm::length(inPlane[corner] - inPlane[first]) > tolerance);
  return hull;
}

/// The hull of what lies below a node, empty if it has too many corners.
Polygon Shape(std::vector<Node>& nodes, NodeId id, const Vec3& normal, double tolerance)
{
  Node& node = nodes[id];
  if (!node.IsCluster())
  {
    return node.Shape();
  }
  const Polygon a = Shape(nodes, node.firstChild, normal, tolerance);
  const Polygon b = Shape(nodes, node.firstChild + 1, normal, tolerance);
  if (a.Empty() || b.Empty())
  {
    return {};
  }
  const Polygon hull = Hull(a, b, normal, tolerance);
  if (!hull.Empty() && hull.Size() <= 4 &&
      std::abs(Area(hull) - node.area) <= LargestGap * node.area)
  {
    node.SetShape(hull);
  }
  return hull;
}

/// One looks like the other, on both sides, and lies in its plane.
bool Continues(const Facet& a, const Facet& b, const Vec3& normal, double tolerance)
{
  if (a.material != b.material || a.backMaterial != b.backMaterial)
  {
    return false;
  }
  return std::all_of(b.shape.begin(), b.shape.end(),
    [&](const Vec3& p) { return std::abs(glm::dot(p - a.shape[0], normal)) <= tolerance; });
}

} // namespace

std::vector<std::uint32_t> SurfacesOf(
  const FacetSet& set, const std::vector<FacetEdge>& edges, const std::vector<Patch>& patches)
{
  const std::vector<Facet>& facets = set.facets;
  const double tolerance = set.Tolerance();
  DisjointSets surfaces(facets.size());
  ForEachEdge(edges,
    [&](const auto first, const auto last)
    {
      if (last - first != 2)
      {
        return;
      }
      const std::uint32_t a = first[0].facet;
      const std::uint32_t b = first[1].facet;
      const Vec3& normal = patches[PatchOf(a, Side::Front)].normal;
      if (glm::dot(normal, patches[PatchOf(b, Side::Front)].normal) > LeastCosine &&
          Continues(facets[a], facets[b], normal, tolerance))
      {
        surfaces.Join(a, b);
      }
    });
  std::vector<std::uint32_t> numbers(facets.size());
  std::uint32_t count = 0;
  for (std::uint32_t f = 0; f < facets.size(); ++f)
  {
    const std::uint32_t first = surfaces.Find(f);
    numbers[f] = first == f ? count++ : numbers[first];
  }
  return numbers;
}

void ShapeFlatClusters(std::vector<Node>& nodes, NodeId root, const Vec3& normal, double tolerance)
{
  Shape(nodes, root, normal, tolerance);
}

} // namespace vantage
