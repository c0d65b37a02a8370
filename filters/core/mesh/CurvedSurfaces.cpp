#include "core/mesh/CurvedSurfaces.h"

#include "core/mesh/DisjointSets.h"

#include <algorithm>
#include <cmath>

namespace vantage
{

namespace
{

constexpr double SmoothEdge = 0.85; ///< cosine: a tube of twelve strips is smooth, of ten it is not

Side Opposite(Side side)
{
  return side == Side::Front ? Side::Back : Side::Front;
}

const Vec3& StartOf(const FacetSet& facets, const FacetEdge& edge)
{
  return facets.facets[edge.facet].shape[static_cast<int>(edge.corner)];
}

/// What is known of the patches below a node.
struct Below
{
  Vec3 areaNormal{ 0.0 };
  PatchId surface = None; ///< that all are part of, or None
};

} // namespace

std::vector<PatchId> CurvedSurfacesOf(
  const FacetSet& facets, const std::vector<FacetEdge>& edges, const std::vector<Patch>& patches)
{
  DisjointSets surfaces(patches.size());
  const auto joinAt = [&](const FacetEdge& a, const FacetEdge& b)
  {
    // Neighbours that face the same way run along their edge in opposite directions.
    const bool areAlike = StartOf(facets, a) != StartOf(facets, b);
    for (const Side side : { Side::Front, Side::Back })
    {
      const Side other = areAlike ? side : Opposite(side);
      const PatchId first = PatchOf(a.facet, side);
      const PatchId second = PatchOf(b.facet, other);
      if (glm::dot(patches[first].normal, patches[second].normal) > SmoothEdge &&
          facets.facets[a.facet].MaterialOf(side) == facets.facets[b.facet].MaterialOf(other))
      {
        surfaces.Join(first, second);
      }
    }
  };
  ForEachEdge(edges,
    [&](const auto first, const auto last)
    {
      if (last - first == 2)
      {
        joinAt(first[0], first[1]);
      }
    });
  std::vector<PatchId> surfaceOf(patches.size());
  for (PatchId id = 0; id < surfaceOf.size(); ++id)
  {
    surfaceOf[id] = surfaces.Find(id);
  }
  return surfaceOf;
}

NodeId SurfaceAbove(const ElementTree& tree, NodeId patch)
{
  NodeId surface = patch;
  while (tree[surface].parent != None && tree[tree[surface].parent].IsSmooth())
  {
    surface = tree[surface].parent;
  }
  return surface;
}

void FindBends(std::vector<Node>& nodes, const std::vector<Patch>& patches,
  const std::vector<PatchId>& surfaceOf)
{
  std::vector<Below> below(nodes.size());
  for (std::size_t id = nodes.size(); id-- > 0;)
  {
    Node& node = nodes[id];
    if (!node.IsCluster())
    {
      below[id] = { node.area * patches[node.patch].normal, surfaceOf[node.patch] };
      continue;
    }
    const Below& first = below[node.firstChild];
    const Below& second = below[node.firstChild + 1];
    below[id].areaNormal = first.areaNormal + second.areaNormal;
    below[id].surface = first.surface == second.surface ? first.surface : None;
    const double mean = glm::length(below[id].areaNormal) / node.area;
    const double sine = std::sqrt(std::max(0.0, 1.0 - mean * mean));
    node.SetBend(below[id].surface != None ? std::min(sine, Node::LargestBend) : 1.0);
  }
}

} // namespace vantage
