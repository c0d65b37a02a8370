#include "core/view/BodyShadows.h"

#include <algorithm>
#include <cmath>

namespace vantage
{

namespace
{

/// Where an edge leaves the front of a plane, by the distances of its ends from that: an end that
/// touches it is the same for all edges there.
Vec3 Crossing(const ConvexBody::Edge& edge, double from, double to)
{
  if (std::abs(from) <= LampSurface::Touching)
  {
    return edge.from;
  }
  return std::abs(to) <= LampSurface::Touching
           ? edge.to
           : edge.from + from / (from - to) * (edge.to - edge.from);
}

} // namespace

std::optional<std::uint32_t> BodyShadows::Add(const ConvexBody& whole)
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
  AddEdges(whole, this->Lamp->Lamp().IsFlat() ? between : std::nullopt, body);
  this->Bodies.push_back(std::move(body));
  return static_cast<std::uint32_t>(this->Bodies.size() - 1);
}

/// A plane that has the body in front and the lamp behind: from its front the body may hide the
/// lamp, from its back it cannot. For flat lamps their own, whatever is behind it.
std::optional<Plane> BodyShadows::PlaneBetween(const ConvexBody& body) const
{
  const LampSurface& lamp = this->Lamp->Lamp();
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
  return this->Lamp->FaceInFrontOf(body.corners);
}

/// Those in front of a plane, and where that cuts faces, whose rest nobody sees: it looks away from
/// all that is in front.
void BodyShadows::AddEdges(const ConvexBody& whole, const std::optional<Plane>& front, Body& body)
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
    const bool isFromIn = from > LampSurface::Touching;
    const bool isToIn = to > LampSurface::Touching;
    if (isFromIn || isToIn)
    {
      body.edges.push_back({ ShadowEdge(edge.from, edge.to), edge.first, edge.second });
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
      body.edges.push_back({ ShadowEdge(*start, *end), face, none });
    }
  }
}

/// Calls visit(edge, sign) for each edge of the outline that x sees, with the sign for
/// ShadowEdge::SideBehind(), until it returns false. Returns false when there is none, as x is
/// inside of the body.
template <typename Visit>
bool BodyShadows::ForEachOutlineEdge(const Body& body, const Vec2& x, const Visit& visit)
{
  thread_local std::vector<std::uint8_t> room;
  room.resize(body.faces.size() + 1);
  std::uint8_t* const seen = room.data(); // asked for once: it is the thread's own
  std::uint8_t any = 0;
  for (std::size_t f = 0; f < body.faces.size(); ++f)
  {
    seen[f] = body.faces[f].At(x) > LampSurface::Touching ? 1 : 0;
    any |= seen[f];
  }
  seen[body.faces.size()] = 0; // no face
  for (std::size_t e = 0; any != 0 && e < body.edges.size(); ++e)
  {
    const Edge& edge = body.edges[e];
    if (seen[edge.first] != seen[edge.second] && !visit(e, seen[edge.first] != 0 ? 1.0 : -1.0))
    {
      break;
    }
  }
  return any != 0;
}

/// What is hidden from some points is hidden from all between them, as the body is convex.
bool BodyShadows::HidesAll(std::uint32_t index, const Polygon& points) const
{
  std::vector<LampSurface::HalfSpace> sides;
  return std::all_of(points.begin(), points.end(),
    [&](const Vec3& x) { return this->Cast(index, x, sides) == Cover::Whole; });
}

/// Each edge of an outline is asked from all points: on one that runs around a globe there may be
/// another one of its edges.
bool BodyShadows::IsSharp(std::uint32_t index, const Polygon& points) const
{
  const Body& body = this->Bodies[index];
  std::vector<bool> isAsked(body.edges.size(), false);
  int outside = 0;
  bool anySharp = false;
  for (const Vec3& x : points)
  {
    const bool isOutside = ForEachOutlineEdge(body, x,
      [&](std::size_t edge, double sign)
      {
        anySharp = anySharp || (!isAsked[edge] &&
                                 this->Lamp->PassesBetween(body.edges[edge].line, sign, points));
        isAsked[edge] = true;
        return !anySharp;
      });
    outside += isOutside ? 1 : 0;
  }
  return anySharp || (outside > 0 && outside < points.Size());
}

Cover BodyShadows::Cast(
  std::uint32_t index, const Vec2& x, std::vector<LampSurface::HalfSpace>& sides) const
{
  const Body& body = this->Bodies[index];
  if (body.before.At(x) <= 0.0 || body.edges.empty())
  {
    return Cover::None;
  }
  Cover all = Cover::Whole;
  ForEachOutlineEdge(body, x,
    [&](std::size_t edge, double sign)
    {
      const LampSurface::HalfSpace side = body.edges[edge].line.SideBehind(sign, x);
      const Cover cover = this->Lamp->HullBehind(side);
      if (cover == Cover::Part)
      {
        sides.push_back(side);
      }
      all = cover == Cover::Whole ? all : cover;
      return cover != Cover::None;
    });
  return all;
}

} // namespace vantage
