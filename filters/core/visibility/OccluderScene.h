#pragma once

#include "core/mesh/ConvexBodies.h"
#include "core/mesh/ElementTree.h"
#include "core/visibility/ConvexRegion.h"

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

/// All facets as occluders, each once, both sides opaque. Embree finds the candidates in single
/// precision, in a scene that was moved to the origin, scaled to unit size and grown by the
/// rounding of a ray; each candidate is then decided in double precision. So results do not depend
/// on the units of the scene, walls without thickness do not leak, and the only tolerance left is
/// Tolerance(): what lies nearer to a facet's plane is on it.
/// Safe to query from many threads; results do not depend on their number.
class OccluderScene
{
public:
  /// O(n log n); keeps a copy of the shapes. \throw Error when Embree refuses.
  explicit OccluderScene(const FacetSet& facets, DarkSides dark = {});
  ~OccluderScene();
  OccluderScene(OccluderScene&&) noexcept;
  OccluderScene& operator=(OccluderScene&&) noexcept;

  /// Whether a facet other than the two at the ends cuts the open segment between the points. A
  /// facet cuts it when the points lie on different sides of its plane, both further away than the
  /// tolerance: so facets coplanar with an end, or touching it, do not hide it.
  bool IsOccluded(const SurfacePoint& from, const SurfacePoint& to) const;

  /// The first facet from `from` that does so, if any.
  std::optional<std::uint32_t> FirstOccluder(
    const SurfacePoint& from, const SurfacePoint& to) const;

  /// First facet along origin + t * direction, t > 0, other than `ignore` (the facet the ray
  /// leaves from, or None) and other than facets the origin lies on. The origin may lie anywhere,
  /// also far outside of the scene; the direction needs no unit length.
  std::optional<Hit> Intersect(
    const Vec3& origin, const Vec3& direction, std::uint32_t ignore = None) const;

  /// Facets whose shape reaches into the axis-aligned box or touches it, in ascending order.
  /// O(log n + found).
  std::vector<std::uint32_t> FacetsInBox(const Vec3& low, const Vec3& high) const;

  /// Facets that reach into a region; touching it is not enough. In ascending order.
  std::vector<std::uint32_t> FacetsInRegion(const ConvexRegion& region) const;

  /// True when no facet reaches into the region and the proof needs to look at no more than
  /// `effort` facets and boxes of facets.
  bool IsProvablyEmpty(const ConvexRegion& region, int effort) const;

  /// The side of a facet that is the inside of a closed body, and the box around that.
  struct Inside
  {
    Side side;
    Bounds body;
  };
  /// Nothing where no side is known to be one, or both are. A segment that starts outside of the
  /// body and passes through this facet from its inside has entered by another facet.
  std::optional<Inside> InsideOf(std::uint32_t facet) const;

  /// The closed body around a side, or None, and which of these are convex.
  std::uint32_t BodyAround(PatchId patch) const;
  const ConvexBodies& Convex() const;

  std::uint32_t FacetCount() const;
  Polygon Shape(std::uint32_t facet) const;

  /// FacetSet::Tolerance(), in scene units.
  double Tolerance() const;

private:
  struct Implementation;
  std::unique_ptr<Implementation> Impl;
};

/// The facet of a patch, counter-clockwise from the patch's side.
inline Polygon ShapeOf(const OccluderScene& occluders, PatchId patch)
{
  const Polygon front = occluders.Shape(patch / 2);
  return patch % 2 == 0 ? front : Reversed(front);
}

/// Towards the patch's side, unit.
inline Vec3 NormalOf(const OccluderScene& occluders, PatchId patch)
{
  const Vec3 front = UnitNormal(occluders.Shape(patch / 2));
  return patch % 2 == 0 ? front : -front;
}

} // namespace vantage
