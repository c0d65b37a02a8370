#pragma once

#include "core/mesh/ElementTree.h"
#include "core/mesh/FacetEdges.h"

#include <vector>

/// \file CutSurfaces.h
/// Recognises what was one surface before a modeller, or vtkPatchSubdivision, cut it.

namespace vantage
{

/// For each facet the number of the surface that it is part of: facets in one plane that look the
/// same and share edges, each with the next. Where a third one meets the edge, they are two: the
/// floors of two rooms are, as a wall stands between them. Numbers ascend by the first facet.
/// `edges` of the facets. O(n).
std::vector<std::uint32_t> SurfacesOf(
  const FacetSet& facets, const std::vector<FacetEdge>& edges, const std::vector<Patch>& patches);

/// Gives a shape to each cluster at or below `root` whose patches together are a triangle or a
/// convex quadrilateral without gaps: it exchanges light as one polygon. Gaps of a millionth of the
/// area are let pass. O(nodes below).
/// \pre all patches below are of one side of one surface and have their shapes
void ShapeFlatClusters(std::vector<Node>& nodes, NodeId root, const Vec3& normal, double tolerance);

} // namespace vantage
