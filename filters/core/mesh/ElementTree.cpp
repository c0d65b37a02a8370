#include "core/mesh/ElementTree.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>

namespace vantage
{

namespace
{

/// A patch on its way into the clusters.
struct Item
{
  Vec3 key; ///< what it is sorted by
  PatchId patch;
};

struct Box
{
  Vec3 low{ std::numeric_limits<double>::infinity() };
  Vec3 high{ -std::numeric_limits<double>::infinity() };

  void Add(const Vec3& p)
  {
    this->low = glm::min(this->low, p);
    this->high = glm::max(this->high, p);
  }
  void Add(const Box& other)
  {
    this->low = glm::min(this->low, other.low);
    this->high = glm::max(this->high, other.high);
  }
  Vec3 Extent() const { return this->high - this->low; }
  double Diagonal() const { return glm::length(this->Extent()); }
};

/// A point in the air in front of the patch. Two fifths of its size off the surface, the two sides
/// of a wall are further apart than the walls of a room, and none reaches the opposite one.
Vec3 SortingPoint(const Polygon& shape, const Vec3& normal)
{
  return Centroid(shape) + 0.4 * std::sqrt(Area(shape)) * normal;
}

constexpr int BinCount = 16;

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
  Binning(const Box& box, int axis)
    : Axis(axis)
    , Low(box.low[axis])
  {
    const double extent = box.high[axis] - box.low[axis];
    this->Scale = extent > 0.0 ? BinCount / extent : 0.0;
  }
  int Of(const Vec3& key) const
  {
    return std::min(static_cast<int>((key[this->Axis] - this->Low) * this->Scale), BinCount - 1);
  }

private:
  int Axis;
  double Low;
  double Scale;
};

/// The cut across one axis with the smallest sum of count times diagonal, a measure of how far a
/// cluster is from a point. Each side gets an eighth of the items at least, which bounds the depth
/// of the tree by a multiple of log n.
Cut BestCut(const Item* first, const Item* last, const Box& box, int axis)
{
  std::array<Box, BinCount> boxes;
  std::array<std::ptrdiff_t, BinCount> counts{};
  const Binning bins(box, axis);
  for (const Item* item = first; item != last; ++item)
  {
    const int bin = bins.Of(item->key);
    boxes[bin].Add(item->key);
    ++counts[bin];
  }
  std::array<double, BinCount> costAbove{}; ///< of the bins from i on
  Box above;
  std::ptrdiff_t countAbove = 0;
  for (int i = BinCount - 1; i > 0; --i)
  {
    above.Add(boxes[i]);
    countAbove += counts[i];
    costAbove[i] = countAbove > 0 ? countAbove * above.Diagonal() : 0.0;
  }
  const std::ptrdiff_t total = last - first;
  const std::ptrdiff_t least = std::max<std::ptrdiff_t>(1, total / 8);
  Cut best;
  best.axis = axis;
  Box below;
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
Item* Partition(Item* first, Item* last)
{
  Box box;
  for (const Item* item = first; item != last; ++item)
  {
    box.Add(item->key);
  }
  Cut best;
  for (int axis = 0; axis < 3; ++axis)
  {
    const Cut cut = BestCut(first, last, box, axis);
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

/// The shape of a patch, counter-clockwise seen from its side.
Polygon ShapeOfPatch(const FacetSet& facets, PatchId id)
{
  const Polygon& shape = facets.facets[id / 2].shape;
  return id % 2 == 0 ? shape : Reversed(shape);
}

/// Both sides of all facets, none of them active yet.
std::vector<Patch> MakePatches(const FacetSet& facets)
{
  std::vector<Patch> patches(2 * facets.facets.size());
  for (PatchId id = 0; id < patches.size(); ++id)
  {
    patches[id].facet = id / 2;
    patches[id].side = id % 2 == 0 ? Side::Front : Side::Back;
    patches[id].normal = UnitNormal(ShapeOfPatch(facets, id));
  }
  return patches;
}

/// The patches that are to be active.
std::vector<Item> CollectItems(const FacetSet& facets, const std::vector<Material>& materials,
  ElementTree::Sides sides, const std::vector<Patch>& patches)
{
  std::vector<Item> items;
  items.reserve(patches.size());
  for (PatchId id = 0; id < patches.size(); ++id)
  {
    const Facet& facet = facets.facets[patches[id].facet];
    if (facet.IsPolygonFront(patches[id].side) ||
        (sides == ElementTree::Sides::Both && materials[facet.material].twoSided))
    {
      items.push_back({ SortingPoint(ShapeOfPatch(facets, id), patches[id].normal), id });
    }
  }
  return items;
}

/// Clusters over the items, one leaf for each of them; the leaves have no shape yet. Breadth first:
/// node i holds the items of range i, and a pair of children goes to the end.
std::vector<Node> MakeClusters(std::vector<Item>& items)
{
  std::vector<Node> nodes(1);
  // Room for elements, so that the first of a large scene does not move all of it.
  nodes.reserve(2 * items.size() + items.size() / 2 + 1024);
  std::vector<std::pair<Item*, Item*>> ranges{ { items.data(), items.data() + items.size() } };
  ranges.reserve(2 * items.size() - 1);
  for (NodeId id = 0; id < nodes.size(); ++id)
  {
    const auto [first, last] = ranges[id];
    if (last - first == 1)
    {
      nodes[id].patch = first->patch;
      continue;
    }
    Item* middle = Partition(first, last);
    ranges.emplace_back(first, middle);
    ranges.emplace_back(middle, last);
    nodes[id].firstChild = static_cast<NodeId>(nodes.size());
    nodes[id].childCount = 2;
    Node child;
    child.parent = id;
    nodes.insert(nodes.end(), 2, child);
  }
  return nodes;
}

/// Fills in what a node's shape says.
void SetShape(Node& node, const Polygon& shape)
{
  std::copy(shape.begin(), shape.end(), node.corners.begin());
  node.cornerCount = static_cast<std::uint8_t>(shape.Size());
  node.centre = Centroid(shape);
  node.radius = RadiusAround(shape, node.centre);
  node.area = Area(shape);
}

/// Centres, radii and areas of the clusters, from the bottom up.
void SummariseClusters(std::vector<Node>& nodes)
{
  std::vector<Box> boxes(nodes.size());
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

std::array<Polygon, 4> QuarterTriangle(const Polygon& p)
{
  const Vec3 m01 = Midpoint(p[0], p[1]);
  const Vec3 m12 = Midpoint(p[1], p[2]);
  const Vec3 m20 = Midpoint(p[2], p[0]);
  return { Polygon{ p[0], m01, m20 }, Polygon{ m01, p[1], m12 }, Polygon{ m20, m12, p[2] },
    Polygon{ m12, m20, m01 } };
}

std::array<Polygon, 4> QuarterQuadrilateral(const Polygon& p)
{
  const Vec3 m01 = Midpoint(p[0], p[1]);
  const Vec3 m12 = Midpoint(p[1], p[2]);
  const Vec3 m23 = Midpoint(p[2], p[3]);
  const Vec3 m30 = Midpoint(p[3], p[0]);
  const Vec3 centre = Midpoint(Midpoint(p[0], p[2]), Midpoint(p[1], p[3]));
  return { Polygon{ p[0], m01, centre, m30 }, Polygon{ m01, p[1], m12, centre },
    Polygon{ centre, m12, p[2], m23 }, Polygon{ m30, centre, m23, p[3] } };
}

/// Whether x lies to the left of the line from a to b, seen against the normal n.
bool IsLeftOf(const Vec3& a, const Vec3& b, const Vec3& n, const Vec3& x)
{
  return glm::dot(glm::cross(b - a, x - a), n) > 0.0;
}

/// Two lines through the midpoints of opposite edges part the children of a quadrilateral.
NodeId ChildOfQuadrilateral(const Polygon& p, const Vec3& normal, const Vec3& x)
{
  const bool nearEdge30 = IsLeftOf(Midpoint(p[0], p[1]), Midpoint(p[2], p[3]), normal, x);
  const bool nearEdge23 = IsLeftOf(Midpoint(p[3], p[0]), Midpoint(p[1], p[2]), normal, x);
  if (nearEdge23)
  {
    return nearEdge30 ? 3 : 2;
  }
  return nearEdge30 ? 0 : 1;
}

/// A corner child holds the points whose barycentric coordinate there is above one half.
NodeId ChildOfTriangle(const Polygon& p, const Vec3& normal, const Vec3& x)
{
  std::array<double, 3> weights;
  for (int i = 0; i < 3; ++i)
  {
    weights[i] = glm::dot(glm::cross(p[(i + 1) % 3] - x, p[(i + 2) % 3] - x), normal);
  }
  const auto largest = std::max_element(weights.begin(), weights.end());
  const double half = 0.5 * (weights[0] + weights[1] + weights[2]);
  return *largest > half ? static_cast<NodeId>(largest - weights.begin()) : 3;
}

} // namespace

ElementTree::ElementTree(
  const FacetSet& facets, const std::vector<Material>& materials, Sides sides)
  : AllPatches(MakePatches(facets))
{
  assert(!facets.facets.empty());
  std::vector<Item> items = CollectItems(facets, materials, sides, this->AllPatches);
  this->Nodes = MakeClusters(items);
  this->LeafElements = items.size();
  for (NodeId id = 0; id < this->Nodes.size(); ++id)
  {
    Node& node = this->Nodes[id];
    if (!node.IsCluster())
    {
      this->AllPatches[node.patch].node = id;
      SetShape(node, ShapeOfPatch(facets, node.patch));
    }
  }
  SummariseClusters(this->Nodes);
}

Polygon ElementTree::Shape(NodeId id) const
{
  const Node& node = this->Nodes[id];
  assert(!node.IsCluster());
  Polygon shape;
  for (int i = 0; i < node.cornerCount; ++i)
  {
    shape.Add(node.corners[i]);
  }
  return shape;
}

NodeId ElementTree::Split(NodeId id)
{
  assert(!this->Nodes[id].IsCluster());
  if (!this->Nodes[id].IsLeaf())
  {
    return this->Nodes[id].firstChild;
  }
  const Polygon shape = this->Shape(id);
  const std::array<Polygon, 4> quarters =
    shape.Size() == 3 ? QuarterTriangle(shape) : QuarterQuadrilateral(shape);
  Node child;
  child.parent = id;
  child.patch = this->Nodes[id].patch;
  child.level = static_cast<std::uint8_t>(this->Nodes[id].level + 1);
  const NodeId first = this->Size();
  if (this->Nodes.capacity() < this->Nodes.size() + 4)
  {
    // Not to twice the size: a view splits but a few of the patches of a large scene.
    this->Nodes.reserve(this->Nodes.size() + this->Nodes.size() / 4 + 1024);
  }
  for (const Polygon& quarter : quarters)
  {
    SetShape(child, quarter);
    this->Nodes.push_back(child);
  }
  this->Nodes[id].firstChild = first;
  this->Nodes[id].childCount = 4;
  this->LeafElements += 3;
  return first;
}

NodeId ElementTree::ChildContaining(NodeId id, const Vec3& point) const
{
  const Node& node = this->Nodes[id];
  assert(!node.IsCluster() && !node.IsLeaf());
  const Polygon shape = this->Shape(id);
  const Vec3& normal = this->PatchOfNode(id).normal;
  return node.firstChild + (shape.Size() == 3 ? ChildOfTriangle(shape, normal, point)
                                              : ChildOfQuadrilateral(shape, normal, point));
}

NodeId ElementTree::LeafContaining(NodeId id, const Vec3& point) const
{
  while (!this->Nodes[id].IsLeaf())
  {
    id = this->ChildContaining(id, point);
  }
  return id;
}

} // namespace vantage
