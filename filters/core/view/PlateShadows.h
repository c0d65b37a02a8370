#pragma once

#include "core/mesh/ElementTree.h"
#include "core/view/LampHull.h"

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

/// \file PlateShadows.h
/// What flat occluders hide of a lamp: ShadowCones.h, which says what the calls mean.

namespace vantage
{

/// From a point of z = 0 a plate hides what is beyond its plane, within the cone of its edges.
class PlateShadows
{
public:
  /// \param lamp must outlive this
  explicit PlateShadows(const LampHull& lamp)
    : Lamp(&lamp)
  {
  }

  /// Returns its number. As ShadowCones::AddPlate()
  std::uint32_t Add(const Polygon& shape, std::optional<Side> inside);

  bool HidesAll(std::uint32_t index, const Polygon& points) const;
  bool IsSharp(std::uint32_t index, const Polygon& points) const;
  bool IsCone(std::uint32_t index) const { return this->Plates[index].beyond[0] != Cover::Part; }
  bool SeesInside(std::uint32_t index, const Vec2& x) const;
  Cover Cast(std::uint32_t index, const Vec2& x, std::vector<LampSurface::HalfSpace>& sides) const;

private:
  struct Plate
  {
    Plane plane;
    AffineOverPlane side; ///< distance of x from it
    /// How much of the lamp is beyond the plane for x above it, and below.
    std::array<Cover, 2> beyond;
    /// Where some is on either side, the distance from a plane between plate and lamp, positive on
    /// the plate's side: of what is in the cone all is beyond it, or from elsewhere nothing is.
    std::optional<AffineOverPlane> before;
    std::uint32_t firstEdge, lastEdge;
    std::optional<Side> inside;
  };

  std::array<Cover, 2> LampBeyond(const Plane& plane) const;
  void AddEdge(const Vec3& from, const Vec3& to);
  Cover HullBehind(std::uint32_t edge, double sign, const Vec2& x) const;
  bool HidesAllFrom(const Plate& plate, const Vec2& x) const;
  static double CommonSide(const Plate& plate, const Polygon& points);

  const LampHull* Lamp;
  std::vector<Plate> Plates;
  std::vector<ShadowEdge> Edges;
  /// Of the corners of the hull above the plane through x and each of those.
  std::vector<AffineOverPlane> HullHeights;
};

} // namespace vantage
