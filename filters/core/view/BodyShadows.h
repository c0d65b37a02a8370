#pragma once

#include "core/view/LampHull.h"

#include <cstdint>
#include <optional>
#include <vector>

/// \file BodyShadows.h
/// What closed convex bodies hide of a lamp: ShadowCones.h, which says what the calls mean.

namespace vantage
{

/// A closed convex body, its faces as seen from outside, all in planes of their own.
struct ConvexBody
{
  struct Edge
  {
    Vec3 from, to; ///< counter-clockwise around the first face
    std::uint32_t first, second;
  };
  std::vector<Plane> planes; ///< of the faces
  std::vector<Vec3> corners; ///< all of them, as often as there are
  std::vector<Edge> edges;
};

/// From a point of z = 0 a body hides what is within the cone of its outline, whose edges lie
/// between faces that are seen and faces that are not.
class BodyShadows
{
public:
  /// \param lamp must outlive this
  explicit BodyShadows(const LampHull& lamp)
    : Lamp(&lamp)
  {
  }

  /// Returns its number. As ShadowCones::AddBody()
  std::optional<std::uint32_t> Add(const ConvexBody& whole);

  bool HidesAll(std::uint32_t index, const Polygon& points) const;
  bool IsSharp(std::uint32_t index, const Polygon& points) const;
  Cover Cast(std::uint32_t index, const Vec2& x, std::vector<LampSurface::HalfSpace>& sides) const;

private:
  /// The second face is none, the number past the last, where the lamp's plane has cut the first
  /// one.
  struct Edge
  {
    ShadowEdge line;
    std::uint32_t first, second;
  };
  struct Body
  {
    std::vector<AffineOverPlane> faces; ///< distance of x from each
    std::vector<Edge> edges;
    /// Distance from a plane between body and lamp, positive on the body's side.
    AffineOverPlane before;
  };

  std::optional<Plane> PlaneBetween(const ConvexBody& body) const;
  static void AddEdges(const ConvexBody& whole, const std::optional<Plane>& front, Body& body);
  template <typename Visit>
  static bool ForEachOutlineEdge(const Body& body, const Vec2& x, const Visit& visit);

  const LampHull* Lamp;
  std::vector<Body> Bodies;
};

} // namespace vantage
