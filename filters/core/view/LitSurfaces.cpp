#include "core/view/LitSurfaces.h"

#include "core/formfactor/FormFactor.h"
#include "core/math/ScrambledSobol.h"

#include <algorithm>
#include <cmath>

namespace vantage
{

namespace
{

/// A lamp whose centre is below the horizon, or turned away, may still be seen in part.
constexpr double LeastCosine = 0.05;

} // namespace

LitSurfaces::LitSurfaces(const OccluderScene& occluders, const RadianceSolution& solution)
  : Occluders(&occluders)
  , Solution(&solution)
{
  this->OfElements.reserve(solution.elements.size());
  for (const RadianceSolution::Element& element : solution.elements)
  {
    this->OfElements.push_back(element.indirect);
  }
  std::vector<PatchId> patches = solution.lamps;
  std::sort(patches.begin(), patches.end());
  patches.erase(std::unique(patches.begin(), patches.end()), patches.end());
  for (const PatchId patch : patches)
  {
    Lamp lamp;
    lamp.shape = ShapeOf(occluders, patch);
    lamp.centre = Centroid(lamp.shape);
    lamp.normal = UnitNormal(lamp.shape);
    lamp.area = Area(lamp.shape);
    lamp.facet = patch / 2;
    lamp.emission = solution.emission[patch];
    this->Lamps.push_back(lamp);
  }
  for (const PatchId patch : solution.lamps)
  {
    this->LampOfEntry.push_back(static_cast<std::uint32_t>(
      std::lower_bound(patches.begin(), patches.end(), patch) - patches.begin()));
  }
}

LitRadiance LitSurfaces::Radiance(
  const Hit& hit, std::uint32_t index, std::uint64_t seed, std::uint64_t& shadowRays) const
{
  const RadianceSolution& solution = *this->Solution;
  const PatchId patch = hit.Patch();
  if (!solution.IsActive(patch))
  {
    return {};
  }
  const RadianceSolution::NodeIndex leaf = solution.LeafAt(patch, hit.point);
  const RadianceSolution::Element& element = solution.elements[leaf];
  if (element.firstLamp == element.lastLamp)
  {
    return { Color(0.0), this->OfElements[leaf] };
  }
  const LitPoint point{ { hit.point, hit.facet }, NormalOf(*this->Occluders, patch) };
  Color irradiance(0.0);
  if (element.lastLamp - element.firstLamp > MostLamps)
  {
    irradiance =
      this->FromSome(point, element.firstLamp, element.lastLamp, index, seed, shadowRays);
  }
  else
  {
    for (std::uint32_t entry = element.firstLamp; entry < element.lastLamp; ++entry)
    {
      const Lamp& lamp = this->Lamps[this->LampOfEntry[entry]];
      irradiance +=
        this->Factor(lamp, point, index, Hash(seed, lamp.facet), shadowRays) * lamp.emission;
    }
  }
  return { solution.albedo[patch] / Pi * irradiance, this->OfElements[leaf] };
}

/// Irradiance that the lamp would give were it a point and nothing in the way, never nought.
double LitSurfaces::Likely(const Lamp& lamp, const LitPoint& point) const
{
  const Vec3 way = lamp.centre - point.place.position;
  const double square = glm::dot(way, way);
  const double here = glm::dot(point.normal, way);
  const double there = -glm::dot(lamp.normal, way);
  const double least = LeastCosine * std::sqrt(square);
  return Mean(lamp.emission) * lamp.area * std::max(here, least) * std::max(there, least) /
         ((square + lamp.area) * square + 1e-300);
}

/// Of the lamp that the point sees, in sr: all of it or nothing, as a point drawn on it is seen.
double LitSurfaces::Factor(const Lamp& lamp, const LitPoint& point, std::uint32_t index,
  std::uint64_t seed, std::uint64_t& shadowRays) const
{
  const Vec3& x = point.place.position;
  const double whole = PointToPolygon(x, point.normal, lamp.shape);
  if (whole <= 0.0 || lamp.facet == point.place.facet)
  {
    return 0.0;
  }
  const Vec3 target = PointAt(lamp.shape, ScrambledSobol(index, seed));
  ++shadowRays;
  const bool isSeen = glm::dot(point.normal, target - x) > 0.0 &&
                      !this->Occluders->IsOccluded(point.place, { target, lamp.facet });
  return isSeen ? whole : 0.0;
}

Color LitSurfaces::FromSome(const LitPoint& point, std::uint32_t first, std::uint32_t last,
  std::uint32_t index, std::uint64_t seed, std::uint64_t& shadowRays) const
{
  // One walk along all of them for the sum, another one past equal steps of it.
  double sum = 0.0;
  for (std::uint32_t entry = first; entry < last; ++entry)
  {
    sum += this->Likely(this->Lamps[this->LampOfEntry[entry]], point);
  }
  const double step = sum / MostLamps;
  double next = step * ScrambledSobol(index, Hash(seed, 0)).x;
  double walked = 0.0;
  Color irradiance(0.0);
  std::uint32_t drawn = 0;
  for (std::uint32_t entry = first; entry < last && drawn < MostLamps; ++entry)
  {
    const Lamp& lamp = this->Lamps[this->LampOfEntry[entry]];
    const double likely = this->Likely(lamp, point);
    walked += likely;
    for (; next < walked && drawn < MostLamps; next += step, ++drawn)
    {
      const double factor = this->Factor(lamp, point, index, Hash(seed, drawn + 1), shadowRays);
      irradiance += factor * step / likely * lamp.emission;
    }
  }
  return irradiance;
}

} // namespace vantage
