#include "core/mesh/Neighbourhood.h"

#include "core/mesh/TouchingBoxes.h"

#include <functional>
#include <utility>

namespace vantage
{

PackedLists<std::uint32_t> NeighboursOf(const std::vector<Facet>& facets, double tolerance)
{
  std::vector<Box> boxes;
  boxes.reserve(facets.size());
  for (const Facet& facet : facets)
  {
    boxes.emplace_back(facet.shape);
  }
  std::vector<std::pair<std::uint32_t, std::uint32_t>> pairs;
  ForEachTouchingPair(
    boxes, tolerance, [&pairs](std::uint32_t a, std::uint32_t b) { pairs.emplace_back(a, b); });
  PackedLists<std::uint32_t> neighbours(facets.size(),
    [&pairs](const auto& visit)
    {
      for (const auto& [a, b] : pairs)
      {
        visit(a, b);
        visit(b, a);
      }
    });
  neighbours.Sort(std::less<>());
  return neighbours;
}

} // namespace vantage
