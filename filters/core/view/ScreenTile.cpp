#include "core/view/ScreenTile.h"

#include "core/visibility/FlatOccluder.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace vantage
{

namespace
{

/// A tile with more facets is cut in four, unless it has this many pixels along a side only.
constexpr std::size_t MostFacets = 10;
constexpr int LeastSide = 4;
/// Planes seen at grazing angles reach far; what lies further than this many times the points that
/// were met is left to single rays.
constexpr double FarthestReach = 4.0;

using Corners = std::array<Vec2, 4>;

ScreenLine LineOf(const ImagePlane& eye, const Vec3& normal)
{
  return { glm::dot(normal, eye.forward), glm::dot(normal, eye.right), glm::dot(normal, eye.up) };
}

template <typename Predicate>
bool AllCorners(const Corners& corners, const Predicate& holds)
{
  return std::all_of(corners.begin(), corners.end(), holds);
}

/// The pyramid through the corners of a tile down to a depth.
ConvexRegion Pyramid(const ImagePlane& eye, const Corners& corners, double depth)
{
  ConvexRegion region;
  region.low = region.high = eye.eye;
  std::array<Vec3, 4> directions;
  for (int i = 0; i < 4; ++i)
  {
    directions[i] = eye.Direction(corners[i].x, corners[i].y);
    const Vec3 far = eye.eye + depth * directions[i];
    region.low = glm::min(region.low, far);
    region.high = glm::max(region.high, far);
  }
  for (int i = 0; i < 4; ++i)
  {
    const Vec3 normal = glm::normalize(glm::cross(directions[(i + 1) % 4], directions[i]));
    const double sign = glm::dot(normal, directions[(i + 2) % 4]) < 0.0 ? -1.0 : 1.0;
    region.Add({ sign * normal, sign * glm::dot(normal, eye.eye) });
  }
  region.Add({ -eye.forward, -glm::dot(eye.forward, eye.eye) - depth });
  return region;
}

} // namespace

bool ScreenFacet::Covers(const Vec2& place) const
{
  return this->edges[0].At(place) >= 0.0 && this->edges[1].At(place) >= 0.0 &&
         this->edges[2].At(place) >= 0.0 && this->edges[3].At(place) >= 0.0;
}

ScreenTile::ScreenTile(const OccluderScene& occluders, const ImagePlane& plane,
  const Vec2& pixelSize, const Rectangle& rectangle)
  : Occluders(&occluders)
  , Eye(&plane)
  , PixelSize(pixelSize)
  , Area(rectangle)
{
}

std::vector<ScreenTile> ScreenTile::Cut(const OccluderScene& occluders, const ImagePlane& plane,
  const Vec2& pixelSize, const Rectangle& rectangle)
{
  std::vector<ScreenTile> tiles;
  std::vector<Rectangle> waiting{ rectangle };
  while (!waiting.empty())
  {
    const Rectangle r = waiting.back();
    waiting.pop_back();
    ScreenTile tile(occluders, plane, pixelSize, r);
    const bool isSmall = std::max(r.width, r.height) <= LeastSide;
    if (tile.Collect(isSmall ? std::numeric_limits<std::size_t>::max() : MostFacets))
    {
      tiles.push_back(std::move(tile));
      continue;
    }
    const int left = (r.width + 1) / 2;
    const int lower = (r.height + 1) / 2;
    for (const Rectangle& part :
      { Rectangle{ r.x, r.y, left, lower }, Rectangle{ r.x + left, r.y, r.width - left, lower },
        Rectangle{ r.x, r.y + lower, left, r.height - lower },
        Rectangle{ r.x + left, r.y + lower, r.width - left, r.height - lower } })
    {
      if (part.width > 0 && part.height > 0)
      {
        waiting.push_back(part);
      }
    }
  }
  return tiles;
}

double ScreenTile::DepthOfCorners() const
{
  const Rectangle& r = this->Area;
  double nearest = 0.0;
  double reach = 0.0;
  const std::array<Vec2, 5> places{ this->Place(r.x, r.y), this->Place(r.x + r.width, r.y),
    this->Place(r.x + r.width, r.y + r.height), this->Place(r.x, r.y + r.height),
    this->Place(r.x + 0.5 * r.width, r.y + 0.5 * r.height) };
  for (const Vec2& place : places)
  {
    const Vec3 direction = this->Eye->Direction(place.x, place.y);
    const auto hit = this->Occluders->Intersect(this->Eye->eye, direction);
    if (!hit)
    {
      continue;
    }
    nearest = std::max(nearest, hit->distance);
    const Plane plane = SupportingPlane(this->Occluders->Shape(hit->facet));
    const double height = plane.Distance(this->Eye->eye);
    for (int i = 0; i < 4; ++i)
    {
      const Vec3 corner = this->Eye->Direction(places[i].x, places[i].y);
      const double depth = -height / glm::dot(plane.normal, corner);
      reach = std::max(reach, depth > 0.0 ? depth : std::numeric_limits<double>::infinity());
    }
  }
  return std::min(reach * (1.0 + 1e-6), FarthestReach * nearest);
}

bool ScreenTile::Collect(std::size_t most)
{
  const double reach = this->DepthOfCorners();
  if (!(reach > 0.0))
  {
    this->InverseReach = std::numeric_limits<double>::infinity();
    return most > MostFacets;
  }
  const Rectangle& r = this->Area;
  const Corners corners{ this->Place(r.x, r.y), this->Place(r.x + r.width, r.y),
    this->Place(r.x + r.width, r.y + r.height), this->Place(r.x, r.y + r.height) };
  const auto found = this->Occluders->FacetsInRegion(Pyramid(*this->Eye, corners, reach));
  if (found.size() > most)
  {
    return false;
  }
  this->InverseReach = 1.0 / reach;
  for (const std::uint32_t facet : found)
  {
    this->AddFacet(facet);
  }
  return true;
}

void ScreenTile::AddFacet(std::uint32_t facet)
{
  const double tolerance = this->Occluders->Tolerance();
  for (const Polygon& part : FlatParts(this->Occluders->Shape(facet), tolerance))
  {
    const Plane plane = SupportingPlane(part);
    const double height = plane.Distance(this->Eye->eye);
    if (std::abs(height) <= tolerance)
    {
      continue;
    }
    ScreenFacet seen;
    seen.patch = PatchOf(facet, height > 0.0 ? Side::Front : Side::Back);
    seen.inverseDepth = LineOf(*this->Eye, -plane.normal / height);
    for (int i = 0; i < 4; ++i)
    {
      const int k = std::min(i, part.Size() - 1);
      const Vec3 from = part[k] - this->Eye->eye;
      const Vec3 to = part[(k + 1) % part.Size()] - this->Eye->eye;
      const Vec3 normal = glm::normalize(glm::cross(from, to)) * (height > 0.0 ? -1.0 : 1.0);
      ScreenLine line = LineOf(*this->Eye, normal);
      line.constant += tolerance * seen.inverseDepth.constant;
      line.alongS += tolerance * seen.inverseDepth.alongS;
      line.alongT += tolerance * seen.inverseDepth.alongT;
      seen.edges[i] = line;
    }
    this->Facets.push_back(seen);
  }
}

EyeHit ScreenTile::Look(const Vec2& place, std::uint64_t& rays) const
{
  double nearest = this->InverseReach;
  const ScreenFacet* seen = nullptr;
  for (const ScreenFacet& facet : this->Facets)
  {
    const double inverse = facet.inverseDepth.At(place);
    if (inverse > nearest && facet.Covers(place))
    {
      nearest = inverse;
      seen = &facet;
    }
  }
  if (seen)
  {
    return { seen->patch, 1.0 / nearest };
  }
  ++rays;
  const auto hit =
    this->Occluders->Intersect(this->Eye->eye, this->Eye->Direction(place.x, place.y));
  return hit ? EyeHit{ hit->Patch(), hit->distance } : EyeHit{};
}

bool ScreenTile::SeesOnly(int x, int y, PatchId patch) const
{
  const Corners corners{ this->Place(x, y), this->Place(x + 1, y), this->Place(x + 1, y + 1),
    this->Place(x, y + 1) };
  const ScreenFacet* whole = nullptr;
  for (const ScreenFacet& facet : this->Facets)
  {
    const auto isSeen = [&](const Vec2& corner)
    { return facet.inverseDepth.At(corner) > this->InverseReach && facet.Covers(corner); };
    if (facet.patch == patch && AllCorners(corners, isSeen))
    {
      whole = &facet;
    }
  }
  if (!whole)
  {
    return false;
  }
  return std::all_of(this->Facets.begin(), this->Facets.end(),
    [&](const ScreenFacet& other)
    {
      const auto isBehind = [&](const Vec2& corner)
      { return other.inverseDepth.At(corner) <= whole->inverseDepth.At(corner); };
      const auto isOutside = [&](const ScreenLine& edge)
      { return AllCorners(corners, [&](const Vec2& corner) { return edge.At(corner) < 0.0; }); };
      return &other == whole || AllCorners(corners, isBehind) ||
             std::any_of(other.edges.begin(), other.edges.end(), isOutside);
    });
}

} // namespace vantage
