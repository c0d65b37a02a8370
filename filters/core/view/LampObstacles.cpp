#include "core/view/LampObstacles.h"

#include <algorithm>
#include <map>

namespace vantage
{

namespace
{

Bounds BoundsOf(const ConvexRegion& region)
{
  Bounds bounds(region.low);
  bounds.Add(region.high);
  return bounds;
}

} // namespace

LampObstacles::LampObstacles(const LampOverPatch& place, const std::vector<std::uint32_t>& facets)
  : Place(place)
  , TheCutter(*place.lamp)
{
  std::map<std::uint32_t, bool> isBodyKnown; // and whether it is seen to as a whole
  const auto isOfBody = [&](PatchId inside)
  {
    const std::uint32_t body = place.occluders->BodyAround(inside);
    if (body == None)
    {
      return false;
    }
    const auto [known, isNew] = isBodyKnown.try_emplace(body, false);
    if (isNew)
    {
      known->second = this->AddBody(body);
    }
    return known->second;
  };
  for (const std::uint32_t facet : facets)
  {
    const bool isOfFront = isOfBody(PatchOf(facet, Side::Front));
    const bool isOfBack = isOfBody(PatchOf(facet, Side::Back));
    if (!isOfFront && !isOfBack)
    {
      this->AddFacet(facet);
    }
  }
}

/// Returns whether all of its facets are seen to.
bool LampObstacles::AddBody(std::uint32_t body)
{
  const auto facets = this->Place.occluders->Convex().FacetsOf(body);
  if (facets.size() == 0)
  {
    return false;
  }
  const bool isItsOwn = std::any_of(facets.begin(), facets.end(),
    [this](PatchId side)
    { return side / 2 == this->Place.facet || this->Place.named->IsOfConvexPart(side / 2); });
  if (isItsOwn)
  {
    return true;
  }
  if (!this->TheCutter.Occluders().AddBody(this->LocalBody(body)))
  {
    return false;
  }
  Obstacle obstacle;
  obstacle.firstFacet = static_cast<std::uint32_t>(this->Facets.size());
  for (const PatchId side : facets)
  {
    this->Facets.push_back(side / 2);
    for (const Vec3& corner : this->Place.occluders->Shape(side / 2))
    {
      obstacle.bounds.Add(corner);
    }
  }
  obstacle.lastFacet = static_cast<std::uint32_t>(this->Facets.size());
  this->Obstacles.push_back(obstacle);
  return true;
}

void LampObstacles::AddFacet(std::uint32_t facet)
{
  const Polygon between = this->Between(facet);
  if (facet == this->Place.facet || this->Place.named->IsOfConvexPart(facet) || between.Empty() ||
      this->Place.lamp->IsInFrontOf(between))
  {
    return;
  }
  const auto inside = this->Place.occluders->InsideOf(facet);
  this->TheCutter.Occluders().AddPlate(
    between, inside ? std::optional(inside->side) : std::nullopt);
  const auto first = static_cast<std::uint32_t>(this->Facets.size());
  this->Facets.push_back(facet);
  this->Obstacles.push_back({ first, first + 1, inside, {} });
}

/// The part of a facet that is in front of both the patch and a flat lamp. Local; may be empty.
Polygon LampObstacles::Between(std::uint32_t facet) const
{
  Polygon local;
  for (const Vec3& v : this->Place.occluders->Shape(facet))
  {
    local.Add(this->Place.ToLocal(v));
  }
  const Polygon above = ClipToFront(local, Plane(), LampSurface::Touching);
  return this->Place.lamp->IsFlat()
           ? ClipToFront(above, this->Place.lamp->PlaneOf(0), LampSurface::Touching)
           : above;
}

ConvexBody LampObstacles::LocalBody(std::uint32_t body) const
{
  const ConvexBodies& bodies = this->Place.occluders->Convex();
  std::vector<Polygon> shapes;
  ConvexBody local;
  for (const PatchId facet : bodies.FacetsOf(body))
  {
    Polygon& shape = shapes.emplace_back();
    for (const Vec3& v : ShapeOf(*this->Place.occluders, facet))
    {
      shape.Add(this->Place.ToLocal(v));
      local.corners.push_back(shape[shape.Size() - 1]);
    }
  }
  for (const std::uint32_t facet : bodies.SidesOf(body))
  {
    local.planes.push_back(SupportingPlane(shapes[facet]));
  }
  for (const ConvexBodies::Edge& edge : bodies.EdgesOf(body))
  {
    const Polygon& shape = shapes[edge.facet];
    const int corner = static_cast<int>(edge.corner);
    local.edges.push_back(
      { shape[corner], shape[(corner + 1) % shape.Size()], edge.first, edge.second });
  }
  return local;
}

bool LampObstacles::IsElsewhere(std::uint32_t index, const ConvexRegion& region) const
{
  const Obstacle& obstacle = this->Obstacles[index];
  const auto first = this->Facets.begin() + obstacle.firstFacet;
  const auto last = this->Facets.begin() + obstacle.lastFacet;
  const bool isBody = last - first > 1;
  if (isBody && !obstacle.bounds.Meets(BoundsOf(region)))
  {
    return true;
  }
  return std::none_of(first, last,
    [&](std::uint32_t facet)
    {
      return ReachesInto(
        this->Place.occluders->Shape(facet), region, this->Place.occluders->Tolerance());
    });
}

bool LampObstacles::IsSeenFromOutside(std::uint32_t obstacle, const Bounds& box) const
{
  const auto& inside = this->Obstacles[obstacle].inside;
  return inside && !inside->body.Meets(box);
}

bool LampObstacles::IsOfLamp(std::uint32_t obstacle) const
{
  return this->Place.named->IsOfWhole(this->Facets[this->Obstacles[obstacle].firstFacet]);
}

} // namespace vantage
