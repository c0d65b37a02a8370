#pragma once

#include "core/math/Polygon.h"
#include "core/scene/Scene.h"

#include <cstdint>
#include <vector>

/// \file Facets.h
/// From the polygons of a scene, as people make them, to clean flat facets: the geometry that
/// occludes and carries the patches.

namespace vantage
{

/// No polygon, facet, patch or node.
inline constexpr std::uint32_t None = 0xffffffffu;

enum class Side : std::uint8_t
{
  Front = 0,
  Back = 1
};

/// A planar convex triangle or quadrilateral without collinear or coincident vertices. Both its
/// sides belong to one polygon of the scene, unless two polygons lie back to back: they become one
/// facet, so that there is one occluder, and each side is the front of its own polygon.
struct Facet
{
  TriangleOrQuadrilateral shape; ///< counter-clockwise seen from the front
  std::uint32_t scenePolygon;    ///< where it came from
  std::uint32_t material;
  std::uint32_t backPolygon = None;  ///< whose front the back side is, if there are two polygons
  std::uint32_t backMaterial = None; ///< of that polygon

  /// Whether this side is the front of a polygon of the scene: only there is emission.
  bool IsPolygonFront(Side side) const { return side == Side::Front || this->backPolygon != None; }
  std::uint32_t ScenePolygonOf(Side side) const
  {
    return side == Side::Back && this->backPolygon != None ? this->backPolygon : this->scenePolygon;
  }
  std::uint32_t MaterialOf(Side side) const
  {
    return side == Side::Back && this->backPolygon != None ? this->backMaterial : this->material;
  }
};

/// What had to be mended on the way.
struct FacetReport
{
  std::size_t weldedVertices = 0;     ///< moved onto another one close by (equal ones do not count)
  std::size_t degeneratePolygons = 0; ///< dropped: fewer than three distinct corners or no area
  std::size_t nonPlanarPolygons = 0;  ///< triangulated
  std::size_t concavePolygons = 0;    ///< flat, triangulated
  std::size_t largePolygons = 0;      ///< flat, convex, more than four corners: triangulated
  std::size_t duplicateFacets = 0;    ///< dropped: the same corners and front as another one
  std::size_t mergedFacets = 0;       ///< that lay back to back with another one: two became one
};

/// Facets in an order that depends on geometry only, not on the order of the scene's polygons or
/// vertices, nor on where the scene is and how it is turned (unless it is symmetric): all that
/// follows is the same to the bit however they were shuffled (only the numbers of the scene
/// polygons are others). The first corner of a triangle or convex quadrilateral is the first that
/// its polygon has.
struct FacetSet
{
  std::vector<Facet> facets;
  Vec3 low{ 0.0 }; ///< bounding box
  Vec3 high{ 0.0 };
  double meanArea = 0.0; ///< mean area of a facet: the size that relative tolerances refer to
  FacetReport report;

  /// Length below which two things touch: 1e-9 of the diagonal of the scene plus the rounding of
  /// its coordinates (which counts when the scene lies far from the origin).
  double Tolerance() const;
};

/// The shapes alone, packed.
class FacetShapes
{
public:
  explicit FacetShapes(const std::vector<Facet>& facets);

  std::uint32_t Size() const { return static_cast<std::uint32_t>(this->Starts.size() - 1); }
  PolygonView operator[](std::uint32_t facet) const
  {
    const std::uint32_t start = this->Starts[facet];
    return { this->Corners.data() + start, static_cast<int>(this->Starts[facet + 1] - start) };
  }

private:
  std::vector<Vec3> Corners;
  std::vector<std::uint32_t> Starts; ///< of each facet in Corners, and the end
};

/// Welds vertices closer than `weldTolerance` times the diagonal of the scene, drops what is
/// degenerate, removes collinear vertices, triangulates what is not a flat convex triangle or
/// quadrilateral. A facet keeps the front side and the material of its polygon; of facets with the
/// same corners and the same front, the one with the lowest material number stays. Facets that
/// overlap in part of their plane are left as they are.
/// Flat means within 1e-5 of the polygon's size, collinear within 1e-6 of it: what single precision
/// and text files leave of a flat polygon.
/// O(n log n), and O(k^2) for a polygon of k corners that is triangulated.
/// \throw InputError for a scene that is not valid, a tolerance outside [0, 0.1], a diagonal
/// outside [1e-70, 1e75], or when nothing is left.
FacetSet BuildFacets(const Scene& scene, double weldTolerance = 1e-9);

} // namespace vantage
