#pragma once

#include "core/view/FaceParts.h"
#include "core/view/LampSurface.h"
#include "core/view/ShadowCones.h"

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
/// parts: few for any number of pieces that one surface was cut into. Of a lamp with many faces
/// that is what is inside of its outline as the point sees it, and where that is not one line, or
/// an occluder may touch the lamp, each face that is not seen as a whole, or not at all.
class LampCutter
{
public:
  /// \param lamp must outlive this
  explicit LampCutter(const LampSurface& lamp);

  /// What may hide the lamp.
  ShadowCones& Occluders() { return this->Cones; }
  const ShadowCones& Occluders() const { return this->Cones; }

  /// An occluder that is to be reckoned with, and whether the points are known to be outside of
  /// the body that it belongs to: then there are others of it by which all enters the body that
  /// comes to its inside.
  struct Suspect
  {
    std::uint32_t occluder;
    bool isSeenFromOutside = false;
  };

  /// What some other thread must not use meanwhile.
  class Shadows;

  /// What x sees past some of the occluders, in sr. \pre x is in front of the lamp. Nothing where
  /// the shadows leave so many parts that a few hundred rays are quicker.
  std::optional<double> Seen(
    const Vec2& x, const std::vector<Suspect>& suspects, Shadows& shadows) const;

private:
  std::optional<double> SeenPast(const Vec2& x, Shadows& shadows) const;
  bool FindOutline(const Vec2& x, Shadows& shadows) const;
  std::optional<double> SeenOfFaces(const Vec2& x, Shadows& shadows) const;
  bool SortFaces(Shadows& shadows) const;
  static std::optional<double> SeenOfFace(
    const FaceParts::Face& face, const Vec2& x, Shadows& shadows);

  const LampSurface* Lamp;
  ShadowCones Cones;
  std::optional<FaceParts::Face> Only; ///< of a lamp that has one only
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
  /// What an occluder hides: all that is in front of some planes, of which those count that cut the
  /// lamp. Sides[firstSide .. lastSide).
  struct Shadow
  {
    std::uint32_t firstSide, lastSide;

    std::size_t Count() const { return this->lastSide - this->firstSide; }
  };
  struct FaceInShadow
  {
    std::uint32_t face;
    Shadow shadow;
  };

  std::vector<LampSurface::HalfSpace> Sides;
  std::vector<Shadow> All;
  bool AreCones = true;             ///< all of them
  LampSurface::Workspace Room;      ///< the faces that are seen as a whole
  std::vector<Vec3> Outline;        ///< around those
  FaceParts::Face Silhouette;       ///< the same, in a plane that x looks onto
  std::vector<std::uint32_t> Faces; ///< that one shadow hides in part
  std::vector<FaceInShadow> Partly; ///< by face
  std::vector<Shadow> OfFace;       ///< those that hide a part of one face
  FaceParts Parts;                  ///< what is left of that
  std::size_t Effort = 0;           ///< for the last point
  bool TooMany = false;
};

} // namespace vantage
