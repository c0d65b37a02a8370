#include "core/mesh/ConvexBodies.h"

#include "core/mesh/FacetEdges.h"

#include <algorithm>

namespace vantage
{

namespace
{

constexpr std::size_t MostFaces = 2048;

PatchId OtherSide(PatchId patch)
{
  return patch ^ 1u;
}

/// The faces of one closed body, seen from outside.
class BodyFaces
{
public:
  BodyFaces(const FacetSet& facets, const std::vector<PatchId>& faces)
  {
    for (const PatchId face : faces)
    {
      const TriangleOrQuadrilateral& shape = facets.facets[face / 2].shape;
      this->Shapes.push_back(face % 2 == 0 ? shape : Reversed(shape));
    }
  }

  bool AreConvex() const
  {
    return std::all_of(this->Shapes.begin(), this->Shapes.end(),
      [this](const TriangleOrQuadrilateral& face)
      {
        const Plane plane = SupportingPlane(face);
        const Vec3 middle = Centroid(face);
        return std::all_of(this->Shapes.begin(), this->Shapes.end(),
          [&](const TriangleOrQuadrilateral& other) { return IsBehind(other, plane, middle); });
      });
  }

  /// Each edge once; none when some face has no other one beside it, or several.
  std::vector<ConvexBodies::Edge> Edges() const
  {
    const std::vector<FacetEdge> halves =
      vantage::EdgesOf(static_cast<std::uint32_t>(this->Shapes.size()),
        [this](std::uint32_t face) -> PolygonView { return this->Shapes[face]; });
    std::vector<ConvexBodies::Edge> edges;
    bool areAllPairs = true;
    ForEachEdge(halves,
      [&](const auto first, const auto last)
      {
        areAllPairs = areAllPairs && last - first == 2;
        edges.push_back({ first->facet, (last - 1)->facet, first->corner });
      });
    return areAllPairs ? edges : std::vector<ConvexBodies::Edge>();
  }

private:
  static bool IsBehind(PolygonView shape, const Plane& plane, const Vec3& middle)
  {
    return std::all_of(shape.begin(), shape.end(),
      [&](const Vec3& corner)
      {
        const double height = plane.Distance(corner);
        return height <= 0.0 || height <= ConvexBodies::LargestDent * glm::length(corner - middle);
      });
  }

  std::vector<TriangleOrQuadrilateral> Shapes;
};

} // namespace

ConvexBodies::ConvexBodies(const FacetSet& facets, const DarkSides& dark)
{
  std::vector<std::vector<PatchId>> faces(dark.bodies.size());
  for (PatchId patch = 0; patch < dark.bodyOf.size(); ++patch)
  {
    if (dark.bodyOf[patch] != None)
    {
      faces[dark.bodyOf[patch]].push_back(OtherSide(patch));
    }
  }
  for (const std::vector<PatchId>& ofBody : faces)
  {
    this->Add(facets, ofBody);
    this->FirstFace.push_back(static_cast<std::uint32_t>(this->Faces.size()));
    this->FirstEdge.push_back(static_cast<std::uint32_t>(this->Edges.size()));
  }
}

void ConvexBodies::Add(const FacetSet& facets, const std::vector<PatchId>& faces)
{
  const BodyFaces body(facets, faces);
  if (faces.size() > MostFaces || !body.AreConvex())
  {
    return;
  }
  const std::vector<Edge> edges = body.Edges();
  if (!edges.empty())
  {
    this->Faces.insert(this->Faces.end(), faces.begin(), faces.end());
    this->Edges.insert(this->Edges.end(), edges.begin(), edges.end());
  }
}

} // namespace vantage
