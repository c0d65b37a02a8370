#include "core/mesh/ActivePatches.h"

#include "core/mesh/DarkSides.h"
#include "core/mesh/ElementTree.h"

#include <algorithm>

namespace vantage
{

std::vector<bool> ActivePatches(const FacetSet& facets, const std::vector<FacetEdge>& edges,
  const std::vector<Material>& materials, Sides sides)
{
  std::vector<bool> isActive(2 * facets.facets.size());
  for (PatchId id = 0; id < isActive.size(); ++id)
  {
    const Facet& facet = facets.facets[id / 2];
    isActive[id] = facet.IsPolygonFront(SideOf(id)) ||
                   (sides != Sides::FrontOnly && materials[facet.material].twoSided);
  }
  if (sides == Sides::Lit)
  {
    const std::vector<bool> isDark = DarkSides(facets, edges, materials);
    std::transform(isActive.begin(), isActive.end(), isDark.begin(), isActive.begin(),
      [](bool active, bool dark) { return active && !dark; });
  }
  return isActive;
}

} // namespace vantage
