#include "core/mesh/ElementTree.h"

#include "core/mesh/Clusters.h"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace vantage
{

namespace
{

/// Both sides of all facets, none of them active yet.
std::vector<Patch> MakePatches(const FacetSet& facets)
{
  std::vector<Patch> patches(2 * facets.facets.size());
  for (PatchId id = 0; id < patches.size(); ++id)
  {
    patches[id].facet = id / 2;
    patches[id].side = SideOf(id);
    patches[id].normal = UnitNormal(ShapeOfPatch(facets, id));
  }
  return patches;
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

Polygon Node::Shape() const
{
  assert(this->HasShape());
  Polygon shape;
  for (int i = 0; i < this->cornerCount; ++i)
  {
    shape.Add(this->corners[i]);
  }
  return shape;
}

void Node::SetBend(double value)
{
  constexpr double RoundOff = 1e-6;
  this->bend = static_cast<std::uint8_t>(std::ceil(255.0 * std::max(0.0, value - RoundOff)));
}

void Node::SetShape(PolygonView shape)
{
  std::copy(shape.begin(), shape.end(), this->corners.begin());
  this->cornerCount = static_cast<std::uint8_t>(shape.Size());
  this->centre = Centroid(shape);
  this->radius = RadiusAround(shape, this->centre);
  this->area = Area(shape);
}

ElementTree::ElementTree(
  const FacetSet& facets, const std::vector<Material>& materials, Sides sides)
  : ElementTree(facets, ActivePatches(facets, materials, sides))
{
}

ElementTree::ElementTree(
  const FacetSet& facets, const std::vector<Material>& materials, const DarkSides& dark)
  : ElementTree(facets, ActivePatches(facets, materials, dark))
{
}

ElementTree::ElementTree(const FacetSet& facets, const std::vector<bool>& isActive)
  : AllPatches(MakePatches(facets))
{
  assert(!facets.facets.empty());
  this->Nodes = MakeClusters(facets, this->AllPatches, isActive);
  this->LeafElements = static_cast<std::size_t>(std::count(isActive.begin(), isActive.end(), true));
  for (NodeId id = 0; id < this->Nodes.size(); ++id)
  {
    if (!this->Nodes[id].IsCluster())
    {
      this->AllPatches[this->Nodes[id].patch].node = id;
    }
  }
}

std::array<Polygon, 4> Quarters(const Polygon& p)
{
  return p.Size() == 3 ? QuarterTriangle(p) : QuarterQuadrilateral(p);
}

NodeId ElementTree::Split(NodeId id)
{
  assert(!this->Nodes[id].IsCluster());
  if (!this->Nodes[id].IsLeaf())
  {
    return this->Nodes[id].firstChild;
  }
  const Polygon shape = this->Shape(id);
  const std::array<Polygon, 4> quarters = Quarters(shape);
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
    child.SetShape(quarter);
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
