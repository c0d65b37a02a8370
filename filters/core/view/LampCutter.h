#pragma once

#include "core/mesh/Facets.h"
#include "core/view/LampKernel.h"

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

/// \file LampCutter.h
/// What many points of one plane see of a lamp past the same few occluders.

namespace vantage
{

/// The same as PointToVisiblePolygon(), for the points of the plane z = 0 with normal +z, in a
/// tenth of the time: the shadow that an occluder casts from the point onto the lamp is convex.
/// Each shadow in turn takes its part of what is left of the lamp, and leaves the rest in convex
/// parts: few for any number of pieces that one surface was cut into, or of faces of one body.
class LampCutter
{
public:
  /// \param lamp above the plane, with an area
  explicit LampCutter(const Polygon& lamp);

  /// \param shape above the plane and in front of the lamp, with an area
  /// \param inside the side that is the inside of a closed body, if one is
  /// \return its number, from 0
  std::uint32_t AddOccluder(const Polygon& shape, std::optional<Side> inside = {});

  /// Whether the occluder hides all of the lamp from all of a convex polygon in the plane.
  bool HidesAll(std::uint32_t occluder, const Polygon& points) const;

  /// An occluder that is to be reckoned with, and whether the points are known to be outside of
  /// the body that it belongs to: then there are others of it by which all enters the body that
  /// comes to its inside.
  struct Suspect
  {
    std::uint32_t occluder;
    bool isSeenFromOutside = false;
  };

  /// Whether the lamp is on one side of an edge of the occluder as one of some points sees it, and
  /// on the other side as another one does: then the edge of the shadow is narrower than the points
  /// lie apart, and all of it may fall between them. Or whether the plane of the occluder passes
  /// between the points.
  bool IsSharp(std::uint32_t occluder, const Polygon& points) const;

  /// What some other thread must not use meanwhile.
  class Shadows;

  /// What x sees past some of the occluders, in sr. \pre x is in front of the lamp. Nothing where
  /// the shadows leave so many parts that a few hundred rays are quicker.
  std::optional<double> Seen(
    const Vec2& x, const std::vector<Suspect>& suspects, Shadows& shadows) const;

private:
  static constexpr int MostCorners = Polygon::Capacity;

  /// In the plane of the lamp.
  struct Flat
  {
    std::array<Vec2, MostCorners> corners;
    int count = 0;
  };
  using Heights = std::array<double, MostCorners>; ///< of the corners of such a polygon
  struct Line
  {
    Vec2 normal;
    double offset; ///< inside where dot(normal, y) + offset >= 0
  };
  /// A shadow on the plane of the lamp: those sides of it that cut the lamp.
  struct Shadow
  {
    std::array<Line, MostCorners> sides;
    int count = 0;
  };
  /// Linear over the plane z = 0.
  struct Affine
  {
    double constant, x, y;

    double At(const Vec2& place) const
    {
      return this->constant + this->x * place.x + this->y * place.y;
    }
  };
  /// The plane through x and an edge of an occluder, not normalised, for all x at once.
  struct Edge
  {
    Affine towardsA, towardsB; ///< its normal times the axes of the plane of the lamp
    Affine height;             ///< of the lamp's origin above it
  };
  struct Occluder
  {
    Affine side; ///< of its plane that x is on, by the sign
    std::uint32_t firstEdge, lastEdge;
    std::optional<Side> inside;
  };
  enum class Cover
  {
    None,
    Part,
    Whole
  };

  static bool IsInside(const Occluder& occluder, const Vec2& x);
  double CommonSide(const Occluder& occluder, const Polygon& points) const;
  Cover CoverBehind(std::uint32_t edge, double sign, const Vec2& x) const;
  Cover Cast(const Occluder& occluder, const Vec2& x, Shadow& shadow) const;
  static void CutAt(const Flat& whole, const Heights& heights, double side, Flat& cut);
  static double Area(const Flat& part);
  void AppendOutside(const Flat& part, const Shadow& shadow, std::vector<Flat>& parts) const;
  void Cut(Shadows& shadows, const Shadow& shadow) const;
  std::optional<double> SeenPast(Shadows& shadows, const Vec2& x) const;
  double Measure(const Flat& part, const Vec2& x) const;

  LampKernel Kernel; ///< of all of the lamp
  Polygon Shape;
  Vec3 Origin{ 0.0 }, A{ 0.0 }, B{ 0.0 }; ///< of the plane of the lamp
  Flat Lamp;
  double Sliver = 0.0; ///< the area of a part that is not worth keeping
  std::vector<Occluder> Occluders;
  std::vector<Edge> Edges;
  std::vector<Affine> CornerHeights; ///< of the lamp's corners above the plane of each edge
};

/// Room for the shadows that one point sees.
class LampCutter::Shadows
{
public:
  /// Whether the last call of Seen() had to cut.
  bool Any() const { return !this->All.empty(); }
  /// Whether it has found nothing: nor will it, most likely, at the next point.
  bool AreTooMany() const { return this->TooMany; }

private:
  friend class LampCutter;
  std::vector<Shadow> All;
  std::vector<Flat> Parts; ///< that are left of the lamp
  std::vector<Flat> Rest;  ///< of these, past one more shadow
  bool TooMany = false;
};

} // namespace vantage
