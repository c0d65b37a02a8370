#pragma once

#include "core/view/BodyShadows.h"
#include "core/view/PlateShadows.h"

#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

/// \file ShadowCones.h
/// What occluders hide of a lamp, as the points of a plane see it.

namespace vantage
{

/// From a point of the plane z = 0, an occluder hides the lamp within a convex cone: that of a
/// plate's edges, or of the outline of a body, whose faces are seen on one side of it and not on
/// the other. So a globe casts one shadow, however many facets it has.
class ShadowCones
{
public:
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
  struct Occluder
  {
    bool isBody;
    std::uint32_t index; ///< among its kind
  };

  std::uint32_t Add(const Occluder& occluder);

  std::unique_ptr<const LampHull> Lamp; ///< the others refer to it
  PlateShadows Plates;
  BodyShadows Bodies;
  std::vector<Occluder> Occluders;
};

} // namespace vantage
