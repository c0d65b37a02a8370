#include "core/mesh/Clusters.h"

#include "core/mesh/CutSurfaces.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

namespace vantage
{

namespace
{

/// Surfaces part first where there are no more than these, about those of two rooms ...
constexpr std::ptrdiff_t MostSurfaces = 32;
/// ... each cut into so many patches in the mean.
constexpr std::ptrdiff_t LeastPatches = 4;

/// A patch on its way into the clusters.
struct Item
{
  Vec3 key; ///< what it is sorted by
  PatchId patch;
  std::uint32_t surface; ///< one side of one surface (CutSurfaces.h)
};

struct Bounds
{
  Vec3 low{ std::numeric_limits<double>::infinity() };
  Vec3 high{ -std::numeric_limits<double>::infinity() };

  void Add(const Vec3& p)
  {
    this->low = glm::min(this->low, p);
    this->high = glm::max(this->high, p);
  }
  void Add(const Bounds& other)
  {
    this->low = glm::min(this->low, other.low);
    this->high = glm::max(this->high, other.high);
  }
  Vec3 Extent() const { return this->high - this->low; }
  double Diagonal() const { return glm::length(this->Extent()); }
};

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

constexpr int BinCount = 16;
/// Of a bin: a row of patches whose middles lie on the border but for rounding is not torn apart.
constexpr double Slack = 1e-7;

/// Where to cut a range of items: those whose bin along the axis is below `bin` go left.
struct Cut
{
  int axis = 0;
  int bin = 0; ///< 0: no good cut was found
  double cost = std::numeric_limits<double>::infinity();
};

/// The bins of a box along one axis.
class Binning
{
public:
  Binning(const Bounds& box, int axis)
    : Axis(axis)
    , Low(box.low[axis])
  {
    const double extent = box.high[axis] - box.low[axis];
    this->Scale = extent > 0.0 ? BinCount / extent : 0.0;
  }
  int Of(const Vec3& key) const
  {
    const double place = (key[this->Axis] - this->Low) * this->Scale + Slack;
    return std::min(static_cast<int>(place), BinCount - 1);
  }

private:
  int Axis;
  double Low;
  double Scale;
};

/// The cut across one axis with the smallest sum of count times diagonal, a measure of how far a
/// cluster is from a point. Each side gets `least` items at least.
Cut BestCut(const Item* first, const Item* last, const Bounds& box, int axis, std::ptrdiff_t least)
{
  std::array<Bounds, BinCount> boxes;
  std::array<std::ptrdiff_t, BinCount> counts{};
  const Binning bins(box, axis);
  for (const Item* item = first; item != last; ++item)
  {
    const int bin = bins.Of(item->key);
    boxes[bin].Add(item->key);
    ++counts[bin];
  }
  std::array<double, BinCount> costAbove{}; ///< of the bins from i on
  Bounds above;
  std::ptrdiff_t countAbove = 0;
  for (int i = BinCount - 1; i > 0; --i)
  {
    above.Add(boxes[i]);
    countAbove += counts[i];
    costAbove[i] = countAbove > 0 ? countAbove * above.Diagonal() : 0.0;
  }
  const std::ptrdiff_t total = last - first;
  Cut best;
  best.axis = axis;
  Bounds below;
  std::ptrdiff_t countBelow = 0;
  for (int i = 1; i < BinCount; ++i)
  {
    below.Add(boxes[i - 1]);
    countBelow += counts[i - 1];
    if (countBelow < least || total - countBelow < least)
    {
      continue;
    }
    const double cost = countBelow * below.Diagonal() + costAbove[i];
    if (cost < best.cost)
    {
      best.bin = i;
      best.cost = cost;
    }
  }
  return best;
}

/// Reorders a range of two items or more into two parts that are not empty; returns where the
/// second one starts.
Item* Partition(Item* first, Item* last, std::ptrdiff_t least)
{
  Bounds box;
  for (const Item* item = first; item != last; ++item)
  {
    box.Add(item->key);
  }
  Cut best;
  for (int axis = 0; axis < 3; ++axis)
  {
    const Cut cut = BestCut(first, last, box, axis, least);
    if (cut.cost < best.cost)
    {
      best = cut;
    }
  }
  if (best.bin > 0)
  {
    const Binning bins(box, best.axis);
    return std::partition(
      first, last, [&](const Item& item) { return bins.Of(item.key) < best.bin; });
  }
  const Vec3 extent = box.Extent();
  const int axis =
    extent.x >= extent.y ? (extent.x >= extent.z ? 0 : 2) : (extent.y >= extent.z ? 1 : 2);
  Item* middle = first + (last - first) / 2;
  std::nth_element(first, middle, last,
    [axis](const Item& a, const Item& b)
    { return a.key[axis] != b.key[axis] ? a.key[axis] < b.key[axis] : a.patch < b.patch; });
  return middle;
}

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
      node.centre = 0.5 * (boxes[id].low + boxes[id].high);
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
  Patches,      ///< a point in front of each patch
  Surfaces,     ///< a point in front of all that belongs to the same surface
  WithinSurface ///< the middle of each patch
};

class ClusterMaker
{
public:
  ClusterMaker(
    const FacetSet& facets, const std::vector<Patch>& patches, const std::vector<PatchId>& active);

  /// Breadth first: node i holds the items of range i, and a pair of children goes to the end.
  std::vector<Node> Make();

private:
  struct Range
  {
    Item* first;
    Item* last;
    Order order;

    std::ptrdiff_t Size() const { return this->last - this->first; }
  };

  /// Sorts by something else where it is time to.
  void Reorder(Range& range, NodeId id);
  bool HasFewCutSurfaces(const Range& range, NodeId id);
  void SortBySurface(const Range& range) const;
  void SortWithinSurface(const Range& range) const;
  void ShapeLeaf(NodeId id, PatchId patch);
  void ShapeCutSurfaces();

  const FacetSet& Facets;
  const std::vector<Patch>& Patches;
  std::vector<Item> Items;
  std::vector<NodeId> LastSeen; ///< of each surface: the last range that was found to reach into it
  std::vector<Node> Nodes;
  std::vector<NodeId> CutSurfaces; ///< nodes that hold patches of one surface, and no parent does
};

ClusterMaker::ClusterMaker(
  const FacetSet& facets, const std::vector<Patch>& patches, const std::vector<PatchId>& active)
  : Facets(facets)
  , Patches(patches)
  , LastSeen(2 * facets.facets.size(), None)
  , Nodes(1)
{
  const std::vector<std::uint32_t> surfaces = SurfacesOf(facets);
  this->Items.reserve(active.size());
  for (const PatchId patch : active)
  {
    this->Items.push_back({ SortingPoint(ShapeOfPatch(facets, patch), patches[patch].normal), patch,
      2 * surfaces[patch / 2] + patch % 2 });
  }
  // Room for elements, so that the first of a large scene does not move all of it.
  this->Nodes.reserve(2 * active.size() + active.size() / 2 + 1024);
}

std::vector<Node> ClusterMaker::Make()
{
  Item* items = this->Items.data();
  std::vector<Range> ranges{ { items, items + this->Items.size(), Order::Patches } };
  ranges.reserve(2 * this->Items.size() - 1);
  for (NodeId id = 0; id < this->Nodes.size(); ++id)
  {
    Range range = ranges[id];
    if (range.Size() == 1)
    {
      this->ShapeLeaf(id, range.first->patch);
      continue;
    }
    this->Reorder(range, id);
    // An eighth at least on either side bounds the depth of the tree by a multiple of log n.
    const std::ptrdiff_t least = range.order == Order::Surfaces ? 1 : range.Size() / 8;
    Item* middle = Partition(range.first, range.last, std::max<std::ptrdiff_t>(1, least));
    ranges.push_back({ range.first, middle, range.order });
    ranges.push_back({ middle, range.last, range.order });
    this->Nodes[id].firstChild = static_cast<NodeId>(this->Nodes.size());
    this->Nodes[id].childCount = 2;
    Node child;
    child.parent = id;
    this->Nodes.insert(this->Nodes.end(), 2, child);
  }
  SummariseClusters(this->Nodes);
  this->ShapeCutSurfaces();
  return std::move(this->Nodes);
}

void ClusterMaker::Reorder(Range& range, NodeId id)
{
  if (range.order == Order::Patches && this->HasFewCutSurfaces(range, id))
  {
    this->SortBySurface(range);
    range.order = Order::Surfaces;
  }
  const auto isOfFirst = [&range](const Item& item)
  { return item.surface == range.first->surface; };
  if (range.order == Order::Surfaces && std::all_of(range.first, range.last, isOfFirst))
  {
    this->SortWithinSurface(range);
    range.order = Order::WithinSurface;
    this->CutSurfaces.push_back(id);
  }
}

bool ClusterMaker::HasFewCutSurfaces(const Range& range, NodeId id)
{
  const std::ptrdiff_t most = std::min(MostSurfaces, range.Size() / LeastPatches);
  std::ptrdiff_t surfaces = 0;
  for (const Item* item = range.first; item != range.last && surfaces <= most; ++item)
  {
    surfaces += this->LastSeen[item->surface] == id ? 0 : 1;
    this->LastSeen[item->surface] = id;
  }
  return surfaces <= most;
}

void ClusterMaker::SortBySurface(const Range& range) const
{
  struct Sums
  {
    Vec3 areaTimesCentroid{ 0.0 };
    double area = 0.0;
  };
  std::map<std::uint32_t, Sums> surfaces;
  for (const Item* item = range.first; item != range.last; ++item)
  {
    const TriangleOrQuadrilateral& shape = this->Facets.facets[item->patch / 2].shape;
    const double area = Area(shape);
    Sums& sums = surfaces[item->surface];
    sums.areaTimesCentroid += area * Centroid(shape);
    sums.area += area;
  }
  for (Item* item = range.first; item != range.last; ++item)
  {
    const Sums& sums = surfaces[item->surface];
    item->key =
      sums.areaTimesCentroid / sums.area + InFront(sums.area) * this->Patches[item->patch].normal;
  }
}

/// Along the sides of the patches, so that rows and columns stay together however they are turned.
/// The two triangles that a quadrilateral was cut into have the same middle: that of their longest
/// edge.
void ClusterMaker::SortWithinSurface(const Range& range) const
{
  const auto shapeOf = [this](const Item& item)
  { return PolygonView(this->Facets.facets[item.patch / 2].shape); };
  const Grid grid(shapeOf(*range.first));
  for (Item* item = range.first; item != range.last; ++item)
  {
    const PolygonView shape = shapeOf(*item);
    item->key = grid.Of(shape.Size() == 3 ? MiddleOfLongestEdge(shape) : Centroid(shape));
  }
}

void ClusterMaker::ShapeLeaf(NodeId id, PatchId patch)
{
  this->Nodes[id].patch = patch;
  this->Nodes[id].SetShape(ShapeOfPatch(this->Facets, patch));
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
  const FacetSet& facets, const std::vector<Patch>& patches, const std::vector<PatchId>& active)
{
  return ClusterMaker(facets, patches, active).Make();
}

} // namespace vantage
