#pragma once

#include "core/reference/LampTree.h"
#include "core/reference/PathTracer.h"

#include <cstdint>

/// \file PathSampler.h
/// Random estimates of the radiance along one ray.

namespace vantage
{

/// The samples of one pixel draw their random numbers from here: number `index` of the streams that
/// belong to `seed`. Counts the rays traced.
struct PixelSample
{
  std::uint64_t seed;
  std::uint32_t index;
  std::uint64_t rays = 0;
};

/// Follows paths from a ray through the scene. Keeps references; safe to use from many threads.
class PathSampler
{
public:
  PathSampler(const Scene& scene, const FacetSet& facets, const OccluderScene& occluders);

  /// Radiance that arrives at `origin` against `direction`: an unbiased estimate, or with a lookup
  /// a final gather. Over the samples of a pixel the choices at the first hit are stratified.
  Color Radiance(const Vec3& origin, const Vec3& direction, const PathTracerSettings& settings,
    const RadianceLookup& lookup, PixelSample& sample) const;

private:
  /// A point of a path, and how its surface answers on the side the path came from.
  struct Vertex
  {
    Hit hit;
    Vec3 normal; ///< on that side
    Color albedo;
    Color emission;
  };
  /// Uniform numbers of one next-event estimate.
  struct LampNumbers
  {
    double lamp;
    Vec2 place;
  };

  Vertex VertexAt(const Hit& hit) const;
  Color DirectLight(const Vertex& x, const LampNumbers& u, PixelSample& sample) const;
  Color IndirectLight(const Vertex& first, std::uint32_t number, const Vec2& direction,
    const PathTracerSettings& settings, const RadianceLookup& lookup, PixelSample& sample) const;

  const Scene* TheScene;
  const FacetSet* Facets;
  const OccluderScene* Occluders;
  LampTree Lamps;
  std::vector<Vec3> Normals; ///< of the facets' fronts
};

} // namespace vantage
