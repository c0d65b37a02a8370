#pragma once

#include "core/mesh/ElementTree.h"

#include <cstdint>
#include <memory>
#include <vector>

/// \file PatchMesh.h
/// The leaf elements as one half-edge mesh without cracks (OpenMesh).

namespace vantage
{

/// The leaf elements as polygons over shared points, ready to be drawn or interpolated on. Points
/// are shared between joined neighbours and doubled where radiance is not continuous: at creases of
/// more than 5 degrees, where materials meet, and where the front of one polygon meets the back of
/// another.
struct ElementSurface
{
  std::vector<Vec3> points;
  std::vector<std::uint32_t> indices;
  std::vector<std::uint32_t> offsets{ 0 };
  std::vector<NodeId> elements; ///< the leaf element each polygon is, ascending

  std::size_t PolygonCount() const { return this->elements.size(); }
};

/// Half-edge mesh of leaf elements. Patches that bound the same air along an edge are joined there
/// (around an edge with many walls, each side with the next one in angle; at a free edge, the two
/// sides of one wall), so that the mesh is manifold for any scene, and closed where all sides are
/// active; splitting an element inserts the midpoints of its edges into the neighbours' polygons
/// too. Only whole edges are joined: a wall that stands in the middle of a floor polygon is not.
class PatchMesh
{
public:
  /// Joins the active patches of the tree, then replays all splits the tree has. O(n log n) for n
  /// patches; a split is linear in the number of vertices on the border of its element.
  PatchMesh(const ElementTree& tree, const FacetSet& facets);
  ~PatchMesh();
  PatchMesh(PatchMesh&&) noexcept;
  PatchMesh& operator=(PatchMesh&&) noexcept;

  /// Replays the splits that were made in the tree since. \pre it is the tree of the constructor,
  /// or a copy of it that was split further
  void Follow(const ElementTree& tree);

  std::size_t VertexCount() const;
  std::size_t EdgeCount() const;
  std::size_t FaceCount() const;
  /// Number of edges with a face on one side only.
  std::size_t BoundaryEdgeCount() const;

  /// The mesh cut open where radiance is not continuous. A polygon starts at corner 0 of its
  /// element and has a point wherever a joined neighbour has a vertex on its border. O(mesh).
  ElementSurface Surface() const;

private:
  struct Implementation;
  std::unique_ptr<Implementation> Impl;
};

/// Mean of element values at each point of a surface, weighted by the angle of the element's
/// corner there. `valueOfPolygon` has one entry for each polygon of the surface. O(corners).
std::vector<Color> PointValues(
  const ElementSurface& surface, const std::vector<Color>& valueOfPolygon);

} // namespace vantage
