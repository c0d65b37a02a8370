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

std::vector<FacetEdge> EdgesOf(
  std::uint32_t count, const std::function<PolygonView(std::uint32_t)>& shapeOf)
{
  const auto forEachEdge = [&](const auto& visit)
  {
    for (std::uint32_t facet = 0; facet < count; ++facet)
    {
      const PolygonView shape = shapeOf(facet);
      const int corners = shape.Size();
      std::uint64_t before = HashOf(shape[corners - 1]);
      for (int i = 0; i < corners; ++i)
      {
        const std::uint64_t here = HashOf(shape[i]);
        const auto start = static_cast<std::uint32_t>((i + corners - 1) % corners);
        visit(FacetEdge{ before + here, facet, start });
        before = here;
      }
    }
  };
  const std::size_t buckets = count / 16 + 1; // as many as the nearest memory has room for
  return BucketSorted<FacetEdge>(
    buckets, forEachEdge,
    [buckets](const FacetEdge& edge)
    { return static_cast<std::uint32_t>((edge.edge >> 32) * buckets >> 32); },
    [](const FacetEdge& a, const FacetEdge& b)
    { return std::tie(a.edge, a.facet) < std::tie(b.edge, b.facet); });
}

} // namespace vantage
