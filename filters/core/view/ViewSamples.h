#pragma once

#include "core/view/ScreenTile.h"
#include "core/view/SurfaceGather.h"

#include <cstdint>
#include <vector>

/// \file ViewSamples.h
/// The points of surfaces that make up an image.

namespace vantage
{

/// What an image is made of.
struct ViewSamples
{
  /// Points of the pixels, one pixel after the other; the weight is the part of the pixel that a
  /// point stands for.
  std::vector<GatherPoint> points;
  std::vector<std::uint32_t> pixelOfPoint;
  std::vector<EyeHit> centres; ///< what the centre of each pixel sees
  std::uint64_t rays = 0;      ///< that were traced
  std::uint64_t looks = 0;     ///< rays that were decided among the facets of a tile
};

/// The parts that a pixel is cut into where one point does not do.
inline constexpr std::uint32_t PartsOfPixel = 16;

/// The middle of a part, in the unit square: of any 2^k equal columns or rows, each has as many.
Vec2 PlaceOfPart(std::uint32_t part);

/// What each pixel sees: its centre or, when `pixelCentres` is false, all of it. A pixel that sees
/// one patch only has its centre as its point; one that may see more is cut into PartsOfPixel
/// parts, and has a point for each patch, weighted by the parts that see it. Inactive sides have
/// points too. Parallel over blocks of pixels; O(pixels + edges of facets in the image).
ViewSamples SampleImage(const OccluderScene& occluders, const ImagePlane& plane, int width,
  int height, bool pixelCentres);

} // namespace vantage
