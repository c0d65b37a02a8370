#pragma once

#include "core/mesh/Facets.h"
#include "core/view/FaceParts.h"
#include "core/view/LampSurface.h"

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
/// Each shadow in turn takes its part of what is left of a face of the lamp, and leaves the rest in
/// convex parts: few for any number of pieces that one surface was cut into, or of faces of one
/// body. Of a lamp with many faces most are seen as a whole, or not at all.
class LampCutter
{
public:
  /// \param lamp must outlive this
  explicit LampCutter(const LampSurface& lamp);

  /// \param shape above the plane, with an area; in front of the lamp if that is flat
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
  enum class Cover
  {
    None,
    Part,
    Whole
  };
  struct Occluder
  {
    Plane plane;
    Affine side; ///< distance of x from it
    /// How much of the lamp is beyond the plane for x above it, and below.
    std::array<Cover, 2> beyond;
    std::uint32_t firstEdge, lastEdge;
    std::optional<Side> inside;
  };

  void FindHull();
  static Cover CoverOf(bool anyInside, bool anyOutside);
  std::array<Cover, 2> LampBeyond(const Plane& plane) const;
  bool HidesAllFrom(const Occluder& occluder, const Vec2& x) const;
  static bool IsInside(const Occluder& occluder, const Vec2& x);
  double CommonSide(const Occluder& occluder, const Polygon& points) const;
  static LampSurface::HalfSpace SideBehind(const Edge& edge, double sign, const Vec2& x);
  Cover HullBehind(std::uint32_t edge, double sign, const Vec2& x) const;
  Cover LampBehind(std::uint32_t edge, double sign, const Vec2& x) const;
  Cover Cast(const Occluder& occluder, const Vec2& x, Shadows& shadows) const;
  std::optional<double> SeenOfFaces(Shadows& shadows, const Vec2& x) const;
  void SortFaces(Shadows& shadows) const;
  static std::optional<double> SeenOfFace(
    const FaceParts::Face& face, Shadows& shadows, const Vec2& x);

  const LampSurface* Lamp;
  std::optional<FaceParts::Face> Only; ///< of a lamp that has one only
  std::vector<Vec3> Hull;              ///< corners of a convex polygon or body that holds the lamp
  std::vector<Occluder> Occluders;
  std::vector<Edge> Edges;
  std::vector<Affine> HullHeights; ///< of its corners above the plane through x and each edge
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
  /// What an occluder hides: all that is in front of some planes, those through its edges and its
  /// own, of which those count that cut the lamp. Sides[firstSide .. lastSide).
  struct Shadow
  {
    std::uint32_t firstSide, lastSide;

    int Count() const { return static_cast<int>(this->lastSide - this->firstSide); }
  };
  struct FaceInShadow
  {
    std::uint32_t face;
    Shadow shadow;
  };

  std::vector<LampSurface::HalfSpace> Sides;
  std::vector<Shadow> All;
  LampSurface::Workspace Room;      ///< the faces that are seen as a whole
  std::vector<std::uint32_t> Faces; ///< that one shadow hides in part
  std::vector<FaceInShadow> Partly; ///< by face
  std::vector<Shadow> OfFace;       ///< those that hide a part of one face
  FaceParts Parts;                  ///< what is left of that
  std::size_t Effort = 0;           ///< for the last point
  bool TooMany = false;
};

} // namespace vantage
