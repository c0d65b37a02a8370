#include "core/mesh/ActivePatches.h"

#include "core/mesh/DarkSides.h"
#include "core/mesh/ElementTree.h"

namespace vantage
{

std::vector<bool> ActivePatches(
  const FacetSet& facets, const std::vector<Material>& materials, Sides sides)
{
  std::vector<bool> isActive(2 * facets.facets.size());
  for (PatchId id = 0; id < isActive.size(); ++id)
  {
    const Facet& facet = facets.facets[id / 2];
    isActive[id] = facet.IsPolygonFront(SideOf(id)) ||
                   (sides == Sides::Both && materials[facet.material].twoSided);
  }
  return isActive;
}

std::vector<bool> ActivePatches(
  const FacetSet& facets, const std::vector<Material>& materials, const DarkSides& dark)
{
  std::vector<bool> isActive = ActivePatches(facets, materials);
  for (PatchId id = 0; id < isActive.size(); ++id)
  {
    isActive[id] = isActive[id] && !dark[id];
  }
  return isActive;
}

} // namespace vantage
