#pragma once

#include "core/mesh/ActivePatches.h"
#include "core/mesh/Facets.h"

#include <array>
#include <cstdint>
#include <vector>

/// \file ElementTree.h
/// One tree over everything that exchanges light: clusters above, patches, elements below.

namespace vantage
{

using NodeId = std::uint32_t;
using PatchId = std::uint32_t;

/// One side of one facet. Patch 2 f is the front of facet f, patch 2 f + 1 its back.
struct Patch
{
  NodeId node = None; ///< where it hangs in the tree
  Vec3 normal{ 0.0 }; ///< unit, away from the surface on this side
  std::uint32_t facet = None;
  Side side = Side::Front;

  /// False for a side that exchanges no light (ActivePatches.h): such a patch has no node.
  bool IsActive() const { return this->node != None; }
};

inline PatchId PatchOf(std::uint32_t facet, Side side)
{
  return 2 * facet + static_cast<std::uint32_t>(side);
}

inline Side SideOf(PatchId patch)
{
  return static_cast<Side>(patch % 2);
}

/// A cluster (patch = None), a patch (level 0) or an element of a patch (level > 0). Some clusters
/// are flat: their patches are one surface that was cut (CutSurfaces.h), and have its shape.
struct Node
{
  std::array<Vec3, 4> corners{}; ///< of what has a shape, counter-clockwise from its side
  Vec3 centre{ 0.0 };            ///< centroid; of other clusters: centre of the bounding box
  double radius = 0.0;           ///< all of the node lies within this distance of the centre
  double area = 0.0;             ///< of a cluster: the sum over its patches
  NodeId parent = None;
  NodeId firstChild = None; ///< children have consecutive ids
  PatchId patch = None;
  std::uint8_t childCount = 0;  ///< 0 (leaf), 2 (cluster) or 4 (patch, element)
  std::uint8_t cornerCount = 0; ///< 3 or 4; 0 without a shape
  std::uint8_t level = 0;       ///< subdivisions below the patch
  std::uint8_t bend = 0;        ///< Bend(), in 255 parts

  bool IsLeaf() const { return this->childCount == 0; }
  bool IsCluster() const { return this->patch == None; }
  /// Patches, elements and flat clusters do.
  bool HasShape() const { return this->cornerCount > 0; }
  /// \pre HasShape()
  Polygon Shape() const;
  /// How much normals vary, 0 .. 1: sqrt(1 - m^2), where m is the length of the mean normal. 0 of
  /// what is flat, 1 of clusters whose patches are not all of one curved surface
  /// (CurvedSurfaces.h). By less than 1/255 too large, and never too small up to LargestBend, which
  /// a surface has that looks in all directions.
  double Bend() const { return this->bend / 255.0; }
  static constexpr double LargestBend = 254.0 / 255.0;
  /// Whether it is a surface: flat, or one curved one, or a part of it.
  bool IsSmooth() const { return this->bend < 255; }
  void SetBend(double value);

  /// With centre, radius and area.
  void SetShape(PolygonView shape);
};

/// A quadrilateral gives four quadrilaterals around the mean of its corners, a triangle three at
/// its corners and one in the middle. Corner i of quarter i is corner i of the whole.
std::array<Polygon, 4> Quarters(const Polygon& shape);

/// A parent always has a smaller id than its children, so that sums up and down the tree are two
/// linear loops. Nodes are never removed and never change: elements are only ever added.
class ElementTree
{
public:
  /// Binary clusters over the active patches; a single patch is the root itself. They are split by
  /// centroid and by normal: a patch is sorted by a point of the air in front of it, so that the
  /// two sides of a wall part early and the walls of a room stay together. O(n log n). `materials`
  /// tells which facets are one-sided. \pre there is a facet
  ElementTree(
    const FacetSet& facets, const std::vector<Material>& materials, Sides sides = Sides::Both);
  /// Without what is dark. \pre something is not
  ElementTree(
    const FacetSet& facets, const std::vector<Material>& materials, const DarkSides& dark);

  NodeId Root() const { return 0; }
  NodeId Size() const { return static_cast<NodeId>(this->Nodes.size()); }
  const Node& operator[](NodeId id) const { return this->Nodes[id]; }
  const std::vector<Patch>& Patches() const { return this->AllPatches; }
  const Patch& PatchOfNode(NodeId id) const { return this->AllPatches[this->Nodes[id].patch]; }
  std::size_t LeafElementCount() const { return this->LeafElements; }

  /// \pre it has one
  Polygon Shape(NodeId id) const { return this->Nodes[id].Shape(); }

  /// Makes the four children of a patch or element, its Quarters(), if it has none yet. Returns the
  /// first child's id. References to nodes are invalid afterwards. \pre not a cluster
  NodeId Split(NodeId id);

  /// The child of a split patch or element that holds the point. A point outside goes where the
  /// dividing lines, drawn on beyond the border, put it. \pre the node has children
  NodeId ChildContaining(NodeId id, const Vec3& point) const;

  /// The leaf below a patch or element that holds the point.
  NodeId LeafContaining(NodeId id, const Vec3& point) const;

private:
  ElementTree(const FacetSet& facets, const std::vector<bool>& isActive);

  std::vector<Node> Nodes;
  std::vector<Patch> AllPatches;
  std::size_t LeafElements = 0;
};

} // namespace vantage
