#pragma once

#include "core/math/Image.h"
#include "core/mesh/PatchMesh.h"
#include "core/scene/Camera.h"
#include "core/visibility/OccluderScene.h"

#include <cstdint>
#include <vector>

/// \file ElementImage.h
/// The solved elements seen by a camera: primary rays, radiance interpolated over the elements.

namespace vantage
{

struct ElementImageSettings
{
  int width = 512;           ///< pixels, >= 1
  int height = 512;          ///< pixels, >= 1
  int samplesPerPixel = 4;   ///< stratified over the pixel, >= 1
  bool pixelCentres = false; ///< one ray through the centre of each pixel (no antialiasing)
  bool flat = false;         ///< one radiance an element, without interpolation
  std::uint64_t seed = 1;

  /// \throw InputError naming the first value out of range.
  void Validate() const;
};

/// Radiance of a surface that carries one value for each polygon (averaged to its points by
/// PointValues) at the points the camera sees, by mean value coordinates (Floater 2003) on each
/// element's polygon: continuous across elements of different levels. Black where a ray meets
/// nothing or the back of a one-sided facet. Parallel over rows, deterministic.
Image RenderElements(const OccluderScene& occluders, const ElementTree& tree,
  const ElementSurface& surface, const std::vector<Color>& radianceOfPolygon, const Camera& camera,
  const ElementImageSettings& settings);

/// Interpolated radiance at points of a surface.
class SurfaceInterpolator
{
public:
  /// Keeps references to tree and surface; they must outlive it.
  SurfaceInterpolator(const ElementTree& tree, const ElementSurface& surface,
    const std::vector<Color>& radianceOfPolygon, bool flat = false);

  /// At a point of a patch; (0,0,0) on an inactive patch.
  Color At(PatchId patch, const Vec3& point) const;

private:
  const ElementTree* Tree;
  const ElementSurface* Surface;
  std::vector<Color> PolygonValues;
  std::vector<Color> PointColors; ///< empty when flat
  std::vector<std::uint32_t> PolygonOfNode;
};

} // namespace vantage
