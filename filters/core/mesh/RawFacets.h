#pragma once

#include "core/mesh/Facets.h"

#include <array>
#include <cstdint>
#include <vector>

/// \file RawFacets.h
/// Takes the polygons of a scene apart into triangles and quadrilaterals.

namespace vantage
{

/// Indices of welded points; these are ranks by geometry, so comparing them compares geometry.
using Loop = std::vector<std::uint32_t>;

/// A triangle or quadrilateral before the final order is known.
struct RawFacet
{
  std::array<std::uint32_t, 4> corners{ None, None, None, None };
  std::uint32_t polygon = None;
  std::uint32_t material = None;
  std::uint32_t backPolygon = None; ///< as in Facet
  std::uint32_t backMaterial = None;

  std::array<std::uint32_t, 4> key{ None, None, None, None }; ///< the corners from the smallest on,
                                                              ///< the smaller way round
  bool isReversed = false; ///< that is against the order of `corners`
};

/// Drops what is degenerate, removes collinear vertices, triangulates what is not a flat convex
/// triangle or quadrilateral (see BuildFacets).
class FacetBuilder
{
public:
  /// Keeps a reference to the points.
  FacetBuilder(const std::vector<Vec3>& points, double weldDistance);

  /// A polygon with the corners [first, last).
  void Add(const std::uint32_t* first, const std::uint32_t* last, std::uint32_t polygon,
    std::uint32_t material);

  std::vector<RawFacet> facets;
  FacetReport report;

private:
  void Emit(const Loop& loop, std::uint32_t polygon, std::uint32_t material);

  const std::vector<Vec3>& Points;
  double WeldDistance;
  Loop Corners; ///< of the polygon that is being added
};

} // namespace vantage
