#include "core/view/DirectLight.h"

#include "core/view/LampView.h"

#include <algorithm>

namespace vantage
{

std::vector<Color> DirectLight::At(
  PatchId patch, const std::vector<Vec3>& points, DirectCounters& counters) const
{
  std::vector<Color> irradiance = this->OfNamed(patch, points, counters);
  if (this->Solution->IsActive(patch))
  {
    for (std::size_t i = 0; i < points.size(); ++i)
    {
      const auto leaf = this->Solution->LeafAt(patch, points[i]);
      irradiance[i] += this->Solution->elements[leaf].unnamedDirect;
    }
  }
  return irradiance;
}

std::vector<Color> DirectLight::OfNamed(
  PatchId patch, const std::vector<Vec3>& points, DirectCounters& counters) const
{
  std::vector<Color> irradiance(points.size(), Color(0.0));
  if (!this->Solution->IsActive(patch))
  {
    return irradiance;
  }
  const RadianceSolution& solution = *this->Solution;
  const PatchFrame frame(ShapeOf(*this->Occluders, patch));
  std::vector<RadianceSolution::NodeIndex> leaves(points.size());
  std::vector<Vec2> places(points.size());
  std::vector<PatchId> lamps;
  for (std::size_t i = 0; i < points.size(); ++i)
  {
    leaves[i] = solution.LeafAt(patch, points[i]);
    places[i] = frame.InPlane(points[i]);
    const auto& leaf = solution.elements[leaves[i]];
    if (i == 0 || leaves[i] != leaves[i - 1])
    {
      lamps.insert(lamps.end(), solution.lamps.begin() + leaf.firstLamp,
        solution.lamps.begin() + leaf.lastLamp);
    }
  }
  std::sort(lamps.begin(), lamps.end());
  lamps.erase(std::unique(lamps.begin(), lamps.end()), lamps.end());
  std::vector<LampSpot> spots;
  std::vector<double> factors(points.size());
  for (const PatchId lamp : lamps)
  {
    spots.clear();
    for (std::uint32_t i = 0; i < points.size(); ++i)
    {
      const auto& leaf = solution.elements[leaves[i]];
      if (std::binary_search(
            solution.lamps.begin() + leaf.firstLamp, solution.lamps.begin() + leaf.lastLamp, lamp))
      {
        spots.push_back({ places[i], i });
      }
    }
    const LampView view(
      *this->Occluders, patch / 2, frame, lamp / 2, ShapeOf(*this->Occluders, lamp));
    counters.Add(view.Look(spots.data(), spots.data() + spots.size(), factors.data()));
    for (const LampSpot& spot : spots)
    {
      irradiance[spot.index] += factors[spot.index] * solution.emission[lamp];
    }
  }
  return irradiance;
}

} // namespace vantage
