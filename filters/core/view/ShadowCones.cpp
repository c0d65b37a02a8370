#include "core/view/ShadowCones.h"

#include "core/mesh/Bounds.h"

#include <algorithm>
#include <cmath>

namespace vantage
{

namespace
{

/// What is nearer to a plane than this touches it.
constexpr double Touching = 1e-10;

/// Where an edge leaves the front of a plane, by the distances of its ends from that: an end that
/// touches it is the same for all edges there.
Vec3 Crossing(const ConvexBody::Edge& edge, double from, double to)
{
  if (std::abs(from) <= Touching)
  {
    return edge.from;
  }
  return std::abs(to) <= Touching ? edge.to
                                  : edge.from + from / (from - to) * (edge.to - edge.from);
}

template <typename Points>
bool AreInFront(const Points& points, const Plane& plane)
{
  return std::all_of(points.begin(), points.end(),
    [&plane](const Vec3& point) { return plane.Distance(point) >= -Touching; });
}

} // namespace

ShadowCones::ShadowCones(const LampSurface& lamp)
  : Lamp(&lamp)
{
  this->FindHull();
}

/// The box around many faces has few corners.
void ShadowCones::FindHull()
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

ShadowCones::Cover ShadowCones::CoverOf(bool anyInside, bool anyOutside)
{
  return anyInside ? (anyOutside ? Cover::Part : Cover::Whole) : Cover::None;
}

/// Of corners whose heights over a plane are asked for in turn.
template <typename HeightOf>
ShadowCones::Cover ShadowCones::CoverOfHeights(
  const std::vector<Vec3>& corners, const HeightOf& heightOf)
{
  bool anyInside = false;
  bool anyOutside = false;
  for (const Vec3& corner : corners)
  {
    const double height = heightOf(corner);
    anyInside = anyInside || height > 0.0;
    anyOutside = anyOutside || height < 0.0;
  }
  return CoverOf(anyInside, anyOutside);
}

ShadowCones::Affine ShadowCones::DistanceFrom(const Plane& plane)
{
  return { -plane.offset, plane.normal.x, plane.normal.y };
}

/// The normal of the plane through x and the edge, n(x) = moment - along x x, towards a place y:
/// dot(n(x), y - x), of which the products with x alone are linear as well.
ShadowCones::Edge ShadowCones::EdgeBetween(const Vec3& from, const Vec3& to)
{
  const Vec3 along = to - from;
  return { along, glm::cross(along, from) };
}

/// What is inside of an edge as x sees it. \param sign 1 if the edge runs counter-clockwise around
/// the shadow as seen from x, else -1
LampSurface::HalfSpace ShadowCones::SideBehind(const Edge& edge, double sign, const Vec2& x)
{
  const Vec3& along = edge.along;
  const Vec3& moment = edge.moment;
  const Vec3 normal(
    moment.x + along.z * x.y, moment.y - along.z * x.x, moment.z - along.x * x.y + along.y * x.x);
  return { sign * normal, -sign * (moment.x * x.x + moment.y * x.y) };
}

/// How much of the hull is inside of a side.
ShadowCones::Cover ShadowCones::HullBehind(const HalfSpace& side) const
{
  return CoverOfHeights(this->Hull, [&side](const Vec3& corner) { return side.Height(corner); });
}

/// How much of the lamp itself is.
ShadowCones::Cover ShadowCones::LampBehind(const HalfSpace& side) const
{
  const Cover ofHull = this->HullBehind(side);
  if (ofHull != Cover::Part)
  {
    return ofHull;
  }
  return CoverOfHeights(
    this->Lamp->Corners(), [&side](const Vec3& corner) { return side.Height(corner); });
}

/// Whether an edge hides none of the lamp from some points, and all of it from others.
bool ShadowCones::PassesBetween(const Edge& edge, double sign, const Polygon& points) const
{
  bool anyNone = false;
  bool anyWhole = false;
  for (const Vec3& x : points)
  {
    const Cover cover = this->LampBehind(SideBehind(edge, sign, x));
    anyNone = anyNone || cover == Cover::None;
    anyWhole = anyWhole || cover == Cover::Whole;
  }
  return anyNone && anyWhole;
}

bool ShadowCones::HidesAll(std::uint32_t index, const Polygon& points) const
{
  const Occluder& occluder = this->Occluders[index];
  if (occluder.isBody)
  {
    // What is hidden from some points is hidden from all between them: the body is convex.
    std::vector<HalfSpace> sides;
    return std::all_of(points.begin(), points.end(),
      [&](const Vec3& x)
      { return this->Cast(this->Bodies[occluder.index], x, sides) == Cover::Whole; });
  }
  // The segments from points on one side of a plate to the lamp meet its plane within the convex
  // hull of those between corners, so these decide.
  const Plate& plate = this->Plates[occluder.index];
  return this->CommonSide(plate, points) != 0.0 &&
         std::all_of(points.begin(), points.end(),
           [&](const Vec3& x) { return this->HidesAllFrom(plate, x); });
}

bool ShadowCones::IsSharp(std::uint32_t index, const Polygon& points) const
{
  const Occluder& occluder = this->Occluders[index];
  return occluder.isBody ? this->IsSharp(this->Bodies[occluder.index], points)
                         : this->IsSharp(this->Plates[occluder.index], points);
}

ShadowCones::Cover ShadowCones::Cast(
  std::uint32_t index, const Vec2& x, std::vector<HalfSpace>& sides) const
{
  const Occluder& occluder = this->Occluders[index];
  return occluder.isBody ? this->Cast(this->Bodies[occluder.index], x, sides)
                         : this->Cast(this->Plates[occluder.index], x, sides);
}

std::uint32_t ShadowCones::AddPlate(const Polygon& shape, std::optional<Side> inside)
{
  const auto first = static_cast<std::uint32_t>(this->PlateEdges.size());
  this->Occluders.push_back({ false, static_cast<std::uint32_t>(this->Plates.size()) });
  Plate& plate = this->Plates.emplace_back();
  plate.plane = SupportingPlane(shape);
  plate.side = DistanceFrom(plate.plane);
  plate.beyond = this->LampBeyond(plate.plane);
  plate.firstEdge = first;
  plate.lastEdge = first + shape.Size();
  plate.inside = inside;
  if (plate.beyond[0] == Cover::Part)
  {
    if (const auto between = this->FaceInFrontOf({ shape.begin(), shape.end() }))
    {
      plate.before = DistanceFrom(*between);
      plate.beyond = { Cover::Whole, Cover::Whole };
    }
  }
  for (int i = 0; i < shape.Size(); ++i)
  {
    const auto& [along, moment] =
      this->PlateEdges.emplace_back(EdgeBetween(shape[i], shape[(i + 1) % shape.Size()]));
    for (const Vec3& v : this->Hull)
    {
      this->HullHeights.push_back({ glm::dot(moment, v), along.y * v.z - along.z * v.y - moment.x,
        along.z * v.x - along.x * v.z - moment.y });
    }
  }
  return static_cast<std::uint32_t>(this->Occluders.size() - 1);
}

/// How much of the lamp is beyond a plane for points above it, and below.
std::array<ShadowCones::Cover, 2> ShadowCones::LampBeyond(const Plane& plane) const
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

/// HullBehind() of an edge of a plate.
ShadowCones::Cover ShadowCones::HullBehindEdge(std::uint32_t edge, double sign, const Vec2& x) const
{
  const Affine* height = &this->HullHeights[edge * this->Hull.size()];
  return CoverOfHeights(this->Hull, [&](const Vec3&) { return sign * (height++)->At(x); });
}

bool ShadowCones::HidesAllFrom(const Plate& plate, const Vec2& x) const
{
  const double side = plate.side.At(x);
  bool hides = side != 0.0 && plate.beyond[side < 0.0 ? 1 : 0] == Cover::Whole &&
               !(plate.before && plate.before->At(x) <= 0.0);
  for (std::uint32_t e = plate.firstEdge; hides && e < plate.lastEdge; ++e)
  {
    hides = this->HullBehindEdge(e, side, x) == Cover::Whole;
  }
  return hides;
}

/// The side of the plate that all points are on: 1 or -1, or 0 when they are not on one side.
double ShadowCones::CommonSide(const Plate& plate, const Polygon& points) const
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

bool ShadowCones::IsSharp(const Plate& plate, const Polygon& points) const
{
  const double side = this->CommonSide(plate, points);
  if (side == 0.0)
  {
    return true;
  }
  const auto first = this->PlateEdges.begin();
  return std::any_of(first + plate.firstEdge, first + plate.lastEdge,
    [&](const Edge& edge) { return this->PassesBetween(edge, side, points); });
}

bool ShadowCones::IsCone(std::uint32_t index) const
{
  const Occluder& occluder = this->Occluders[index];
  return occluder.isBody || this->Plates[occluder.index].beyond[0] != Cover::Part;
}

bool ShadowCones::SeesInside(std::uint32_t index, const Vec2& x) const
{
  const Occluder& occluder = this->Occluders[index];
  if (occluder.isBody)
  {
    return false;
  }
  const Plate& plate = this->Plates[occluder.index];
  return plate.inside == (plate.side.At(x) > 0.0 ? Side::Front : Side::Back);
}

/// The cone through a plate, as far as it is beyond that.
ShadowCones::Cover ShadowCones::Cast(
  const Plate& plate, const Vec2& x, std::vector<HalfSpace>& sides) const
{
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
    const Cover cover = this->HullBehindEdge(e, sign, x);
    if (cover == Cover::None)
    {
      return Cover::None;
    }
    if (cover == Cover::Part)
    {
      all = Cover::Part;
      sides.push_back(SideBehind(this->PlateEdges[e], sign, x));
    }
  }
  if (beyond == Cover::Part)
  {
    sides.push_back({ -sign * plate.plane.normal, sign * plate.plane.offset });
  }
  return all;
}

std::optional<std::uint32_t> ShadowCones::AddBody(const ConvexBody& whole)
{
  const std::optional<Plane> between = this->PlaneBetween(whole);
  if (!between)
  {
    return std::nullopt;
  }
  Body body;
  body.before = DistanceFrom(*between);
  for (const Plane& plane : whole.planes)
  {
    body.faces.push_back(DistanceFrom(plane));
  }
  AddEdges(whole, this->Lamp->IsFlat() ? between : std::nullopt, body);
  this->Occluders.push_back({ true, static_cast<std::uint32_t>(this->Bodies.size()) });
  this->Bodies.push_back(std::move(body));
  return static_cast<std::uint32_t>(this->Occluders.size() - 1);
}

/// A plane that has the body in front and the lamp behind: from its front the body may hide the
/// lamp, from its back it cannot. For flat lamps their own, whatever is behind it.
std::optional<Plane> ShadowCones::PlaneBetween(const ConvexBody& body) const
{
  const LampSurface& lamp = *this->Lamp;
  if (lamp.IsFlat())
  {
    return lamp.PlaneOf(0);
  }
  for (const Plane& plane : body.planes)
  {
    if (AreInFront(lamp.Corners(), plane))
    {
      return Plane{ -plane.normal, -plane.offset };
    }
  }
  return this->FaceInFrontOf(body.corners);
}

/// The plane of a face of the lamp that some corners are in front of.
std::optional<Plane> ShadowCones::FaceInFrontOf(const std::vector<Vec3>& corners) const
{
  for (std::uint32_t face = 0; face < this->Lamp->Size(); ++face)
  {
    if (AreInFront(corners, this->Lamp->PlaneOf(face)))
    {
      return this->Lamp->PlaneOf(face);
    }
  }
  return std::nullopt;
}

/// Those in front of a plane, and where that cuts faces, whose rest nobody sees: it looks away from
/// all that is in front.
void ShadowCones::AddEdges(const ConvexBody& whole, const std::optional<Plane>& front, Body& body)
{
  struct Cut
  {
    std::optional<Vec3> start, end; ///< counter-clockwise around the rest of the face
  };
  std::vector<Cut> cuts(front ? whole.planes.size() : 0);
  for (const ConvexBody::Edge& edge : whole.edges)
  {
    const double from = front ? front->Distance(edge.from) : 1.0;
    const double to = front ? front->Distance(edge.to) : 1.0;
    const bool isFromIn = from > Touching;
    const bool isToIn = to > Touching;
    if (isFromIn || isToIn)
    {
      body.edges.push_back({ EdgeBetween(edge.from, edge.to), edge.first, edge.second });
    }
    if (isFromIn != isToIn)
    {
      const Vec3 crossing = Crossing(edge, from, to);
      // Where the edge leaves the front its first face does, and the second one comes back.
      (isFromIn ? cuts[edge.first].start : cuts[edge.first].end) = crossing;
      (isFromIn ? cuts[edge.second].end : cuts[edge.second].start) = crossing;
    }
  }
  for (std::uint32_t face = 0; face < cuts.size(); ++face)
  {
    const auto& [start, end] = cuts[face];
    if (start && end && *start != *end) // it may touch the plane in a corner
    {
      const auto none = static_cast<std::uint32_t>(whole.planes.size());
      body.edges.push_back({ EdgeBetween(*start, *end), face, none });
    }
  }
}

/// Calls visit(edge, sign) for each edge of the outline that x sees, with the sign for
/// SideBehind(), until it returns false. Returns false when there is none, as x is inside of the
/// body.
template <typename Visit>
bool ShadowCones::ForEachOutlineEdge(const Body& body, const Vec2& x, const Visit& visit)
{
  thread_local std::vector<std::uint8_t> room;
  room.resize(body.faces.size() + 1);
  std::uint8_t* const seen = room.data(); // asked for once: it is the thread's own
  std::uint8_t any = 0;
  for (std::size_t f = 0; f < body.faces.size(); ++f)
  {
    seen[f] = body.faces[f].At(x) > Touching ? 1 : 0;
    any |= seen[f];
  }
  seen[body.faces.size()] = 0; // no face
  for (std::size_t e = 0; any != 0 && e < body.edges.size(); ++e)
  {
    const BodyEdge& edge = body.edges[e];
    if (seen[edge.first] != seen[edge.second] && !visit(e, seen[edge.first] != 0 ? 1.0 : -1.0))
    {
      break;
    }
  }
  return any != 0;
}

/// The cone of a body's outline.
ShadowCones::Cover ShadowCones::Cast(
  const Body& body, const Vec2& x, std::vector<HalfSpace>& sides) const
{
  if (body.before.At(x) <= 0.0 || body.edges.empty())
  {
    return Cover::None;
  }
  Cover all = Cover::Whole;
  ForEachOutlineEdge(body, x,
    [&](std::size_t edge, double sign)
    {
      const HalfSpace side = SideBehind(body.edges[edge].line, sign, x);
      const Cover cover = this->HullBehind(side);
      if (cover == Cover::Part)
      {
        sides.push_back(side);
      }
      all = cover == Cover::Whole ? all : cover;
      return cover != Cover::None;
    });
  return all;
}

/// Each edge of an outline is asked from all points: on one that runs around a globe there may be
/// another one of its edges.
bool ShadowCones::IsSharp(const Body& body, const Polygon& points) const
{
  std::vector<bool> isAsked(body.edges.size(), false);
  int outside = 0;
  bool anySharp = false;
  for (const Vec3& x : points)
  {
    const bool isOutside = ForEachOutlineEdge(body, x,
      [&](std::size_t edge, double sign)
      {
        anySharp =
          anySharp || (!isAsked[edge] && this->PassesBetween(body.edges[edge].line, sign, points));
        isAsked[edge] = true;
        return !anySharp;
      });
    outside += isOutside ? 1 : 0;
  }
  return anySharp || (outside > 0 && outside < points.Size());
}

} // namespace vantage
