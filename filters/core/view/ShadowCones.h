#pragma once

#include "core/mesh/ElementTree.h"
#include "core/view/LampSurface.h"

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

/// \file ShadowCones.h
/// What occluders hide of a lamp, as the points of a plane see it.

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

/// From a point of the plane z = 0, an occluder hides the lamp within a convex cone: that of a
/// plate's edges, or of the outline of a body, whose faces are seen on one side of it and not on
/// the other. So a globe casts one shadow, however many facets it has.
class ShadowCones
{
public:
  /// How much of something is on one side.
  enum class Cover
  {
    None,
    Part,
    Whole
  };

  /// \param lamp must outlive this
  explicit ShadowCones(const LampSurface& lamp);

  /// \param shape above the plane, with an area; in front of the lamp if that is flat
  /// \param inside the side that is the inside of a closed body, if one is
  /// \return its number, from 0, of plates and bodies together
  std::uint32_t AddPlate(const Polygon& shape, std::optional<Side> inside = {});
  /// Of a body, what is in front of a flat lamp counts. \return nothing when no face tells body and
  /// lamp apart, as they may touch: add its faces as plates then.
  std::optional<std::uint32_t> AddBody(const ConvexBody& body);

  /// Whether the occluder hides all of the lamp from all of a convex polygon in the plane.
  bool HidesAll(std::uint32_t occluder, const Polygon& points) const;
  /// Whether the lamp is on one side of an edge of the occluder as one of some points sees it, and
  /// on the other side as another one does: then the edge of the shadow is narrower than the points
  /// lie apart, and all of it may fall between them. Or whether the plane of a plate passes between
  /// the points, or the border of a body.
  bool IsSharp(std::uint32_t occluder, const Polygon& points) const;
  /// Whether all that is hidden lies in a cone from x: not of plates that the lamp may touch.
  bool IsCone(std::uint32_t occluder) const;
  /// Whether the side of a plate that x sees is the inside of a body.
  bool SeesInside(std::uint32_t occluder, const Vec2& x) const;

  /// How much of the lamp the occluder hides from x, roughly: parts may be empty. Appends what is
  /// inside of the shadow, of its sides those that cut the lamp.
  Cover Cast(
    std::uint32_t occluder, const Vec2& x, std::vector<LampSurface::HalfSpace>& sides) const;

private:
  /// Linear over the plane z = 0.
  struct Affine
  {
    double constant, x, y;

    double At(const Vec2& place) const
    {
      return this->constant + this->x * place.x + this->y * place.y;
    }
  };
  struct Edge
  {
    Vec3 along;
    Vec3 moment; ///< of the plane through it and x = 0, its normal, not normalised
  };
  struct Plate
  {
    Plane plane;
    Affine side; ///< distance of x from it
    /// How much of the lamp is beyond the plane for x above it, and below.
    std::array<Cover, 2> beyond;
    /// Where some is on either side, the distance from a plane between plate and lamp, positive on
    /// the plate's side: of what is in the cone all is beyond it, or from elsewhere nothing is.
    std::optional<Affine> before;
    std::uint32_t firstEdge, lastEdge;
    std::optional<Side> inside;
  };
  /// An edge of a body; the second face is none, the number past the last, where the lamp's plane
  /// has cut the first one.
  struct BodyEdge
  {
    Edge line;
    std::uint32_t first, second;
  };
  struct Body
  {
    std::vector<Affine> faces; ///< distance of x from each
    std::vector<BodyEdge> edges;
    /// Distance from a plane between body and lamp, positive on the body's side.
    Affine before;
  };
  struct Occluder
  {
    bool isBody;
    std::uint32_t index; ///< among its kind
  };
  using HalfSpace = LampSurface::HalfSpace;

  void FindHull();
  static Cover CoverOf(bool anyInside, bool anyOutside);
  template <typename HeightOf>
  static Cover CoverOfHeights(const std::vector<Vec3>& corners, const HeightOf& heightOf);
  static Affine DistanceFrom(const Plane& plane);
  static Edge EdgeBetween(const Vec3& from, const Vec3& to);
  static HalfSpace SideBehind(const Edge& edge, double sign, const Vec2& x);
  Cover HullBehind(const HalfSpace& side) const;
  Cover LampBehind(const HalfSpace& side) const;
  bool PassesBetween(const Edge& edge, double sign, const Polygon& points) const;

  std::array<Cover, 2> LampBeyond(const Plane& plane) const;
  Cover HullBehindEdge(std::uint32_t edge, double sign, const Vec2& x) const;
  bool HidesAllFrom(const Plate& plate, const Vec2& x) const;
  double CommonSide(const Plate& plate, const Polygon& points) const;
  bool IsSharp(const Plate& plate, const Polygon& points) const;
  Cover Cast(const Plate& plate, const Vec2& x, std::vector<HalfSpace>& sides) const;

  std::optional<Plane> FaceInFrontOf(const std::vector<Vec3>& corners) const;
  std::optional<Plane> PlaneBetween(const ConvexBody& body) const;
  static void AddEdges(const ConvexBody& whole, const std::optional<Plane>& front, Body& body);
  template <typename Visit>
  static bool ForEachOutlineEdge(const Body& body, const Vec2& x, const Visit& visit);
  bool IsSharp(const Body& body, const Polygon& points) const;
  Cover Cast(const Body& body, const Vec2& x, std::vector<HalfSpace>& sides) const;

  const LampSurface* Lamp;
  std::vector<Vec3> Hull; ///< corners of a convex polygon or body that holds the lamp
  std::vector<Occluder> Occluders;
  std::vector<Plate> Plates;
  std::vector<Edge> PlateEdges;
  std::vector<Affine> HullHeights; ///< of its corners above the plane through x and each of those
  std::vector<Body> Bodies;
};

} // namespace vantage
