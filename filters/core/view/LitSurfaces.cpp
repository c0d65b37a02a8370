#include "core/view/LitSurfaces.h"

#include "core/formfactor/FormFactor.h"
#include "core/math/PointInPolygon.h"
#include "core/math/Sampling.h"
#include "core/math/ScrambledSobol.h"

#include <glm/matrix.hpp>
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
  return Contains(shape, normal, place) ? std::optional(place) : std::nullopt;
}

} // namespace

LitSurfaces::Face::Face(const Polygon& outline, std::uint32_t itsFacet)
  : shape(outline)
  , centre(Centroid(outline))
  , normal(UnitNormal(outline))
  , radius(RadiusAround(outline, this->centre))
  , area(Area(outline))
  , facet(itsFacet)
{
}

LitSurfaces::Lamp::Lamp(const NamedLamp& named)
  : emission(named.emission)
{
  Vec3 areaTimesCentre(0.0);
  for (std::size_t k = 0; k < named.patches.size(); ++k)
  {
    const Face& face = this->faces.emplace_back(named.shapes[k], named.patches[k] / 2);
    this->area += face.area;
    this->areasTo.push_back(this->area);
    areaTimesCentre += face.area * face.centre;
    this->areaNormal += face.area * face.normal;
    this->areaTensor += face.area * glm::outerProduct(face.normal, face.normal);
  }
  this->centre = this->faces.size() == 1 ? this->faces[0].centre : areaTimesCentre / this->area;
  for (const Face& face : this->faces)
  {
    this->radius = std::max(this->radius, RadiusAround(face.shape, this->centre));
  }
}

double LitSurfaces::Lamp::AreaTowards(const Vec3& direction) const
{
  const double net = glm::dot(this->areaNormal, direction);
  if (this->faces.size() == 1)
  {
    return net;
  }
  // Both sides together: the root mean square of the cosine stands for its mean.
  const double both = std::sqrt(this->area * glm::dot(direction, this->areaTensor * direction));
  return 0.5 * (both + net);
}

LitSurfaces::LitSurfaces(const OccluderScene& occluders, const RadianceSolution& solution)
  : Occluders(&occluders)
  , Solution(&solution)
  , Named(occluders, solution)
{
  this->OfElements.reserve(solution.elements.size());
  for (const RadianceSolution::Element& element : solution.elements)
  {
    this->OfElements.push_back(element.indirect);
  }
  for (std::uint32_t lamp = 0; lamp < this->Named.Size(); ++lamp)
  {
    this->Lamps.emplace_back(this->Named[lamp]);
  }
}

LitRadiance LitSurfaces::Radiance(const Hit& hit, LitBy by, std::uint32_t index, std::uint64_t seed,
  std::uint64_t& shadowRays) const
{
  const RadianceSolution& solution = *this->Solution;
  const PatchId patch = hit.Patch();
  if (!solution.IsActive(patch))
  {
    return {};
  }
  const LightTexels::Place place = this->Texels.At(solution, patch, hit.point);
  const RadianceSolution::NodeIndex leaf = place.leaf;
  const Color irradiance = by == LitBy::Texels && place.irradiance
                             ? *place.irradiance
                             : this->Irradiance(hit, leaf, index, seed, shadowRays);
  return { solution.albedo[patch] / Pi * irradiance, this->OfElements[leaf], leaf, place.texel,
    place.within };
}

std::uint64_t LitSurfaces::LightSample(
  const std::vector<Hit>& sample, const RayOrigins& origins, std::uint64_t seed)
{
  std::vector<Color> irradiance(sample.size());
  std::vector<std::uint64_t> shadowRays(sample.size(), 0);
  std::vector<double> radiance(sample.size());
  tbb::parallel_for(std::size_t(0), sample.size(),
    [&](std::size_t k)
    {
      const Hit& hit = sample[k];
      const RadianceSolution::NodeIndex leaf = this->Solution->LeafAt(hit.Patch(), hit.point);
      irradiance[k] =
        this->Irradiance(hit, leaf, static_cast<std::uint32_t>(k), seed, shadowRays[k]);
      radiance[k] =
        Mean(this->Solution->albedo[hit.Patch()] / Pi * irradiance[k] + this->OfElements[leaf]);
    });
  this->Texels = LightTexels(*this->Occluders, *this->Solution, sample, irradiance);
  const double usual = std::accumulate(radiance.begin(), radiance.end(), 0.0) /
                       std::max(1.0, static_cast<double>(sample.size()));
  this->Bright =
    BrightSpots(*this->Occluders, *this->Solution, this->Texels, this->OfElements, origins, usual);
  return std::accumulate(shadowRays.begin(), shadowRays.end(), std::uint64_t(0));
}

Color LitSurfaces::Irradiance(const Hit& hit, RadianceSolution::NodeIndex leaf, std::uint32_t index,
  std::uint64_t seed, std::uint64_t& shadowRays) const
{
  const NamedLamps::List& lamps = this->Named.Of(leaf);
  if (lamps.empty())
  {
    return Color(0.0);
  }
  const LitPoint point{ { hit.point, hit.facet }, NormalOf(*this->Occluders, hit.Patch()) };
  if (lamps.size() > MostLamps)
  {
    return this->FromSome(point, lamps, index, seed, shadowRays);
  }
  Color irradiance(0.0);
  for (const std::uint32_t lamp : lamps)
  {
    const std::uint64_t itsSeed = Hash(seed, this->Lamps[lamp].faces[0].facet);
    irradiance +=
      this->Factor(lamp, point, index, itsSeed, shadowRays) * this->Lamps[lamp].emission;
  }
  return irradiance;
}

/// Irradiance that the lamp would give with nothing in the way, of a distant one as if it were a
/// point, and then never nought.
double LitSurfaces::Likely(std::uint32_t index, const LitPoint& point) const
{
  const Lamp& lamp = this->Lamps[index];
  const Vec3 way = lamp.centre - point.place.position;
  const double square = glm::dot(way, way);
  if (square < NearLamp * NearLamp * lamp.radius * lamp.radius)
  {
    return Mean(lamp.emission) * this->Unhidden(index, point);
  }
  const double distance = std::sqrt(square);
  const double here = glm::dot(point.normal, way);
  const double there = lamp.AreaTowards(-way / distance) * distance;
  const double least = LeastCosine * distance;
  return Mean(lamp.emission) * std::max(here, least) * std::max(there, lamp.area * least) /
         ((square + lamp.area) * square + 1e-300);
}

/// Of the lamp that the point would see with nothing in the way, in sr.
double LitSurfaces::Unhidden(std::uint32_t lamp, const LitPoint& point) const
{
  const Vec3& x = point.place.position;
  const std::vector<Face>& faces = this->Lamps[lamp].faces;
  if (faces.size() == 1)
  {
    return PointToPolygon(x, point.normal, faces[0].shape);
  }
  thread_local LampSurface::Workspace room;
  return this->Named[lamp].surface.Onto(x, point.normal, room);
}

/// Of the lamp that the point sees, in sr: all of it or nothing, as a point drawn on it is seen.
double LitSurfaces::Factor(std::uint32_t lamp, const LitPoint& point, std::uint32_t index,
  std::uint64_t seed, std::uint64_t& shadowRays) const
{
  const double whole = this->Unhidden(lamp, point);
  if (whole <= 0.0 || this->Named[lamp].IsOfConvexPart(point.place.facet))
  {
    return 0.0;
  }
  const std::vector<Face>& faces = this->Lamps[lamp].faces;
  const Face* face = &faces[0];
  if (faces.size() > 1)
  {
    face = &FaceTowards(this->Lamps[lamp], point, index, seed);
  }
  const Vec3 target = whole > PartOfHemisphere * Pi ? TargetByDirection(*face, point, index, seed)
                                                    : TargetByArea(*face, point, index, seed);
  ++shadowRays;
  return this->Occluders->IsOccluded(point.place, { target, face->facet }) ? 0.0 : whole;
}

/// Whether any of a polygon is.
bool LitSurfaces::IsAboveHorizon(const Polygon& shape, const LitPoint& point)
{
  return std::any_of(shape.begin(), shape.end(),
    [&](const Vec3& corner)
    { return glm::dot(point.normal, corner - point.place.position) > 0.0; });
}

/// What a face gives to the point, over its area, about.
double LitSurfaces::GivenByArea(const Face& face, const LitPoint& point)
{
  const Vec3 way = face.centre - point.place.position;
  const double here = glm::dot(point.normal, way);
  const double there = -glm::dot(face.normal, way);
  if (there <= 0.0 || (here <= face.radius && !IsAboveHorizon(face.shape, point)))
  {
    return 0.0;
  }
  const double square = glm::dot(way, way);
  return there * std::max(here, LeastCosine * face.radius) / (square * (square + face.area));
}

/// A face, drawn by about what it gives to the point. Of a distant lamp faces are drawn by area,
/// and taken with the probability of their share in the most that any may give. \pre it sees some
/// face
const LitSurfaces::Face& LitSurfaces::FaceTowards(
  const Lamp& lamp, const LitPoint& point, std::uint32_t index, std::uint64_t seed)
{
  const double distance = glm::length(lamp.centre - point.place.position);
  const double nearest = distance - lamp.radius;
  const std::uint32_t tries = distance > NearLamp * lamp.radius ? MostTries : 0;
  for (std::uint32_t k = 0; k < tries; ++k)
  {
    const Vec2 u = ScrambledSobol(index, Hash(seed, k));
    const auto found =
      std::upper_bound(lamp.areasTo.begin(), lamp.areasTo.end() - 1, u.x * lamp.areasTo.back());
    const Face& face = lamp.faces[static_cast<std::size_t>(found - lamp.areasTo.begin())];
    if (u.y < GivenByArea(face, point) * nearest * nearest)
    {
      return face;
    }
  }
  return FaceOfAll(lamp, point, ScrambledSobol(index, Hash(seed, 0)).y);
}

/// The same, by what each of them gives.
const LitSurfaces::Face& LitSurfaces::FaceOfAll(const Lamp& lamp, const LitPoint& point, double u)
{
  std::vector<double> sums;
  sums.reserve(lamp.faces.size());
  double sum = 0.0;
  for (const Face& face : lamp.faces)
  {
    sum += face.area * GivenByArea(face, point);
    sums.push_back(sum);
  }
  const auto found = std::upper_bound(sums.begin(), sums.end() - 1, u * sum);
  return lamp.faces[static_cast<std::size_t>(found - sums.begin())];
}

/// A point of a face, drawn as it lights `point`: the first that is met by directions which are
/// distributed by the cosine.
Vec3 LitSurfaces::TargetByDirection(
  const Face& face, const LitPoint& point, std::uint32_t index, std::uint64_t seed)
{
  const Frame frame(point.normal);
  for (std::uint32_t k = 0; k < MostTries; ++k)
  {
    const Vec2 u = ScrambledSobol(index, Hash(seed, k));
    const Vec3 direction = frame.ToWorld(CosineHemisphere(u));
    if (const auto place = Meet(point.place.position, direction, face.shape, face.normal))
    {
      return *place;
    }
  }
  return TargetByArea(face, point, index, seed);
}

/// The same, nearly: of a few that are spread over it, one with the probability of its share
/// (Talbot et al. 2005). More are tried where none is above the horizon.
Vec3 LitSurfaces::TargetByArea(
  const Face& face, const LitPoint& point, std::uint32_t index, std::uint64_t seed)
{
  const Vec3& x = point.place.position;
  const double height = std::abs(glm::dot(face.normal, x - face.centre));
  const double distance = std::max(height, glm::length(x - face.centre) - face.radius);
  const double wanted = CandidatesAtOnce * face.area / (distance * distance + 1e-300);
  const auto candidates = static_cast<std::uint32_t>(std::clamp(wanted, 1.0, double(MostTries)));
  std::array<Vec3, MostTries> places;
  std::array<double, MostTries> sums;
  double sum = 0.0;
  std::uint32_t tried = 0;
  for (; tried < candidates || (sum == 0.0 && tried < MostTries); ++tried)
  {
    const Vec2 uv = ScrambledSobol(
      index * candidates + tried % candidates, tried < candidates ? seed : Hash(seed, tried));
    places[tried] = PointAt(face.shape, uv);
    const Vec3 way = places[tried] - x;
    const double square = glm::dot(way, way);
    const double cosines =
      std::max(0.0, glm::dot(point.normal, way)) * std::max(0.0, -glm::dot(face.normal, way));
    sum += square > 0.0 ? cosines / (square * square) : 0.0;
    sums[tried] = sum;
  }
  if (!(sum > 0.0))
  {
    const Polygon above = ClipToFront(face.shape, { point.normal, glm::dot(point.normal, x) });
    return above.Empty() ? face.centre : Centroid(above);
  }
  const double chosen = sum * ScrambledSobol(index, Hash(seed, candidates)).x;
  const auto found = std::upper_bound(sums.begin(), sums.begin() + tried - 1, chosen);
  return places[static_cast<std::size_t>(found - sums.begin())];
}

Color LitSurfaces::FromSome(const LitPoint& point, const NamedLamps::List& lamps,
  std::uint32_t index, std::uint64_t seed, std::uint64_t& shadowRays) const
{
  // One walk along all of them for the sum, another one past equal steps of it.
  thread_local std::vector<double> likely;
  likely.clear();
  for (const std::uint32_t lamp : lamps)
  {
    likely.push_back(this->Likely(lamp, point));
  }
  const double step = std::accumulate(likely.begin(), likely.end(), 0.0) / MostLamps;
  double next = step * ScrambledSobol(index, Hash(seed, 0)).x;
  double walked = 0.0;
  Color irradiance(0.0);
  std::uint32_t drawn = 0;
  for (std::size_t k = 0; k < lamps.size() && drawn < MostLamps; ++k)
  {
    walked += likely[k];
    for (; next < walked && drawn < MostLamps; next += step, ++drawn)
    {
      const double factor = this->Factor(lamps[k], point, index, Hash(seed, drawn + 1), shadowRays);
      irradiance += factor * step / likely[k] * this->Lamps[lamps[k]].emission;
    }
  }
  return irradiance;
}

} // namespace vantage
