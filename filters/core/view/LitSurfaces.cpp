#include "core/view/LitSurfaces.h"

#include "core/formfactor/FormFactor.h"
#include "core/math/Sampling.h"
#include "core/math/ScrambledSobol.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

namespace vantage
{

namespace
{

/// A lamp that is nearer than so many of its radii is no point.
constexpr double NearLamp = 4.0;
/// A lamp whose centre is below the horizon, or turned away, may still be seen in part.
constexpr double LeastCosine = 0.05;
/// Points of a lamp of which one is chosen for the shadow ray, where the lamp is as large as it is
/// far.
constexpr double CandidatesAtOnce = 4.0;
/// A lamp that fills this part of the hemisphere, weighted by the cosine, is found by directions.
constexpr double PartOfHemisphere = 0.15;
/// Points, or directions, that are tried at most.
constexpr std::uint32_t MostTries = 32;

/// Where a ray meets a convex polygon from its front, if it does.
std::optional<Vec3> Meet(
  const Vec3& origin, const Vec3& direction, const Polygon& shape, const Vec3& normal)
{
  const double approach = -glm::dot(normal, direction);
  const double height = glm::dot(normal, origin - shape[0]);
  if (!(approach > 0.0 && height > 0.0))
  {
    return {};
  }
  const Vec3 place = origin + height / approach * direction;
  for (int i = 0; i < shape.Size(); ++i)
  {
    const Vec3 edge = shape[(i + 1) % shape.Size()] - shape[i];
    if (glm::dot(glm::cross(edge, place - shape[i]), normal) < 0.0)
    {
      return {};
    }
  }
  return place;
}

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
    lamp.radius = RadiusAround(lamp.shape, lamp.centre);
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
  const LightTexels::Place place = this->Texels.At(solution, patch, hit.point);
  const RadianceSolution::NodeIndex leaf = place.leaf;
  if (place.irradiance)
  {
    return { solution.albedo[patch] / Pi * *place.irradiance, this->OfElements[leaf], leaf };
  }
  const Color irradiance = this->Irradiance(hit, leaf, index, seed, shadowRays);
  return { solution.albedo[patch] / Pi * irradiance, this->OfElements[leaf], leaf };
}

std::uint64_t LitSurfaces::LightSample(const std::vector<Hit>& sample, std::uint64_t seed)
{
  std::vector<Color> irradiance(sample.size());
  std::vector<std::uint64_t> shadowRays(sample.size(), 0);
  tbb::parallel_for(std::size_t(0), sample.size(),
    [&](std::size_t k)
    {
      const Hit& hit = sample[k];
      const RadianceSolution::NodeIndex leaf = this->Solution->LeafAt(hit.Patch(), hit.point);
      irradiance[k] =
        this->Irradiance(hit, leaf, static_cast<std::uint32_t>(k), seed, shadowRays[k]);
    });
  this->Texels = LightTexels(*this->Occluders, *this->Solution, sample, irradiance);
  return std::accumulate(shadowRays.begin(), shadowRays.end(), std::uint64_t(0));
}

Color LitSurfaces::Irradiance(const Hit& hit, RadianceSolution::NodeIndex leaf, std::uint32_t index,
  std::uint64_t seed, std::uint64_t& shadowRays) const
{
  const RadianceSolution::Element& element = this->Solution->elements[leaf];
  if (element.firstLamp == element.lastLamp)
  {
    return Color(0.0);
  }
  const LitPoint point{ { hit.point, hit.facet }, NormalOf(*this->Occluders, hit.Patch()) };
  if (element.lastLamp - element.firstLamp > MostLamps)
  {
    return this->FromSome(point, element.firstLamp, element.lastLamp, index, seed, shadowRays);
  }
  Color irradiance(0.0);
  for (std::uint32_t entry = element.firstLamp; entry < element.lastLamp; ++entry)
  {
    const Lamp& lamp = this->Lamps[this->LampOfEntry[entry]];
    irradiance +=
      this->Factor(lamp, point, index, Hash(seed, lamp.facet), shadowRays) * lamp.emission;
  }
  return irradiance;
}

/// Irradiance that the lamp would give with nothing in the way, of a distant one as if it were a
/// point, and then never nought.
double LitSurfaces::Likely(const Lamp& lamp, const LitPoint& point) const
{
  const Vec3 way = lamp.centre - point.place.position;
  const double square = glm::dot(way, way);
  if (square < NearLamp * NearLamp * lamp.radius * lamp.radius)
  {
    return Mean(lamp.emission) * PointToPolygon(point.place.position, point.normal, lamp.shape);
  }
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
  const Vec3 target = whole > PartOfHemisphere * Pi ? TargetByDirection(lamp, point, index, seed)
                                                    : TargetByArea(lamp, point, index, seed);
  ++shadowRays;
  return this->Occluders->IsOccluded(point.place, { target, lamp.facet }) ? 0.0 : whole;
}

/// A point of the lamp, drawn as it lights `point`: the first that is met by directions which are
/// distributed by the cosine.
Vec3 LitSurfaces::TargetByDirection(
  const Lamp& lamp, const LitPoint& point, std::uint32_t index, std::uint64_t seed)
{
  const Frame frame(point.normal);
  for (std::uint32_t k = 0; k < MostTries; ++k)
  {
    const Vec2 u = ScrambledSobol(index, Hash(seed, k));
    const Vec3 direction = frame.ToWorld(CosineHemisphere(u));
    if (const auto place = Meet(point.place.position, direction, lamp.shape, lamp.normal))
    {
      return *place;
    }
  }
  return TargetByArea(lamp, point, index, seed);
}

/// The same, nearly: of a few that are spread over the lamp, one with the probability of its share
/// (Talbot et al. 2005). More are tried where none is above the horizon.
Vec3 LitSurfaces::TargetByArea(
  const Lamp& lamp, const LitPoint& point, std::uint32_t index, std::uint64_t seed)
{
  const Vec3& x = point.place.position;
  const double height = std::abs(glm::dot(lamp.normal, x - lamp.centre));
  const double distance = std::max(height, glm::length(x - lamp.centre) - lamp.radius);
  const double wanted = CandidatesAtOnce * lamp.area / (distance * distance + 1e-300);
  const auto candidates = static_cast<std::uint32_t>(std::clamp(wanted, 1.0, double(MostTries)));
  std::array<Vec3, MostTries> places;
  std::array<double, MostTries> sums;
  double sum = 0.0;
  std::uint32_t tried = 0;
  for (; tried < candidates || (sum == 0.0 && tried < MostTries); ++tried)
  {
    const Vec2 uv = ScrambledSobol(
      index * candidates + tried % candidates, tried < candidates ? seed : Hash(seed, tried));
    places[tried] = PointAt(lamp.shape, uv);
    const Vec3 way = places[tried] - x;
    const double square = glm::dot(way, way);
    const double cosines =
      std::max(0.0, glm::dot(point.normal, way)) * std::max(0.0, -glm::dot(lamp.normal, way));
    sum += square > 0.0 ? cosines / (square * square) : 0.0;
    sums[tried] = sum;
  }
  if (!(sum > 0.0))
  {
    return Centroid(ClipToFront(lamp.shape, { point.normal, glm::dot(point.normal, x) }));
  }
  const double chosen = sum * ScrambledSobol(index, Hash(seed, candidates)).x;
  const auto found = std::upper_bound(sums.begin(), sums.begin() + tried - 1, chosen);
  return places[static_cast<std::size_t>(found - sums.begin())];
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
