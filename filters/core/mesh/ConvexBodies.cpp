#include "core/mesh/ConvexBodies.h"

#include "core/mesh/DisjointSets.h"
#include "core/mesh/FacetEdges.h"

#include <algorithm>
#include <utility>

namespace vantage
{

namespace
{

constexpr std::size_t MostFacets = 2048;

PatchId OtherSide(PatchId patch)
{
  return patch ^ 1u;
}

/// The facets of one closed body, seen from outside.
class BodyFacets
{
public:
  BodyFacets(const FacetSet& set, const std::vector<PatchId>& facets)
  {
    for (const PatchId facet : facets)
    {
      const TriangleOrQuadrilateral& shape = set.facets[facet / 2].shape;
      this->Shapes.push_back(facet % 2 == 0 ? shape : Reversed(shape));
      this->Planes.push_back(SupportingPlane(this->Shapes.back()));
      this->Middles.push_back(Centroid(this->Shapes.back()));
    }
  }

  bool AreConvex() const
  {
    for (std::uint32_t a = 0; a < this->Shapes.size(); ++a)
    {
      for (std::uint32_t b = 0; b < this->Shapes.size(); ++b)
      {
        if (this->RangeOver(a, b).second > ConvexBodies::LargestDent)
        {
          return false;
        }
      }
    }
    return true;
  }

  /// Finds the edges between sides, and sides: of each the first facet, in `sides`. False when some
  /// facet has no other one beside it, or several.
  bool FindEdges(std::vector<ConvexBodies::Edge>& edges, std::vector<std::uint32_t>& sides) const
  {
    const std::vector<FacetEdge> halves = EdgesOf(static_cast<std::uint32_t>(this->Shapes.size()),
      [this](std::uint32_t facet) -> PolygonView { return this->Shapes[facet]; });
    DisjointSets joined(this->Shapes.size());
    bool areAllPairs = true;
    ForEachEdge(halves,
      [&](const auto first, const auto last)
      {
        areAllPairs = areAllPairs && last - first == 2;
        const std::uint32_t other = (last - 1)->facet;
        edges.push_back({ 0, other, first->facet, first->corner });
        if (this->AreInOnePlane(first->facet, other))
        {
          joined.Join(first->facet, other);
        }
      });
    std::vector<std::uint32_t> sideOf(this->Shapes.size());
    for (std::uint32_t facet = 0; facet < this->Shapes.size(); ++facet)
    {
      const std::uint32_t representative = joined.Find(facet);
      if (representative == facet)
      {
        sideOf[facet] = static_cast<std::uint32_t>(sides.size());
        sides.push_back(facet);
      }
      sideOf[facet] = sideOf[representative]; // which comes first
    }
    for (ConvexBodies::Edge& edge : edges)
    {
      edge.first = sideOf[edge.facet];
      edge.second = sideOf[edge.second];
    }
    edges.erase(std::remove_if(edges.begin(), edges.end(),
                  [](const ConvexBodies::Edge& edge) { return edge.first == edge.second; }),
      edges.end());
    return areAllPairs;
  }

private:
  /// How far the corners of one facet are in front of the plane of another one, at least and at
  /// most, over their distance from its middle.
  std::pair<double, double> RangeOver(std::uint32_t plane, std::uint32_t facet) const
  {
    std::pair<double, double> range(0.0, 0.0);
    for (const Vec3& corner : this->Shapes[facet])
    {
      const double height = this->Planes[plane].Distance(corner);
      const double distance = glm::length(corner - this->Middles[plane]);
      const double relative = height == 0.0 ? 0.0 : height / distance;
      range = { std::min(range.first, relative), std::max(range.second, relative) };
    }
    return range;
  }

  bool AreInOnePlane(std::uint32_t a, std::uint32_t b) const
  {
    return this->RangeOver(a, b).first >= -ConvexBodies::LargestDent &&
           this->RangeOver(b, a).first >= -ConvexBodies::LargestDent;
  }

  std::vector<TriangleOrQuadrilateral> Shapes;
  std::vector<Plane> Planes;
  std::vector<Vec3> Middles;
};

} // namespace

ConvexBodies::ConvexBodies(const FacetSet& facets, const DarkSides& dark)
{
  std::vector<std::vector<PatchId>> facetsOf(dark.bodies.size());
  for (PatchId patch = 0; patch < dark.bodyOf.size(); ++patch)
  {
    if (dark.bodyOf[patch] != None)
    {
      facetsOf[dark.bodyOf[patch]].push_back(OtherSide(patch));
    }
  }
  for (const std::vector<PatchId>& ofBody : facetsOf)
  {
    this->Add(facets, ofBody);
    this->FirstFacet.push_back(static_cast<std::uint32_t>(this->Facets.size()));
    this->FirstSide.push_back(static_cast<std::uint32_t>(this->Sides.size()));
    this->FirstEdge.push_back(static_cast<std::uint32_t>(this->Edges.size()));
  }
}

void ConvexBodies::Add(const FacetSet& set, const std::vector<PatchId>& facets)
{
  if (facets.size() > MostFacets)
  {
    return;
  }
  const BodyFacets body(set, facets);
  std::vector<Edge> edges;
  std::vector<std::uint32_t> sides;
  if (body.AreConvex() && body.FindEdges(edges, sides))
  {
    this->Facets.insert(this->Facets.end(), facets.begin(), facets.end());
    this->Sides.insert(this->Sides.end(), sides.begin(), sides.end());
    this->Edges.insert(this->Edges.end(), edges.begin(), edges.end());
  }
}

} // namespace vantage
