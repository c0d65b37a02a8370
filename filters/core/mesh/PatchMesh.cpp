#include "core/mesh/PatchMesh.h"

#include "core/mesh/DisjointSets.h"
#include "core/mesh/PatchEdges.h"

#include <OpenMesh/Core/Mesh/PolyConnectivity.hh>

#include <array>
#include <cassert>
#include <cmath>

namespace vantage
{

namespace
{

using OpenMesh::EdgeHandle;
using OpenMesh::FaceHandle;
using OpenMesh::HalfedgeHandle;
using OpenMesh::VertexHandle;

/// Whether radiance jumps between two joined patches. Five degrees part the facets of a room and
/// leave those of a finely tessellated round surface together.
bool IsCrease(const ElementTree& tree, const FacetSet& facets, PatchId a, PatchId b)
{
  const double cosineLimit = std::cos(5.0 * Pi / 180.0);
  const Patch& p = tree.Patches()[a];
  const Patch& q = tree.Patches()[b];
  const Facet& f = facets.facets[p.facet];
  const Facet& g = facets.facets[q.facet];
  return glm::dot(p.normal, q.normal) < cosineLimit ||
         f.MaterialOf(p.side) != g.MaterialOf(q.side) ||
         f.IsPolygonFront(p.side) != g.IsPolygonFront(q.side);
}

} // namespace

/// The halfedge of a face always leaves corner 0 of its element.
struct PatchMesh::Implementation
{
  OpenMesh::PolyConnectivity Mesh;
  OpenMesh::VPropHandleT<Vec3> Position;
  OpenMesh::FPropHandleT<NodeId> Element;
  OpenMesh::EPropHandleT<std::uint8_t> IsCut; ///< 1: radiance is not continuous across the edge
  std::vector<FaceHandle> FaceOfNode;         ///< of a split node: of one of its descendants
  NodeId Followed = 0;                        ///< nodes of the tree that are in the mesh

  Implementation(const ElementTree& tree, const FacetSet& facets);
  VertexHandle AddVertex(const Vec3& point);
  const Vec3& PointLeft(HalfedgeHandle halfedge) const;
  std::vector<VertexHandle> AddVertices(
    const ElementTree& tree, const std::vector<PatchEdge>& edges);
  void AddFaces(const ElementTree& tree, const FacetSet& facets);
  void LinkBoundary();

  void Follow(const ElementTree& tree);
  void Split(const ElementTree& tree, NodeId parent);
  HalfedgeHandle SplitEdge(HalfedgeHandle halfedge, const Vec3& point);
  HalfedgeHandle FindLeaving(const Vec3& point, HalfedgeHandle start) const;
  void SplitQuadrilateral(const std::array<HalfedgeHandle, 4>& middles, const Vec3& centre);
  void SplitTriangle(const std::array<HalfedgeHandle, 4>& middles);

  ElementSurface Surface() const;
};

PatchMesh::Implementation::Implementation(const ElementTree& tree, const FacetSet& facets)
{
  this->Mesh.add_property(this->Position);
  this->Mesh.add_property(this->Element);
  this->Mesh.add_property(this->IsCut);
  this->AddFaces(tree, facets);
  this->LinkBoundary();
  this->Follow(tree);
}

VertexHandle PatchMesh::Implementation::AddVertex(const Vec3& point)
{
  const VertexHandle vertex = this->Mesh.new_vertex();
  this->Mesh.property(this->Position, vertex) = point;
  return vertex;
}

/// The point a halfedge leaves.
const Vec3& PatchMesh::Implementation::PointLeft(HalfedgeHandle halfedge) const
{
  return this->Mesh.property(this->Position, this->Mesh.from_vertex_handle(halfedge));
}

/// One vertex for each set of corners that are linked through joined edges: its faces are one fan,
/// closed or open, whatever else meets in the same place. Returns the vertex each edge leaves.
std::vector<VertexHandle> PatchMesh::Implementation::AddVertices(
  const ElementTree& tree, const std::vector<PatchEdge>& edges)
{
  DisjointSets corners(edges.size());
  for (std::uint32_t e = 0; e < edges.size(); ++e)
  {
    if (edges[e].partner != None)
    {
      corners.Join(e, edges[edges[e].partner].next);
    }
  }
  std::vector<VertexHandle> vertices(edges.size());
  for (std::uint32_t e = 0; e < edges.size(); ++e)
  {
    const std::uint32_t first = corners.Find(e);
    const Node& node = tree[tree.Patches()[edges[e].patch].node];
    vertices[e] = first < e ? vertices[first] : this->AddVertex(node.corners[edges[e].corner]);
  }
  return vertices;
}

/// Builds the connectivity itself: OpenMesh's add_face looks edges up by their ends and so refuses
/// two edges between the same two vertices, which a free-standing wall has.
void PatchMesh::Implementation::AddFaces(const ElementTree& tree, const FacetSet& facets)
{
  const std::vector<PatchEdge> edges = PairEdges(tree, facets);
  const std::vector<VertexHandle> vertices = this->AddVertices(tree, edges);
  std::vector<HalfedgeHandle> halfedges(edges.size());
  this->FaceOfNode.resize(tree.Size());
  for (std::uint32_t e = 0; e < edges.size(); ++e)
  {
    const PatchEdge& edge = edges[e];
    const NodeId node = tree.Patches()[edge.patch].node;
    if (edge.partner < e)
    {
      halfedges[e] = this->Mesh.opposite_halfedge_handle(halfedges[edge.partner]);
      this->Mesh.property(this->IsCut, this->Mesh.edge_handle(halfedges[e])) =
        IsCrease(tree, facets, edge.patch, edges[edge.partner].patch) ? 1 : 0;
    }
    else
    {
      halfedges[e] = this->Mesh.new_edge(vertices[e], vertices[edge.next]);
    }
    this->Mesh.set_halfedge_handle(vertices[e], halfedges[e]);
    if (edge.corner == 0)
    {
      this->FaceOfNode[node] = this->Mesh.new_face();
      this->Mesh.property(this->Element, this->FaceOfNode[node]) = node;
      this->Mesh.set_halfedge_handle(this->FaceOfNode[node], halfedges[e]);
    }
    this->Mesh.set_face_handle(halfedges[e], this->FaceOfNode[node]);
  }
  for (std::uint32_t e = 0; e < edges.size(); ++e)
  {
    this->Mesh.set_next_halfedge_handle(halfedges[e], halfedges[edges[e].next]);
  }
  this->Followed = static_cast<NodeId>(2 * this->Mesh.n_faces() - 1);
}

/// Chains the halfedges without a face. A vertex has one fan of faces and so at most one such
/// halfedge that leaves it; OpenMesh wants it to be the vertex's own.
void PatchMesh::Implementation::LinkBoundary()
{
  for (const auto halfedge : this->Mesh.halfedges())
  {
    if (this->Mesh.is_boundary(halfedge))
    {
      this->Mesh.set_halfedge_handle(this->Mesh.from_vertex_handle(halfedge), halfedge);
    }
  }
  for (const auto halfedge : this->Mesh.halfedges())
  {
    if (this->Mesh.is_boundary(halfedge))
    {
      this->Mesh.set_next_halfedge_handle(
        halfedge, this->Mesh.halfedge_handle(this->Mesh.to_vertex_handle(halfedge)));
    }
  }
}

/// Elements are only ever added to a tree, four at a time, in the order of the splits.
void PatchMesh::Implementation::Follow(const ElementTree& tree)
{
  this->FaceOfNode.resize(tree.Size());
  for (; this->Followed < tree.Size(); this->Followed += 4)
  {
    this->Split(tree, tree[this->Followed].parent);
  }
}

void PatchMesh::Implementation::Split(const ElementTree& tree, NodeId parent)
{
  const Node& node = tree[parent];
  const int n = node.cornerCount;
  const FaceHandle face = this->FaceOfNode[parent];
  std::array<HalfedgeHandle, 4> corners; // the halfedge that leaves corner i
  std::array<HalfedgeHandle, 4> middles; // and the one that leaves the middle of edge i
  corners[0] = this->Mesh.halfedge_handle(face);
  for (int i = 1; i < n; ++i)
  {
    corners[i] = this->FindLeaving(node.corners[i], corners[i - 1]);
  }
  for (int i = 0; i < n; ++i)
  {
    const Vec3& middle = tree[node.firstChild + i].corners[(i + 1) % n];
    if (this->Mesh.next_halfedge_handle(corners[i]) == corners[(i + 1) % n])
    {
      middles[i] = this->SplitEdge(corners[i], middle);
      corners[i] = this->Mesh.prev_halfedge_handle(middles[i]);
    }
    else
    {
      middles[i] = this->FindLeaving(middle, corners[i]);
    }
  }
  if (n == 4)
  {
    this->SplitQuadrilateral(middles, tree[node.firstChild].corners[2]);
  }
  else
  {
    this->SplitTriangle(middles);
  }
  for (int i = 0; i < 4; ++i)
  {
    // The child without a corner of its parent is the middle of a triangle, where the face stays.
    const NodeId child = node.firstChild + i;
    const FaceHandle childFace = i < n ? this->Mesh.face_handle(corners[i]) : face;
    this->FaceOfNode[child] = childFace;
    this->Mesh.property(this->Element, childFace) = child;
    this->Mesh.set_halfedge_handle(
      childFace, this->FindLeaving(tree[child].corners[0], this->Mesh.halfedge_handle(childFace)));
  }
}

/// Puts a vertex on an edge; returns the halfedge that leaves it in the face of the given one.
HalfedgeHandle PatchMesh::Implementation::SplitEdge(HalfedgeHandle halfedge, const Vec3& point)
{
  const EdgeHandle edge = this->Mesh.edge_handle(halfedge);
  const HalfedgeHandle second = this->Mesh.halfedge_handle(edge, 0);
  const FaceHandle face = this->Mesh.face_handle(second);
  const bool leavesCorner0 = face.is_valid() && this->Mesh.halfedge_handle(face) == second;
  const VertexHandle middle = this->AddVertex(point);
  this->Mesh.split_edge(edge, middle);
  // Of the two halves of `second`, OpenMesh made the first one new.
  const HalfedgeHandle first = this->Mesh.prev_halfedge_handle(second);
  if (leavesCorner0)
  {
    this->Mesh.set_halfedge_handle(face, first);
  }
  this->Mesh.property(this->IsCut, this->Mesh.edge_handle(first)) =
    this->Mesh.property(this->IsCut, edge);
  return halfedge == second ? second : this->Mesh.next_halfedge_handle(halfedge);
}

/// The halfedge of a face that leaves the point. Exact comparison is right: neighbours compute a
/// common midpoint from the same two corners, and the sum of two numbers does not depend on their
/// order. \pre a vertex of the face lies there
HalfedgeHandle PatchMesh::Implementation::FindLeaving(const Vec3& point, HalfedgeHandle start) const
{
  HalfedgeHandle halfedge = start;
  while (this->PointLeft(halfedge) != point)
  {
    halfedge = this->Mesh.next_halfedge_handle(halfedge);
    assert(halfedge != start);
  }
  return halfedge;
}

/// One edge across, a vertex in its middle, and from there an edge to either side.
void PatchMesh::Implementation::SplitQuadrilateral(
  const std::array<HalfedgeHandle, 4>& middles, const Vec3& centre)
{
  const auto before = [this](HalfedgeHandle h) { return this->Mesh.prev_halfedge_handle(h); };
  this->SplitEdge(this->Mesh.insert_edge(before(middles[0]), middles[2]), centre);
  this->Mesh.insert_edge(before(before(middles[0])), middles[1]);
  this->Mesh.insert_edge(before(before(middles[2])), middles[3]);
}

/// Three edges that cut the corners off; the face stays with the middle.
void PatchMesh::Implementation::SplitTriangle(const std::array<HalfedgeHandle, 4>& middles)
{
  std::array<HalfedgeHandle, 3> before; // the halfedges that reach the middles
  for (int i = 0; i < 3; ++i)
  {
    before[i] = this->Mesh.prev_halfedge_handle(middles[i]);
  }
  for (int i = 0; i < 3; ++i)
  {
    this->Mesh.insert_edge(before[i], middles[(i + 2) % 3]);
  }
}

ElementSurface PatchMesh::Implementation::Surface() const
{
  // A corner of a face has the number of the halfedge that leaves it.
  DisjointSets corners(this->Mesh.n_halfedges());
  const auto join = [&corners](HalfedgeHandle a, HalfedgeHandle b)
  { corners.Join(static_cast<std::uint32_t>(a.idx()), static_cast<std::uint32_t>(b.idx())); };
  for (const auto edge : this->Mesh.edges())
  {
    if (this->Mesh.property(this->IsCut, edge) == 0 && !this->Mesh.is_boundary(edge))
    {
      const HalfedgeHandle a = this->Mesh.halfedge_handle(edge, 0);
      const HalfedgeHandle b = this->Mesh.halfedge_handle(edge, 1);
      join(a, this->Mesh.next_halfedge_handle(b));
      join(b, this->Mesh.next_halfedge_handle(a));
    }
  }
  ElementSurface surface;
  std::vector<std::uint32_t> pointOfCorner(this->Mesh.n_halfedges(), None);
  for (NodeId id = 0; id < this->FaceOfNode.size(); ++id)
  {
    const FaceHandle face = this->FaceOfNode[id];
    if (!face.is_valid() || this->Mesh.property(this->Element, face) != id)
    {
      continue;
    }
    for (const auto halfedge : this->Mesh.fh_range(face))
    {
      std::uint32_t& point =
        pointOfCorner[corners.Find(static_cast<std::uint32_t>(halfedge.idx()))];
      if (point == None)
      {
        point = static_cast<std::uint32_t>(surface.points.size());
        surface.points.push_back(this->PointLeft(halfedge));
      }
      surface.indices.push_back(point);
    }
    surface.offsets.push_back(static_cast<std::uint32_t>(surface.indices.size()));
    surface.elements.push_back(id);
  }
  return surface;
}

PatchMesh::PatchMesh(const ElementTree& tree, const FacetSet& facets)
  : Impl(std::make_unique<Implementation>(tree, facets))
{
}

PatchMesh::~PatchMesh() = default;
PatchMesh::PatchMesh(PatchMesh&&) noexcept = default;
PatchMesh& PatchMesh::operator=(PatchMesh&&) noexcept = default;

void PatchMesh::Follow(const ElementTree& tree)
{
  this->Impl->Follow(tree);
}

std::size_t PatchMesh::VertexCount() const
{
  return this->Impl->Mesh.n_vertices();
}

std::size_t PatchMesh::EdgeCount() const
{
  return this->Impl->Mesh.n_edges();
}

std::size_t PatchMesh::FaceCount() const
{
  return this->Impl->Mesh.n_faces();
}

std::size_t PatchMesh::BoundaryEdgeCount() const
{
  std::size_t count = 0;
  for (const auto edge : this->Impl->Mesh.edges())
  {
    count += this->Impl->Mesh.is_boundary(edge) ? 1 : 0;
  }
  return count;
}

ElementSurface PatchMesh::Surface() const
{
  return this->Impl->Surface();
}

} // namespace vantage
