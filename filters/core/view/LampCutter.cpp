#include "core/view/LampCutter.h"

#include "core/mesh/Bounds.h"

#include <algorithm>
#include <cmath>

namespace vantage
{

namespace
{

/// Parts that are cut by a shadow, in all: they take about twice the time of two hundred rays.
constexpr std::size_t MostEffort = 4000;
/// What is nearer to a plane than this touches it.
constexpr double Touching = 1e-10;

} // namespace

LampCutter::LampCutter(const LampSurface& lamp)
  : Lamp(&lamp)
{
  this->FindHull();
  if (lamp.Size() == 1)
  {
    this->Only.emplace(lamp.Face(0), lamp.PlaneOf(0));
  }
}

/// The box around many faces has few corners.
void LampCutter::FindHull()
{
  this->Hull = this->Lamp->Corners();
  if (this->Lamp->Size() == 1)
  {
    return;
  }
  Bounds box;
  for (const Vec3& corner : this->Lamp->Corners())
  {
    box.Add(corner);
  }
  this->Hull.clear();
  for (int k = 0; k < 8; ++k)
  {
    const auto choose = [&](int axis)
    { return (k >> axis & 1) != 0 ? box.High()[axis] : box.Low()[axis]; };
    this->Hull.emplace_back(choose(0), choose(1), choose(2));
  }
}

std::uint32_t LampCutter::AddOccluder(const Polygon& shape, std::optional<Side> inside)
{
  const Plane plane = SupportingPlane(shape);
  const auto first = static_cast<std::uint32_t>(this->Edges.size());
  this->Occluders.push_back({ plane, { -plane.offset, plane.normal.x, plane.normal.y },
    this->LampBeyond(plane), first, first + shape.Size(), inside });
  for (int i = 0; i < shape.Size(); ++i)
  {
    // The normal of the plane through x and the edge, n(x) = moment - along x x, towards a place
    // y: dot(n(x), y - x), of which the products with x alone are linear as well.
    const Vec3 along = shape[(i + 1) % shape.Size()] - shape[i];
    const Vec3 moment = glm::cross(along, shape[i]);
    this->Edges.push_back({ along, moment });
    for (const Vec3& v : this->Hull)
    {
      this->HullHeights.push_back({ glm::dot(moment, v), along.y * v.z - along.z * v.y - moment.x,
        along.z * v.x - along.x * v.z - moment.y });
    }
  }
  return static_cast<std::uint32_t>(this->Occluders.size() - 1);
}

LampCutter::Cover LampCutter::CoverOf(bool anyInside, bool anyOutside)
{
  return anyInside ? (anyOutside ? Cover::Part : Cover::Whole) : Cover::None;
}

/// How much of the lamp is beyond a plane for points above it, and below.
std::array<LampCutter::Cover, 2> LampCutter::LampBeyond(const Plane& plane) const
{
  if (this->Lamp->IsFlat())
  {
    return { Cover::Whole, Cover::Whole }; // what is in front of the lamp has it beyond
  }
  double low = 0.0;
  double high = 0.0;
  for (const Vec3& corner : this->Lamp->Corners())
  {
    low = std::min(low, plane.Distance(corner));
    high = std::max(high, plane.Distance(corner));
  }
  const bool anyAbove = high > Touching;
  const bool anyBelow = low < -Touching;
  return { CoverOf(anyBelow, anyAbove), CoverOf(anyAbove, anyBelow) };
}

/// The segments from points on one side of the occluder to the lamp meet its plane within the
/// convex hull of those between corners, so these decide.
bool LampCutter::HidesAll(std::uint32_t index, const Polygon& points) const
{
  const Occluder& occluder = this->Occluders[index];
  return this->CommonSide(occluder, points) != 0.0 &&
         std::all_of(points.begin(), points.end(),
           [&](const Vec3& x) { return this->HidesAllFrom(occluder, x); });
}

bool LampCutter::HidesAllFrom(const Occluder& occluder, const Vec2& x) const
{
  const double side = occluder.side.At(x);
  bool hides = side != 0.0 && occluder.beyond[side < 0.0 ? 1 : 0] == Cover::Whole;
  for (std::uint32_t e = occluder.firstEdge; hides && e < occluder.lastEdge; ++e)
  {
    hides = this->HullBehind(e, side, x) == Cover::Whole;
  }
  return hides;
}

std::optional<double> LampCutter::Seen(
  const Vec2& x, const std::vector<Suspect>& suspects, Shadows& shadows) const
{
  shadows.All.clear();
  shadows.Sides.clear();
  for (const Suspect& suspect : suspects)
  {
    const Occluder& occluder = this->Occluders[suspect.occluder];
    const auto first = static_cast<std::uint32_t>(shadows.Sides.size());
    const Cover cover = this->Cast(occluder, x, shadows);
    if (cover == Cover::Whole)
    {
      shadows.All.clear();
      return 0.0;
    }
    if (cover == Cover::Part && !(suspect.isSeenFromOutside && IsInside(occluder, x)))
    {
      shadows.All.push_back({ first, static_cast<std::uint32_t>(shadows.Sides.size()) });
    }
    else
    {
      shadows.Sides.resize(first);
    }
  }
  return shadows.All.empty() ? this->Lamp->At(x, shadows.Room) : this->SeenOfFaces(shadows, x);
}

/// Whether the side that x sees is the inside of a body.
bool LampCutter::IsInside(const Occluder& occluder, const Vec2& x)
{
  return occluder.inside == (occluder.side.At(x) > 0.0 ? Side::Front : Side::Back);
}

/// What is inside of an edge as x sees it. \param sign of the side of the occluder that x is on
LampSurface::HalfSpace LampCutter::SideBehind(const Edge& edge, double sign, const Vec2& x)
{
  const Vec3& along = edge.along;
  const Vec3& moment = edge.moment;
  const Vec3 normal(
    moment.x + along.z * x.y, moment.y - along.z * x.x, moment.z - along.x * x.y + along.y * x.x);
  return { sign * normal, -sign * (moment.x * x.x + moment.y * x.y) };
}

/// How much of the hull is inside of an edge.
LampCutter::Cover LampCutter::HullBehind(std::uint32_t edge, double sign, const Vec2& x) const
{
  const Affine* height = &this->HullHeights[edge * this->Hull.size()];
  bool anyInside = false;
  bool anyOutside = false;
  for (std::size_t k = 0; k < this->Hull.size(); ++k)
  {
    const double d = sign * height[k].At(x);
    anyInside = anyInside || d > 0.0;
    anyOutside = anyOutside || d < 0.0;
  }
  return CoverOf(anyInside, anyOutside);
}

/// How much of the lamp itself is.
LampCutter::Cover LampCutter::LampBehind(std::uint32_t edge, double sign, const Vec2& x) const
{
  if (this->Lamp->Size() == 1)
  {
    return this->HullBehind(edge, sign, x);
  }
  const LampSurface::HalfSpace side = SideBehind(this->Edges[edge], sign, x);
  bool anyInside = false;
  bool anyOutside = false;
  for (const Vec3& corner : this->Lamp->Corners())
  {
    const double d = side.Height(corner);
    anyInside = anyInside || d > 0.0;
    anyOutside = anyOutside || d < 0.0;
  }
  return CoverOf(anyInside, anyOutside);
}

/// The cone from x through the occluder, as far as it is beyond that. Appends its sides.
LampCutter::Cover LampCutter::Cast(const Occluder& occluder, const Vec2& x, Shadows& shadows) const
{
  const double side = occluder.side.At(x);
  if (side == 0.0)
  {
    return Cover::None; // seen edge-on
  }
  const double sign = side < 0.0 ? -1.0 : 1.0;
  const Cover beyond = occluder.beyond[side < 0.0 ? 1 : 0];
  if (beyond == Cover::None)
  {
    return Cover::None;
  }
  Cover all = beyond;
  for (std::uint32_t e = occluder.firstEdge; e < occluder.lastEdge; ++e)
  {
    const Cover cover = this->HullBehind(e, sign, x);
    if (cover == Cover::None)
    {
      return Cover::None;
    }
    if (cover == Cover::Part)
    {
      all = Cover::Part;
      shadows.Sides.push_back(SideBehind(this->Edges[e], sign, x));
    }
  }
  if (beyond == Cover::Part)
  {
    const Plane& plane = occluder.plane;
    shadows.Sides.push_back({ -sign * plane.normal, sign * plane.offset });
  }
  return all;
}

/// The side of the occluder that all points are on: 1 or -1, or 0 when they are not on one side.
double LampCutter::CommonSide(const Occluder& occluder, const Polygon& points) const
{
  bool anyAbove = false;
  bool anyBelow = false;
  for (const Vec3& x : points)
  {
    const double side = occluder.side.At(x);
    anyAbove = anyAbove || side >= 0.0;
    anyBelow = anyBelow || side <= 0.0;
  }
  return anyAbove == anyBelow ? 0.0 : (anyAbove ? 1.0 : -1.0);
}

bool LampCutter::IsSharp(std::uint32_t index, const Polygon& points) const
{
  const Occluder& occluder = this->Occluders[index];
  const double side = this->CommonSide(occluder, points);
  if (side == 0.0)
  {
    return true;
  }
  for (std::uint32_t e = occluder.firstEdge; e < occluder.lastEdge; ++e)
  {
    bool anyNone = false;
    bool anyWhole = false;
    for (const Vec3& x : points)
    {
      const Cover cover = this->LampBehind(e, side, x);
      anyNone = anyNone || cover == Cover::None;
      anyWhole = anyWhole || cover == Cover::Whole;
    }
    if (anyNone && anyWhole)
    {
      return true;
    }
  }
  return false;
}

std::optional<double> LampCutter::SeenOfFaces(Shadows& shadows, const Vec2& x) const
{
  shadows.Effort = 0;
  if (this->Lamp->Size() == 1) // it is the hull, which all of them cut
  {
    shadows.OfFace = shadows.All;
    return SeenOfFace(*this->Only, shadows, x);
  }
  LampSurface::Workspace& room = shadows.Room;
  if (!this->Lamp->FindSeen(x, room.seen))
  {
    return 0.0;
  }
  this->SortFaces(shadows);
  double seen = 0.0;
  for (auto first = shadows.Partly.begin(); first != shadows.Partly.end();)
  {
    const std::uint32_t face = first->face;
    shadows.OfFace.clear();
    for (; first != shadows.Partly.end() && first->face == face; ++first)
    {
      shadows.OfFace.push_back(first->shadow);
    }
    if (room.seen[face] == 0)
    {
      continue; // another shadow hides all of it
    }
    room.seen[face] = 0;
    const auto part = SeenOfFace({ this->Lamp->Face(face), this->Lamp->PlaneOf(face) }, shadows, x);
    if (!part)
    {
      return std::nullopt;
    }
    seen += *part;
  }
  return seen + this->Lamp->OfSeen(x, room);
}

/// Those that a shadow hides as a whole are not seen; those that it hides in part are noted.
void LampCutter::SortFaces(Shadows& shadows) const
{
  shadows.Partly.clear();
  for (const Shadows::Shadow& shadow : shadows.All)
  {
    shadows.Faces.clear();
    this->Lamp->Sort(&shadows.Sides[shadow.firstSide], static_cast<std::size_t>(shadow.Count()),
      shadows.Room.seen, shadows.Faces);
    for (const std::uint32_t face : shadows.Faces)
    {
      shadows.Partly.push_back({ face, shadow });
    }
  }
  std::stable_sort(shadows.Partly.begin(), shadows.Partly.end(),
    [](const auto& a, const auto& b) { return a.face < b.face; });
}

/// Past shadows.OfFace. Those of few sides first: they hide most, and leave few parts to the
/// others.
std::optional<double> LampCutter::SeenOfFace(
  const FaceParts::Face& face, Shadows& shadows, const Vec2& x)
{
  shadows.Parts.Start(face);
  for (int sides = 1; sides <= Polygon::Capacity + 1; ++sides)
  {
    for (const Shadows::Shadow& shadow : shadows.OfFace)
    {
      if (shadow.Count() == sides)
      {
        shadows.Effort += shadows.Parts.Size();
        shadows.Parts.Take(&shadows.Sides[shadow.firstSide], sides);
      }
      if (shadows.Effort > MostEffort)
      {
        shadows.TooMany = true;
        return std::nullopt;
      }
    }
  }
  return shadows.Parts.At(x);
}

} // namespace vantage
