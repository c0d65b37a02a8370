#pragma once

#include "core/mesh/Bounds.h"
#include "core/view/LampCutter.h"
#include "core/view/NamedLamps.h"
#include "core/view/PatchFrame.h"

#include <cstdint>
#include <optional>
#include <vector>

/// \file LampObstacles.h
/// What may stand between the points of one patch and one lamp.

namespace vantage
{

/// One lamp over one patch, in the coordinates of the patch's frame over a unit. Refers to all.
struct LampOverPatch
{
  const OccluderScene* occluders;
  std::uint32_t facet; ///< of the patch
  const PatchFrame* frame;
  const NamedLamp* named;
  double unit;             ///< scene units in a local one
  const LampSurface* lamp; ///< what of it is in front of the patch, local

  Vec3 ToLocal(const Vec3& place) const { return this->frame->ToLocal(place) / this->unit; }
};

/// The occluders of a LampCutter: facets, and convex bodies as wholes (ConvexBodies.h). The patch
/// itself, the lamp and what is behind it are none, nor are the convex bodies that either belongs
/// to: such a body hides nothing from its own outside.
class LampObstacles
{
public:
  /// \param facets that reach into what is between patch and lamp
  LampObstacles(const LampOverPatch& place, const std::vector<std::uint32_t>& facets);

  /// Has the occluders, whose numbers are those of the obstacles.
  const LampCutter& Cutter() const { return this->TheCutter; }
  std::uint32_t Size() const { return static_cast<std::uint32_t>(this->Obstacles.size()); }
  /// Whether no part of it reaches into a region.
  bool IsElsewhere(std::uint32_t obstacle, const ConvexRegion& region) const;
  /// Whether a facet belongs to a closed body that does not meet a box.
  bool IsSeenFromOutside(std::uint32_t obstacle, const Bounds& box) const;
  /// Whether it is a facet of the surface that the lamp is a part of.
  bool IsOfLamp(std::uint32_t obstacle) const;

private:
  struct Obstacle
  {
    std::uint32_t firstFacet, lastFacet;         ///< one, or those of a body
    std::optional<OccluderScene::Inside> inside; ///< of a facet
    Bounds bounds;                               ///< of a body
  };

  bool AddBody(std::uint32_t body);
  void AddFacet(std::uint32_t facet);
  Polygon Between(std::uint32_t facet) const;
  ConvexBody LocalBody(std::uint32_t body) const;

  LampOverPatch Place;
  LampCutter TheCutter;
  std::vector<Obstacle> Obstacles;
  std::vector<std::uint32_t> Facets; ///< of all obstacles
};

} // namespace vantage
