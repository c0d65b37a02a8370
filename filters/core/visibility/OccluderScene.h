#pragma once

#include "core/mesh/ElementTree.h"

#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

/// \file OccluderScene.h
/// Rays against the facets of a scene (Embree).

namespace vantage
{

/// What a ray met first.
struct Hit
{
  std::uint32_t facet;
  Side side;       ///< the side the ray came from, decided by the geometric normal
  Vec3 point;      ///< on the facet's plane
  double distance; ///< in lengths of the ray's direction

  PatchId Patch() const { return PatchOf(this->facet, this->side); }
};

/// One end of an occlusion query: a point of a facet.
struct SurfacePoint
{
  Vec3 position;
  std::uint32_t facet;
};

/// All facets as occluders, each once, both sides opaque. Embree works in single precision, so the
/// scene is moved to the origin and scaled to unit size first: results are the same in millimetres
/// and kilometres, near and far from the origin. Safe to query from many threads.
class OccluderScene
{
public:
  /// O(n log n); keeps a copy of the shapes. \throw Error when Embree refuses.
  explicit OccluderScene(const FacetSet& facets);
  ~OccluderScene();
  OccluderScene(OccluderScene&&) noexcept;
  OccluderScene& operator=(OccluderScene&&) noexcept;

  /// Whether a facet other than the two at the ends cuts the open segment between the points. The
  /// facets at the ends are flat and never hide their own points; facets coplanar with an end and
  /// touching it do not hide it either (relative offset of a few float roundings of the scene).
  bool IsOccluded(const SurfacePoint& from, const SurfacePoint& to) const;

  /// First facet along origin + t * direction, t > 0, other than `ignore` (the facet the ray
  /// leaves from, or None).
  std::optional<Hit> Intersect(
    const Vec3& origin, const Vec3& direction, std::uint32_t ignore = None) const;

  /// Facets whose shape reaches into the axis-aligned box.
  std::vector<std::uint32_t> FacetsInBox(const Vec3& low, const Vec3& high) const;

private:
  struct Implementation;
  std::unique_ptr<Implementation> Impl;
};

} // namespace vantage
