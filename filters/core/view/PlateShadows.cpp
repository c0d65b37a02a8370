#include "core/view/PlateShadows.h"

#include <algorithm>

namespace vantage
{

std::uint32_t PlateShadows::Add(const Polygon& shape, std::optional<Side> inside)
{
  const auto first = static_cast<std::uint32_t>(this->Edges.size());
  Plate& plate = this->Plates.emplace_back();
  plate.plane = SupportingPlane(shape);
  plate.side = DistanceFrom(plate.plane);
  plate.beyond = this->LampBeyond(plate.plane);
  plate.firstEdge = first;
  plate.lastEdge = first + shape.Size();
  plate.inside = inside;
  if (plate.beyond[0] == Cover::Part)
  {
    if (const auto between = this->Lamp->FaceInFrontOf({ shape.begin(), shape.end() }))
    {
      plate.before = DistanceFrom(*between);
      plate.beyond = { Cover::Whole, Cover::Whole };
    }
  }
  for (int i = 0; i < shape.Size(); ++i)
  {
    this->AddEdge(shape[i], shape[(i + 1) % shape.Size()]);
  }
  return static_cast<std::uint32_t>(this->Plates.size() - 1);
}

void PlateShadows::AddEdge(const Vec3& from, const Vec3& to)
{
  const auto& [along, moment] = this->Edges.emplace_back(from, to);
  for (const Vec3& v : this->Lamp->Corners())
  {
    this->HullHeights.push_back({ glm::dot(moment, v), along.y * v.z - along.z * v.y - moment.x,
      along.z * v.x - along.x * v.z - moment.y });
  }
}

/// How much of the lamp is beyond a plane for points above it, and below.
std::array<Cover, 2> PlateShadows::LampBeyond(const Plane& plane) const
{
  if (this->Lamp->Lamp().IsFlat())
  {
    return { Cover::Whole, Cover::Whole }; // what is in front of the lamp has it beyond
  }
  double low = 0.0;
  double high = 0.0;
  for (const Vec3& corner : this->Lamp->Lamp().Corners())
  {
    low = std::min(low, plane.Distance(corner));
    high = std::max(high, plane.Distance(corner));
  }
  const bool anyAbove = high > LampSurface::Touching;
  const bool anyBelow = low < -LampSurface::Touching;
  return { CoverOf(anyBelow, anyAbove), CoverOf(anyAbove, anyBelow) };
}

/// LampHull::HullBehind() of an edge.
Cover PlateShadows::HullBehind(std::uint32_t edge, double sign, const Vec2& x) const
{
  const std::vector<Vec3>& corners = this->Lamp->Corners();
  const AffineOverPlane* height = &this->HullHeights[edge * corners.size()];
  return CoverOfHeights(corners, [&](const Vec3&) { return sign * (height++)->At(x); });
}

/// The segments from points on one side of a plate to the lamp meet its plane within the convex
/// hull of those between corners, so these decide.
bool PlateShadows::HidesAll(std::uint32_t index, const Polygon& points) const
{
  const Plate& plate = this->Plates[index];
  return CommonSide(plate, points) != 0.0 &&
         std::all_of(points.begin(), points.end(),
           [&](const Vec3& x) { return this->HidesAllFrom(plate, x); });
}

bool PlateShadows::HidesAllFrom(const Plate& plate, const Vec2& x) const
{
  const double side = plate.side.At(x);
  bool hides = side != 0.0 && plate.beyond[side < 0.0 ? 1 : 0] == Cover::Whole &&
               !(plate.before && plate.before->At(x) <= 0.0);
  for (std::uint32_t e = plate.firstEdge; hides && e < plate.lastEdge; ++e)
  {
    hides = this->HullBehind(e, side, x) == Cover::Whole;
  }
  return hides;
}

/// The side of the plate that all points are on: 1 or -1, or 0 when they are not on one side.
double PlateShadows::CommonSide(const Plate& plate, const Polygon& points)
{
  bool anyAbove = false;
  bool anyBelow = false;
  for (const Vec3& x : points)
  {
    const double side = plate.side.At(x);
    anyAbove = anyAbove || side >= 0.0;
    anyBelow = anyBelow || side <= 0.0;
  }
  return anyAbove == anyBelow ? 0.0 : (anyAbove ? 1.0 : -1.0);
}

bool PlateShadows::IsSharp(std::uint32_t index, const Polygon& points) const
{
  const Plate& plate = this->Plates[index];
  const double side = CommonSide(plate, points);
  if (side == 0.0)
  {
    return true;
  }
  const auto first = this->Edges.begin();
  return std::any_of(first + plate.firstEdge, first + plate.lastEdge,
    [&](const ShadowEdge& edge) { return this->Lamp->PassesBetween(edge, side, points); });
}

bool PlateShadows::SeesInside(std::uint32_t index, const Vec2& x) const
{
  const Plate& plate = this->Plates[index];
  return plate.inside == (plate.side.At(x) > 0.0 ? Side::Front : Side::Back);
}

Cover PlateShadows::Cast(
  std::uint32_t index, const Vec2& x, std::vector<LampSurface::HalfSpace>& sides) const
{
  const Plate& plate = this->Plates[index];
  const double side = plate.side.At(x);
  if (side == 0.0 || (plate.before && plate.before->At(x) <= 0.0))
  {
    return Cover::None; // seen edge-on, or from where it is behind the lamp
  }
  const double sign = side < 0.0 ? -1.0 : 1.0;
  const Cover beyond = plate.beyond[side < 0.0 ? 1 : 0];
  if (beyond == Cover::None)
  {
    return Cover::None;
  }
  Cover all = beyond;
  for (std::uint32_t e = plate.firstEdge; e < plate.lastEdge; ++e)
  {
    const Cover cover = this->HullBehind(e, sign, x);
    if (cover == Cover::None)
    {
      return Cover::None;
    }
    if (cover == Cover::Part)
    {
      all = Cover::Part;
      sides.push_back(this->Edges[e].SideBehind(sign, x));
    }
  }
  if (beyond == Cover::Part)
  {
    sides.push_back({ -sign * plate.plane.normal, sign * plate.plane.offset });
  }
  return all;
}

} // namespace vantage
