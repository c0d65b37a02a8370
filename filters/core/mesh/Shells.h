#pragma once

#include "core/mesh/ElementTree.h"
#include "core/mesh/FacetEdges.h"

#include <vector>

/// \file Shells.h
/// Which sides of facets face the same air.

namespace vantage
{

/// For each patch the smallest one of its shell: sides that follow each other around edges, as an
/// ant may walk without passing through a facet. A box that stands alone has two shells, its
/// outside and its inside. A sheet has one, as the way leads around its border; so has a box with a
/// hole, or with a crack. `edges` of the facets. O(n).
std::vector<PatchId> ShellsOf(const FacetSet& facets, const std::vector<FacetEdge>& edges);

} // namespace vantage
