#include "core/view/LampParts.h"

#include "core/mesh/DisjointSets.h"
#include "core/mesh/FacetEdges.h"
#include "core/view/LampSurface.h"

#include <algorithm>

namespace vantage
{

namespace
{

constexpr std::size_t MostFaces = 1024;
constexpr std::uint32_t Nowhere = static_cast<std::uint32_t>(-1);

class PartFinder
{
public:
  PartFinder(const std::vector<TriangleOrQuadrilateral>& shapes,
    const std::function<bool(std::uint32_t, std::uint32_t)>& areAlike)
    : Shapes(shapes)
    , Neighbours(shapes.size())
    , Whole(shapes.size())
    , ConvexPart(shapes.size(), Nowhere)
  {
    for (const TriangleOrQuadrilateral& shape : shapes)
    {
      this->Planes.push_back(SupportingPlane(shape));
      this->Middles.push_back(Centroid(shape));
    }
    this->FindNeighbours(areAlike);
  }

  std::vector<LampPart> Find()
  {
    for (std::uint32_t i = 0; i < this->Shapes.size(); ++i)
    {
      if (this->ConvexPart[i] == Nowhere)
      {
        this->GrowFrom(i);
      }
    }
    std::vector<LampPart> partOf;
    for (std::uint32_t i = 0; i < this->Shapes.size(); ++i)
    {
      partOf.push_back({ this->Whole.Find(i), this->ConvexPart[i] });
    }
    return partOf;
  }

private:
  void FindNeighbours(const std::function<bool(std::uint32_t, std::uint32_t)>& areAlike)
  {
    const auto edges = EdgesOf(static_cast<std::uint32_t>(this->Shapes.size()),
      [this](std::uint32_t i) -> PolygonView { return this->Shapes[i]; });
    const auto startOf = [this](const FacetEdge& edge) -> const Vec3&
    { return this->Shapes[edge.facet][static_cast<int>(edge.corner)]; };
    ForEachEdge(edges,
      [&](const auto first, const auto last)
      {
        for (auto a = first; a != last; ++a)
        {
          for (auto b = first; b != a; ++b)
          {
            if (startOf(*a) != startOf(*b) && areAlike(a->facet, b->facet))
            {
              this->Neighbours[a->facet].push_back(b->facet);
              this->Neighbours[b->facet].push_back(a->facet);
              this->Whole.Join(a->facet, b->facet);
            }
          }
        }
      });
  }

  void GrowFrom(std::uint32_t first)
  {
    std::vector<std::uint32_t> part{ first };
    this->ConvexPart[first] = first;
    for (std::size_t k = 0; k < part.size(); ++k)
    {
      for (const std::uint32_t next : this->Neighbours[part[k]])
      {
        if (this->ConvexPart[next] == Nowhere && part.size() < MostFaces &&
            std::all_of(part.begin(), part.end(),
              [&](std::uint32_t other)
              { return this->IsBehind(next, other) && this->IsBehind(other, next); }))
        {
          this->ConvexPart[next] = first;
          part.push_back(next);
        }
      }
    }
  }

  bool IsBehind(std::uint32_t one, std::uint32_t other) const
  {
    const Plane& plane = this->Planes[other];
    const Vec3& middle = this->Middles[other];
    return std::all_of(this->Shapes[one].begin(), this->Shapes[one].end(),
      [&](const Vec3& corner)
      {
        const double height = plane.Distance(corner);
        return height <= 0.0 || height <= LampSurface::LargestDent * glm::length(corner - middle);
      });
  }

  const std::vector<TriangleOrQuadrilateral>& Shapes;
  std::vector<Plane> Planes;
  std::vector<Vec3> Middles;
  std::vector<std::vector<std::uint32_t>> Neighbours;
  DisjointSets Whole;
  std::vector<std::uint32_t> ConvexPart;
};

} // namespace

std::vector<LampPart> LampPartsOf(const std::vector<TriangleOrQuadrilateral>& shapes,
  const std::function<bool(std::uint32_t, std::uint32_t)>& areAlike)
{
  return PartFinder(shapes, areAlike).Find();
}

} // namespace vantage
