#include "core/mesh/Clusters.h"

#include "core/mesh/Bounds.h"
#include "core/mesh/CurvedSurfaces.h"
#include "core/mesh/CutSurfaces.h"
#include "core/mesh/Partition.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <deque>
#include <map>

namespace vantage
{

namespace
{

/// Surfaces part first where there are no more than these, about those of two rooms ...
constexpr std::ptrdiff_t MostSurfaces = 32;
/// ... each cut into so many patches in the mean.
constexpr std::ptrdiff_t LeastPatches = 4;

/// Of InFront(), what tells the two sides of a closed surface apart, which has no mean normal.
constexpr double Apart = 1e-3;

/// How far in front of a surface the point is that it is sorted by. Two fifths of its size off, the
/// two sides of a wall are further apart than the walls of a room, and none reaches the opposite
/// one.
double InFront(double area)
{
  return 0.4 * std::sqrt(area);
}

Vec3 SortingPoint(PolygonView shape, const Vec3& normal)
{
  return Centroid(shape) + InFront(Area(shape)) * normal;
}

Vec3 MiddleOfLongestEdge(PolygonView shape)
{
  Vec3 middle(0.0);
  double longest = -1.0;
  for (int i = 0; i < shape.Size(); ++i)
  {
    const Vec3& next = shape[(i + 1) % shape.Size()];
    const double length = glm::length(next - shape[i]);
    if (length > longest)
    {
      longest = length;
      middle = Midpoint(shape[i], next);
    }
  }
  return middle;
}

/// Lengths along the two edges at the corner of a patch that is nearest to a right angle.
class Grid
{
public:
  explicit Grid(PolygonView shape)
  {
    const int n = shape.Size();
    double leastCosine = 2.0;
    for (int i = 0; i < n; ++i)
    {
      const Vec3 u = glm::normalize(shape[(i + 1) % n] - shape[i]);
      const Vec3 v = glm::normalize(shape[(i + n - 1) % n] - shape[i]);
      const double cosine = glm::dot(u, v);
      if (std::abs(cosine) < leastCosine)
      {
        leastCosine = std::abs(cosine);
        const double sine2 = 1.0 - cosine * cosine;
        this->AlongU = (u - cosine * v) / sine2;
        this->AlongV = (v - cosine * u) / sine2;
      }
    }
  }
  Vec3 Of(const Vec3& point) const
  {
    return { glm::dot(point, this->AlongU), glm::dot(point, this->AlongV), 0.0 };
  }

private:
  Vec3 AlongU{ 0.0 }, AlongV{ 0.0 };
};

/// Centres, radii and areas of the clusters, from the bottom up.
void SummariseClusters(std::vector<Node>& nodes)
{
  std::vector<Bounds> boxes(nodes.size());
  for (std::size_t id = nodes.size(); id-- > 0;)
  {
    Node& node = nodes[id];
    for (int i = 0; i < node.cornerCount; ++i)
    {
      boxes[id].Add(node.corners[i]);
    }
    if (node.IsCluster())
    {
      node.centre = 0.5 * (boxes[id].Low() + boxes[id].High());
      double radius = 0.0;
      for (NodeId c = node.firstChild; c < node.firstChild + node.childCount; ++c)
      {
        radius = std::max(radius, glm::length(nodes[c].centre - node.centre) + nodes[c].radius);
        node.area += nodes[c].area;
      }
      node.radius = std::min(radius, 0.5 * boxes[id].Diagonal());
    }
    if (node.parent != None)
    {
      boxes[node.parent].Add(boxes[id]);
    }
  }
}

/// What the items of a range are sorted by.
enum class Order
{
  Patches,        ///< a point in front of each patch
  CurvedSurfaces, ///< a point in front of all that belongs to the same curved surface
  WithinCurved,   ///< of which there is one only: a point in front of each patch
  Surfaces,       ///< a point in front of all that belongs to the same flat surface
  WithinSurface   ///< the middle of each patch
};

using SurfaceOfItem = std::uint32_t ClusterItem::*;

/// Looks at no more items than it takes.
bool HasFewCutSurfaces(const ClusterItem* first, const ClusterItem* last, SurfaceOfItem surface)
{
  std::array<std::uint32_t, MostSurfaces> surfaces;
  const auto most = surfaces.begin() + std::min(MostSurfaces, (last - first) / LeastPatches);
  auto end = surfaces.begin();
  for (const ClusterItem* item = first; item != last; ++item)
  {
    if (std::find(surfaces.begin(), end, item->*surface) != end)
    {
      continue;
    }
    if (end == most)
    {
      return false;
    }
    *end++ = item->*surface;
  }
  return true;
}

bool IsOneSurface(const ClusterItem* first, const ClusterItem* last, SurfaceOfItem surface)
{
  return std::all_of(
    first, last, [&](const ClusterItem& item) { return item.*surface == first->*surface; });
}

class ClusterMaker
{
public:
  ClusterMaker(const FacetSet& facets, const std::vector<FacetEdge>& edges,
    const std::vector<Patch>& patches, const std::vector<bool>& isActive);

  /// Breadth first: a pair of children goes to the end.
  std::vector<Node> Make();

private:
  struct Range : ClusterRange
  {
    NodeId node;
    Order order;
  };

  /// What a patch is sorted by to start with.
  Vec3 KeyOf(PatchId patch) const
  {
    return SortingPoint(ShapeOfPatch(this->Facets, patch), this->Patches[patch].normal);
  }
  /// Sorts by something else where it is time to.
  void Reorder(Range& range);
  void SortByPatch(const Range& range) const;
  void SortBySurface(const Range& range, SurfaceOfItem surface) const;
  void SortWithinSurface(const Range& range) const;
  void Append(const ClusterRange& range, NodeId parent, Order order);
  void ShapeCutSurfaces();

  const FacetSet& Facets;
  const std::vector<Patch>& Patches;
  std::vector<PatchId> Curved; ///< surface of each patch
  std::vector<ClusterItem> Items;
  std::vector<Node> Nodes;
  std::deque<Range> Open;          ///< nodes that have no children yet
  std::vector<NodeId> CutSurfaces; ///< nodes that hold patches of one surface, and no parent does
};

ClusterMaker::ClusterMaker(const FacetSet& facets, const std::vector<FacetEdge>& edges,
  const std::vector<Patch>& patches, const std::vector<bool>& isActive)
  : Facets(facets)
  , Patches(patches)
  , Curved(CurvedSurfacesOf(facets, edges, patches))
{
  const std::vector<std::uint32_t> surfaces = SurfacesOf(facets, edges, patches);
  this->Items.reserve(static_cast<std::size_t>(std::count(isActive.begin(), isActive.end(), true)));
  for (PatchId patch = 0; patch < patches.size(); ++patch)
  {
    if (isActive[patch])
    {
      this->Items.push_back(
        { this->KeyOf(patch), patch, 2 * surfaces[patch / 2] + patch % 2, this->Curved[patch] });
    }
  }
  // Room for elements, so that the first of a large scene does not move all of it.
  this->Nodes.reserve(2 * this->Items.size() + this->Items.size() / 2 + 1024);
}

std::vector<Node> ClusterMaker::Make()
{
  ClusterItem* const first = this->Items.data();
  ClusterItem* const last = first + this->Items.size();
  this->Append({ first, last, BoxOf(first, last) }, None, Order::Patches);
  for (; !this->Open.empty(); this->Open.pop_front())
  {
    Range range = this->Open.front();
    this->Reorder(range);
    // An eighth at least on either side bounds the depth of the tree by a multiple of log n.
    const std::ptrdiff_t least =
      range.order == Order::Surfaces || range.order == Order::CurvedSurfaces ? 1 : range.Size() / 8;
    this->Nodes[range.node].firstChild = static_cast<NodeId>(this->Nodes.size());
    this->Nodes[range.node].childCount = 2;
    for (const ClusterRange& part : Partition(range, std::max<std::ptrdiff_t>(1, least)))
    {
      this->Append(part, range.node, range.order);
    }
  }
  SummariseClusters(this->Nodes);
  FindBends(this->Nodes, this->Patches, this->Curved);
  this->ShapeCutSurfaces();
  return std::move(this->Nodes);
}

void ClusterMaker::Append(const ClusterRange& range, NodeId parent, Order order)
{
  Node node;
  node.parent = parent;
  if (range.Size() == 1)
  {
    node.patch = range.first->patch;
    node.SetShape(ShapeOfPatch(this->Facets, node.patch));
  }
  else
  {
    this->Open.push_back({ range, static_cast<NodeId>(this->Nodes.size()), order });
  }
  this->Nodes.push_back(node);
}

void ClusterMaker::Reorder(Range& range)
{
  const auto hasFew = [&range](SurfaceOfItem surface)
  { return HasFewCutSurfaces(range.first, range.last, surface); };
  const auto isOne = [&range](SurfaceOfItem surface)
  { return IsOneSurface(range.first, range.last, surface); };
  const Order before = range.order;
  if (range.order == Order::Patches && hasFew(&ClusterItem::curved))
  {
    this->SortBySurface(range, &ClusterItem::curved);
    range.order = Order::CurvedSurfaces;
  }
  if (range.order == Order::CurvedSurfaces && isOne(&ClusterItem::curved))
  {
    this->SortByPatch(range);
    range.order = Order::WithinCurved;
  }
  if (range.order == Order::WithinCurved &&
      (hasFew(&ClusterItem::surface) || isOne(&ClusterItem::surface)))
  {
    this->SortBySurface(range, &ClusterItem::surface);
    range.order = Order::Surfaces;
  }
  if (range.order == Order::Surfaces && isOne(&ClusterItem::surface))
  {
    this->SortWithinSurface(range);
    range.order = Order::WithinSurface;
    this->CutSurfaces.push_back(range.node);
  }
  if (range.order != before)
  {
    range.box = BoxOf(range.first, range.last);
  }
}

void ClusterMaker::SortByPatch(const Range& range) const
{
  for (ClusterItem* item = range.first; item != range.last; ++item)
  {
    item->key = this->KeyOf(item->patch);
  }
}

void ClusterMaker::SortBySurface(const Range& range, SurfaceOfItem surface) const
{
  struct Sums
  {
    Vec3 areaTimesCentroid{ 0.0 };
    Vec3 areaTimesNormal{ 0.0 };
    double area = 0.0;
    PatchId least = None;
  };
  std::map<std::uint32_t, Sums> surfaces;
  for (const ClusterItem* item = range.first; item != range.last; ++item)
  {
    const TriangleOrQuadrilateral& shape = this->Facets.facets[item->patch / 2].shape;
    const double area = Area(shape);
    Sums& sums = surfaces[item->*surface];
    sums.areaTimesCentroid += area * Centroid(shape);
    sums.areaTimesNormal += area * this->Patches[item->patch].normal;
    sums.area += area;
    sums.least = std::min(sums.least, item->patch);
  }
  for (ClusterItem* item = range.first; item != range.last; ++item)
  {
    const Sums& sums = surfaces[item->*surface];
    item->key = (sums.areaTimesCentroid + InFront(sums.area) * sums.areaTimesNormal) / sums.area +
                Apart * InFront(sums.area) * this->Patches[sums.least].normal;
  }
}

/// Along the sides of the patches, so that rows and columns stay together however they are turned.
/// The two triangles that a quadrilateral was cut into have the same middle: that of their longest
/// edge.
void ClusterMaker::SortWithinSurface(const Range& range) const
{
  const auto shapeOf = [this](const ClusterItem& item)
  { return PolygonView(this->Facets.facets[item.patch / 2].shape); };
  const Grid grid(shapeOf(*range.first));
  for (ClusterItem* item = range.first; item != range.last; ++item)
  {
    const PolygonView shape = shapeOf(*item);
    item->key = grid.Of(shape.Size() == 3 ? MiddleOfLongestEdge(shape) : Centroid(shape));
  }
}

void ClusterMaker::ShapeCutSurfaces()
{
  for (const NodeId id : this->CutSurfaces)
  {
    NodeId leaf = id;
    while (this->Nodes[leaf].IsCluster())
    {
      leaf = this->Nodes[leaf].firstChild;
    }
    ShapeFlatClusters(
      this->Nodes, id, this->Patches[this->Nodes[leaf].patch].normal, this->Facets.Tolerance());
  }
}

} // namespace

std::vector<Node> MakeClusters(
  const FacetSet& facets, const std::vector<Patch>& patches, const std::vector<bool>& isActive)
{
  return ClusterMaker(facets, EdgesOf(facets.facets), patches, isActive).Make();
}

} // namespace vantage
