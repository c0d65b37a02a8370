#include "core/view/BrightSpots.h"

#include <algorithm>
#include <cmath>

namespace vantage
{

namespace
{

/// Radiance of a spot over the usual one, at least. Drawn by less bright ones, rays lose more by
/// what hides these than they gain.
constexpr double LeastBrightness = 2.0;
/// All of them are gone through for each point.
constexpr std::size_t MostSpots = 256;
/// One of so many rays goes to a spot.
constexpr std::uint32_t RaysOfWhichOne = 8;
/// What that has to take from the variance of a ray, over the square of the usual irradiance.
constexpr double LeastGain = 0.1;
/// A spot that is above the horizon in part counts as if its centre were so many radii above it.
constexpr double LeastHeight = 0.25;

/// Form factor from the point to the spot with nothing in the way, in sr, about.
double FactorOf(const BrightSpots::Spot& spot, const Vec3& point, const Vec3& normal)
{
  const Vec3 way = spot.centre - point;
  const double here = glm::dot(normal, way);
  const double there = -glm::dot(spot.normal, way);
  if (here <= -spot.radius || there <= 0.0)
  {
    return 0.0;
  }
  const double square = glm::dot(way, way);
  const double height = std::max(here, LeastHeight * spot.radius);
  return spot.area * height * there / (square * (square + spot.area));
}

/// Hits of a spot over those that it would have with nothing in the way. One is added to both, as a
/// spot with few of them may be visible all the same.
double VisiblePart(const BrightSpots::Spot& spot, std::uint32_t hits, const RayOrigins& origins)
{
  if (origins.places.empty())
  {
    return 1.0;
  }
  double sum = 0.0;
  for (const RayOrigins::Place& place : origins.places)
  {
    sum += FactorOf(spot, place.point, place.normal);
  }
  const double expected = origins.rays * sum / (Pi * static_cast<double>(origins.places.size()));
  return std::min(1.0, (hits + 1.0) / (expected + 1.0));
}

/// A texel that may be a spot.
struct Candidate
{
  std::uint32_t texel;
  double radiance;
  double noise; ///< that it brings, in any unit
};

/// The brightest, if there are many.
std::vector<Candidate> FindBright(const RadianceSolution& solution,
  const std::vector<LightTexels::Texel>& texels, const std::vector<Color>& indirect, double usual)
{
  std::vector<Candidate> bright;
  for (std::uint32_t k = 0; k < texels.size(); ++k)
  {
    const LightTexels::Texel& texel = texels[k];
    const double radiance =
      Mean(texel.irradiance
             ? solution.albedo[texel.patch] / Pi * *texel.irradiance + indirect[texel.leaf]
             : solution.elements[texel.leaf].reflected);
    if (radiance > LeastBrightness * usual)
    {
      bright.push_back({ k, radiance, radiance * radiance * Area(texel.shape) });
    }
  }
  if (bright.size() > MostSpots)
  {
    const auto end = bright.begin() + static_cast<std::ptrdiff_t>(MostSpots);
    std::nth_element(bright.begin(), end, bright.end(),
      [](const Candidate& a, const Candidate& b) { return a.noise > b.noise; });
    bright.erase(end, bright.end());
  }
  return bright;
}

} // namespace

BrightSpots::BrightSpots(const OccluderScene& occluders, const RadianceSolution& solution,
  const LightTexels& texels, const std::vector<Color>& indirect, const RayOrigins& origins,
  double usual)
  : Usual(usual)
{
  const std::vector<LightTexels::Texel> all = texels.All(occluders);
  this->SpotOfTexel.assign(all.size(), None);
  for (const Candidate& bright : FindBright(solution, all, indirect, usual))
  {
    this->SpotOfTexel[bright.texel] = static_cast<std::uint32_t>(this->Spots.size());
    this->Add(bright.texel, all[bright.texel].shape, bright.radiance);
    Spot& spot = this->Spots.back();
    spot.visible = VisiblePart(spot, all[bright.texel].hits, origins);
  }
}

void BrightSpots::Add(std::uint32_t texel, const Polygon& shape, double radiance)
{
  const Vec3 centre = Centroid(shape);
  this->Spots.push_back(
    { centre, UnitNormal(shape), RadiusAround(shape, centre), Area(shape), radiance });
  this->TexelOfSpot.push_back(texel);
  this->Shapes.push_back(shape);
}

/// Of a spot with radiance L, form factor F and visible part v, a ray drawn by the cosine brings
/// pi L with probability v F / pi; one that is drawn by what the spots are expected to give, g =
/// L F v, brings sum(g) / v with probability v g / sum(g), if the spot is there. Both have the mean
/// sum(g).
SpotDirections::SpotDirections(const BrightSpots& spots, const Vec3& point, const Vec3& normal)
  : Spots(&spots)
  , Point(point)
{
  this->Sums.reserve(spots.All().size());
  double sum = 0.0;
  double unhidden = 0.0;
  double secondMoment = 0.0;
  for (const BrightSpots::Spot& spot : spots.All())
  {
    const double most = spot.radiance * FactorOf(spot, point, normal);
    unhidden += most;
    sum += spot.visible * most;
    secondMoment += Pi * spot.radiance * spot.visible * most;
    this->Sums.push_back(sum);
  }
  const double byCosine = secondMoment - sum * sum;
  const double bySpots = sum * (unhidden - sum);
  this->Gain = byCosine - RaysOfWhichOne * bySpots;
}

std::uint32_t SpotDirections::PartOf(std::uint32_t rays) const
{
  const double usual = Pi * this->Spots->UsualRadiance();
  // One ray alone has to look everywhere.
  const bool isWorthIt = rays > 1 && this->Gain > LeastGain * usual * usual;
  return isWorthIt ? (rays + RaysOfWhichOne - 1) / RaysOfWhichOne : 0;
}

SpotDirections::Target SpotDirections::Draw(const Vec2& u) const
{
  const double wanted = u.x * this->Sums.back();
  const auto found = std::upper_bound(this->Sums.begin(), this->Sums.end() - 1, wanted);
  const auto index = static_cast<std::size_t>(found - this->Sums.begin());
  const double before = this->SumBefore(index);
  const double rest = (wanted - before) / (*found - before);
  return { this->Spots->TexelOf(index),
    PointAt(this->Spots->ShapeOf(index), { std::min(rest, 1.0), u.y }) };
}

double SpotDirections::Density(std::uint32_t texel, const Vec2& within, const Vec3& place) const
{
  const std::uint32_t index = this->Spots->OfTexel(texel);
  if (index == None)
  {
    return 0.0;
  }
  const BrightSpots::Spot& spot = this->Spots->All()[index];
  const double share = (this->Sums[index] - this->SumBefore(index)) / this->Sums.back();
  const Vec3 way = place - this->Point;
  const double square = glm::dot(way, way);
  const double there = -glm::dot(spot.normal, way);
  const Polygon& shape = this->Spots->ShapeOf(index);
  const double area = shape.Size() == 3 ? spot.area : AreaElementAt(shape, within);
  return there > 0.0 ? share * square * std::sqrt(square) / (there * area) : 0.0;
}

} // namespace vantage
