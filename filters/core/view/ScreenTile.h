#pragma once

#include "core/mesh/ElementTree.h"
#include "core/scene/Camera.h"
#include "core/visibility/OccluderScene.h"

#include <array>
#include <cstdint>
#include <vector>

/// \file ScreenTile.h
/// The few facets that a small part of an image sees.

namespace vantage
{

/// A linear function of the place (s, t) in the image plane.
struct ScreenLine
{
  double constant = 0.0, alongS = 0.0, alongT = 0.0;

  double At(const Vec2& place) const
  {
    return this->constant + place.x * this->alongS + place.y * this->alongT;
  }
};

/// What a place of the image sees.
struct EyeHit
{
  PatchId patch = None;
  double depth = 0.0; ///< in lengths of ImagePlane::Direction()
};

/// A flat facet as the eye sees it. Seen from a point, being inside an edge and one over the depth
/// are both linear in the image plane, in front of the eye and behind it.
struct ScreenFacet
{
  PatchId patch;                   ///< the side that faces the eye
  std::array<ScreenLine, 4> edges; ///< >= 0 inside; grown as OccluderScene grows its facets
  ScreenLine inverseDepth;         ///< > 0 where the ray meets the plane

  bool Covers(const Vec2& place) const;
};

/// A rectangle of pixels, with all that its rays can meet down to some depth: a ray is decided
/// without a search, which takes some nanoseconds a facet.
class ScreenTile
{
public:
  /// Pixels [x, x + width) x [y, y + height) of an image.
  struct Rectangle
  {
    int x, y, width, height;
  };

  /// Cuts the rectangle into tiles that see few facets each.
  static std::vector<ScreenTile> Cut(const OccluderScene& occluders, const ImagePlane& plane,
    const Vec2& pixelSize, const Rectangle& rectangle);

  const Rectangle& Pixels() const { return this->Area; }
  /// Of the image plane, in (s, t): pixel (x, y) starts at pixelSize * (x, y) - 1.
  Vec2 Place(double x, double y) const
  {
    return { x * this->PixelSize.x - 1.0, y * this->PixelSize.y - 1.0 };
  }

  /// What OccluderScene::Intersect() would find. `rays` counts those that had to be traced.
  EyeHit Look(const Vec2& place, std::uint64_t& rays) const;

  /// Whether all of the pixel sees the patch. No is not certain: it is said as well when another
  /// facet may be in front of a part.
  bool SeesOnly(int x, int y, PatchId patch) const;

private:
  ScreenTile(const OccluderScene& occluders, const ImagePlane& plane, const Vec2& pixelSize,
    const Rectangle& rectangle);
  /// Facets and depth. \return false when there are too many facets for a tile
  bool Collect(std::size_t most);
  double DepthOfCorners() const;
  void AddFacet(std::uint32_t facet);

  const OccluderScene* Occluders;
  const ImagePlane* Eye;
  Vec2 PixelSize;
  Rectangle Area;
  std::vector<ScreenFacet> Facets;
  double InverseReach = 0.0; ///< all facets nearer than this are known
};

} // namespace vantage
