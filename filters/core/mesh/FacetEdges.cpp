#include "core/mesh/FacetEdges.h"

#include "core/mesh/Numbering.h"
#include "core/mesh/PackedLists.h"

#include <tuple>

namespace vantage
{

namespace
{

std::uint64_t HashOf(const Vec3& corner)
{
  return HashOfPoint()(corner + Vec3(0.0)); // there is one zero only
}

} // namespace

std::vector<FacetEdge> EdgesOf(const std::vector<Facet>& facets)
{
  const auto forEachEdge = [&facets](const auto& visit)
  {
    for (std::uint32_t f = 0; f < facets.size(); ++f)
    {
      const TriangleOrQuadrilateral& shape = facets[f].shape;
      const int count = shape.Size();
      std::uint64_t before = HashOf(shape[count - 1]);
      for (int i = 0; i < count; ++i)
      {
        const std::uint64_t here = HashOf(shape[i]);
        visit(FacetEdge{ before + here, f, static_cast<std::uint32_t>((i + count - 1) % count) });
        before = here;
      }
    }
  };
  const std::size_t buckets = facets.size() / 16 + 1; // as many as the nearest memory has room for
  return BucketSorted<FacetEdge>(
    buckets, forEachEdge,
    [buckets](const FacetEdge& edge)
    { return static_cast<std::uint32_t>((edge.edge >> 32) * buckets >> 32); },
    [](const FacetEdge& a, const FacetEdge& b)
    { return std::tie(a.edge, a.facet) < std::tie(b.edge, b.facet); });
}

} // namespace vantage
