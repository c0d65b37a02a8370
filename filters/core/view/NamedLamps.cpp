#include "core/view/NamedLamps.h"

#include "core/view/LampParts.h"

#include <algorithm>
#include <map>
#include <utility>

namespace vantage
{

namespace
{

/// All patches that are named, and the surfaces that they are part of.
class LampSurfaces
{
public:
  LampSurfaces(const OccluderScene& occluders, const RadianceSolution& solution)
    : Patches(solution.lamps)
  {
    std::sort(this->Patches.begin(), this->Patches.end());
    this->Patches.erase(
      std::unique(this->Patches.begin(), this->Patches.end()), this->Patches.end());
    std::vector<TriangleOrQuadrilateral> shapes;
    for (const PatchId patch : this->Patches)
    {
      shapes.emplace_back(PolygonView(ShapeOf(occluders, patch)));
    }
    this->Parts = LampPartsOf(shapes, [&](std::uint32_t a, std::uint32_t b)
      { return solution.emission[this->Patches[a]] == solution.emission[this->Patches[b]]; });
    this->OfConvex.resize(this->Patches.size());
    this->OfWhole.resize(this->Patches.size());
    for (std::uint32_t k = 0; k < this->Patches.size(); ++k)
    {
      this->OfConvex[this->Parts[k].convex].push_back(this->Patches[k] / 2);
      this->OfWhole[this->Parts[k].whole].push_back(this->Patches[k] / 2);
    }
  }

  const LampPart& Of(PatchId patch) const
  {
    const auto place = std::lower_bound(this->Patches.begin(), this->Patches.end(), patch);
    return this->Parts[static_cast<std::size_t>(place - this->Patches.begin())];
  }
  NamedLamp Make(const std::vector<PatchId>& patches, const OccluderScene& occluders,
    const RadianceSolution& solution) const
  {
    const LampPart& part = this->Of(patches[0]);
    NamedLamp lamp;
    lamp.patches = patches;
    for (const PatchId patch : patches)
    {
      lamp.shapes.push_back(ShapeOf(occluders, patch));
    }
    lamp.surface = LampSurface(lamp.shapes);
    lamp.emission = solution.emission[patches[0]];
    lamp.convexPart = this->OfConvex[part.convex];
    lamp.whole = this->OfWhole[part.whole];
    return lamp;
  }

private:
  std::vector<PatchId> Patches;                     ///< ascending
  std::vector<LampPart> Parts;                      ///< of each of these
  std::vector<std::vector<std::uint32_t>> OfConvex; ///< facets
  std::vector<std::vector<std::uint32_t>> OfWhole;
};

bool Contains(const std::vector<std::uint32_t>& ascending, std::uint32_t value)
{
  return std::binary_search(ascending.begin(), ascending.end(), value);
}

} // namespace

bool NamedLamp::IsOfConvexPart(std::uint32_t facet) const
{
  return Contains(this->convexPart, facet);
}

bool NamedLamp::IsOfWhole(std::uint32_t facet) const
{
  return Contains(this->whole, facet);
}

NamedLamps::NamedLamps(const OccluderScene& occluders, const RadianceSolution& solution)
  : Lists(1)
  , ListOfElement(solution.elements.size(), 0)
{
  const LampSurfaces surfaces(occluders, solution);
  std::map<std::vector<PatchId>, std::uint32_t> knownLamps;
  const auto lampOf = [&](const std::vector<PatchId>& patches)
  {
    const auto [known, isNew] = knownLamps.try_emplace(patches, this->Size());
    if (isNew)
    {
      this->Lamps.push_back(surfaces.Make(patches, occluders, solution));
    }
    return known->second;
  };
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> knownLists;
  for (RadianceSolution::NodeIndex id = 0; id < solution.elements.size(); ++id)
  {
    const RadianceSolution::Element& element = solution.elements[id];
    if (element.firstLamp == element.lastLamp)
    {
      continue;
    }
    const auto [known, isNew] = knownLists.try_emplace(
      { element.firstLamp, element.lastLamp }, static_cast<std::uint32_t>(this->Lists.size()));
    this->ListOfElement[id] = known->second;
    if (isNew)
    {
      std::map<std::uint32_t, std::vector<PatchId>> byPart;
      for (std::uint32_t k = element.firstLamp; k < element.lastLamp; ++k)
      {
        byPart[surfaces.Of(solution.lamps[k]).convex].push_back(solution.lamps[k]);
      }
      List& list = this->Lists.emplace_back();
      for (const auto& [part, patches] : byPart)
      {
        list.push_back(lampOf(patches));
      }
      std::sort(list.begin(), list.end());
    }
  }
}

} // namespace vantage
