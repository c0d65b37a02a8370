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

/// A planar convex triangle or quadrilateral without collinear or coincident vertices.
struct Facet
{
  Polygon shape;              ///< counter-clockwise seen from the front
  std::uint32_t scenePolygon; ///< where it came from
  std::uint32_t material;
};

/// What had to be mended on the way.
struct FacetReport
{
  std::size_t weldedVertices = 0;      ///< vertices merged with another one
  std::size_t degeneratePolygons = 0;  ///< dropped: fewer than three distinct corners or no area
  std::size_t nonPlanarPolygons = 0;   ///< triangulated
  std::size_t concavePolygons = 0;     ///< triangulated
  std::size_t largePolygons = 0;       ///< convex with more than four corners: triangulated
  std::size_t duplicatePolygons = 0;   ///< dropped: the same corners as an earlier one
};

/// Facets in an order that depends on geometry only, not on the order of the scene's polygons: all
/// that follows is the same to the bit however the faces were shuffled.
struct FacetSet
{
  std::vector<Facet> facets;
  Vec3 low{ 0.0 };   ///< bounding box
  Vec3 high{ 0.0 };
  double meanArea = 0.0; ///< mean area of a facet: the size that relative tolerances refer to
  FacetReport report;
};

/// Welds vertices closer than `weldTolerance` times the diagonal of the scene, drops what is
/// degenerate, removes collinear vertices, triangulates what is not a flat convex triangle or
/// quadrilateral. A facet keeps the front side and the material of its polygon.
/// O(n log n). \throw InputError when nothing is left.
FacetSet BuildFacets(const Scene& scene, double weldTolerance = 1e-9);

} // namespace vantage
