#include "core/view/DirectLight.h"

#include "core/view/LampView.h"

#include <algorithm>

namespace vantage
{

std::vector<Color> DirectLight::At(
  PatchId patch, const std::vector<Vec3>& points, DirectCounters& counters) const
{
  const std::vector<RadianceSolution::NodeIndex> leaves = this->LeavesAt(patch, points);
  std::vector<Color> irradiance = this->OfNamed(patch, points, leaves, counters);
  for (std::size_t i = 0; i < leaves.size(); ++i)
  {
    irradiance[i] += this->Solution->elements[leaves[i]].unnamedDirect;
  }
  return irradiance;
}

std::vector<Color> DirectLight::OfNamed(
  PatchId patch, const std::vector<Vec3>& points, DirectCounters& counters) const
{
  return this->OfNamed(patch, points, this->LeavesAt(patch, points), counters);
}

/// None on an inactive side.
std::vector<RadianceSolution::NodeIndex> DirectLight::LeavesAt(
  PatchId patch, const std::vector<Vec3>& points) const
{
  std::vector<RadianceSolution::NodeIndex> leaves;
  if (this->Solution->IsActive(patch))
  {
    leaves.reserve(points.size());
    for (const Vec3& point : points)
    {
      leaves.push_back(this->Solution->LeafAt(patch, point));
    }
  }
  return leaves;
}

std::vector<Color> DirectLight::OfNamed(PatchId patch, const std::vector<Vec3>& points,
  const std::vector<RadianceSolution::NodeIndex>& leaves, DirectCounters& counters) const
{
  std::vector<Color> irradiance(points.size(), Color(0.0));
  if (leaves.empty())
  {
    return irradiance;
  }
  const PatchFrame frame(ShapeOf(*this->Occluders, patch));
  std::vector<Vec2> places(points.size());
  NamedLamps::List lamps;
  for (std::size_t i = 0; i < points.size(); ++i)
  {
    places[i] = frame.InPlane(points[i]);
    if (i == 0 || leaves[i] != leaves[i - 1])
    {
      const NamedLamps::List& ofLeaf = this->Lamps.Of(leaves[i]);
      lamps.insert(lamps.end(), ofLeaf.begin(), ofLeaf.end());
    }
  }
  std::sort(lamps.begin(), lamps.end());
  lamps.erase(std::unique(lamps.begin(), lamps.end()), lamps.end());
  std::vector<LampSpot> spots;
  std::vector<double> factors(points.size());
  for (const std::uint32_t lamp : lamps)
  {
    spots.clear();
    for (std::uint32_t i = 0; i < points.size(); ++i)
    {
      const NamedLamps::List& ofLeaf = this->Lamps.Of(leaves[i]);
      if (std::binary_search(ofLeaf.begin(), ofLeaf.end(), lamp))
      {
        spots.push_back({ places[i], i });
      }
    }
    const NamedLamp& named = this->Lamps[lamp];
    const LampView view(*this->Occluders, patch / 2, frame, named);
    counters.Add(
      view.Look(spots.data(), spots.data() + spots.size(), this->Tolerance, factors.data()));
    for (const LampSpot& spot : spots)
    {
      irradiance[spot.index] += factors[spot.index] * named.emission;
    }
  }
  return irradiance;
}

} // namespace vantage
