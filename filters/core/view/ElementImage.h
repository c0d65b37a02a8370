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

/// Looks values of a surface up at points of it.
class SurfaceInterpolator
{
public:
  /// Keeps references to tree and surface; they must outlive it. O(nodes).
  SurfaceInterpolator(const ElementTree& tree, const ElementSurface& surface);

  /// The polygon that shows a point of a patch; None on an inactive one. O(levels).
  std::uint32_t PolygonAt(PatchId patch, const Vec3& point) const;

  /// Of one value for each point of the surface, by mean value coordinates (Floater 2003) on the
  /// polygon that shows the point: continuous across elements of different levels. (0,0,0) on an
  /// inactive patch.
  Color At(const std::vector<Color>& valueOfPoint, PatchId patch, const Vec3& point) const;

private:
  const ElementTree* Tree;
  const ElementSurface* Surface;
  std::vector<std::uint32_t> PolygonOfNode;
};

/// The radiance of a surface at the points the camera sees. `radiance` has one value for each point
/// of the surface or, where the settings say flat, one for each polygon. Black where a ray meets
/// nothing or the back of a one-sided facet. Parallel over rows, deterministic.
Image RenderElements(const OccluderScene& occluders, const ElementTree& tree,
  const ElementSurface& surface, const std::vector<Color>& radiance, const Camera& camera,
  const ElementImageSettings& settings);

} // namespace vantage
