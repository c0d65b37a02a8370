#pragma once

#include "core/mesh/ElementTree.h"
#include "core/mesh/FacetEdges.h"

#include <vector>

/// \file CurvedSurfaces.h
/// Recognises what was one curved surface before a modeller cut it into facets.

namespace vantage
{

/// For each patch the smallest one of its curved surface: sides of one material that share edges,
/// each with the next, and turn by less than 32 degrees there. Where a third facet meets the edge
/// they are two. What is flat is curved as well, by nothing. `edges` of the facets. O(n).
std::vector<PatchId> CurvedSurfacesOf(
  const FacetSet& facets, const std::vector<FacetEdge>& edges, const std::vector<Patch>& patches);

/// The largest node that is one surface (Node::IsSmooth) and holds a patch of the node `patch`.
/// O(depth).
NodeId SurfaceAbove(const ElementTree& tree, NodeId patch);

/// Finds Node::bend of all clusters. `surfaceOf` each patch: what CurvedSurfacesOf() gives.
/// O(nodes). \pre clusters have their areas
void FindBends(std::vector<Node>& nodes, const std::vector<Patch>& patches,
  const std::vector<PatchId>& surfaceOf);

} // namespace vantage
