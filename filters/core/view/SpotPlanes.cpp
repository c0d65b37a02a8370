#include "core/view/SpotPlanes.h"

#include "core/math/Box.h"
#include "core/mesh/DisjointSets.h"
#include "core/view/PatchFrame.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

namespace vantage
{

namespace
{

/// Planes are the same when normals and offsets, in sizes of the patch, agree to about this.
constexpr double SamePlane = 1e-6;
/// A facet whose lowest point is nearer to a plane than this part of the facet stands on it.
constexpr double Standing = 1e-3;
/// A plane has this many cells at least, if it has so many spots.
constexpr std::size_t LeastCells = 8;

struct SpotPatch
{
  PatchId patch;
  Polygon shape; ///< counter-clockwise from its side
  Plane plane;
};

std::vector<SpotPatch> PatchesOf(
  const OccluderScene& occluders, const std::vector<IndirectSpot>& spots)
{
  std::vector<PatchId> ids(spots.size());
  std::transform(
    spots.begin(), spots.end(), ids.begin(), [](const IndirectSpot& spot) { return spot.patch; });
  std::sort(ids.begin(), ids.end());
  ids.erase(std::unique(ids.begin(), ids.end()), ids.end());
  std::vector<SpotPatch> patches;
  for (const PatchId id : ids)
  {
    const Polygon shape = ShapeOf(occluders, id);
    patches.push_back({ id, shape, SupportingPlane(shape) });
  }
  return patches;
}

/// For each patch the first one of its plane.
std::vector<std::uint32_t> JoinPlanes(
  const OccluderScene& occluders, const std::vector<SpotPatch>& patches)
{
  // A plane whose rounded numbers fall apart is two planes: no harm but a few points more.
  std::map<std::array<long long, 4>, std::vector<std::uint32_t>> alike;
  double unit = 0.0;
  for (const SpotPatch& patch : patches)
  {
    unit = std::max(unit, RadiusAround(patch.shape, patch.shape[0]));
  }
  for (std::uint32_t i = 0; i < patches.size(); ++i)
  {
    const Plane& plane = patches[i].plane;
    alike[{ std::llround(plane.normal.x / SamePlane), std::llround(plane.normal.y / SamePlane),
            std::llround(plane.normal.z / SamePlane),
            std::llround(plane.offset / (SamePlane * unit)) }]
      .push_back(i);
  }
  DisjointSets sets(patches.size());
  const double tolerance = 2.0 * occluders.Tolerance();
  for (const auto& [key, members] : alike)
  {
    for (std::size_t a = 0; a < members.size(); ++a)
    {
      const Box box(patches[members[a]].shape);
      for (std::size_t b = a + 1; b < members.size(); ++b)
      {
        if (box.Touches(Box(patches[members[b]].shape), tolerance))
        {
          sets.Join(members[a], members[b]);
        }
      }
    }
  }
  std::vector<std::uint32_t> first(patches.size());
  for (std::uint32_t i = 0; i < patches.size(); ++i)
  {
    first[i] = sets.Find(i);
  }
  return first;
}

/// Where facets stand on the plane z = 0 of the frame, near the box.
std::vector<Foot> FeetIn(
  const OccluderScene& occluders, const PatchFrame& frame, const Vec3& low, const Vec3& high)
{
  std::vector<Foot> feet;
  // Those along the border tell where the others end.
  const double margin = Standing * glm::length(high - low);
  for (const std::uint32_t facet : occluders.FacetsInBox(low - margin, high + margin))
  {
    const Polygon shape = occluders.Shape(facet);
    const double contact = Standing * RadiusAround(shape, shape[0]);
    Polygon local;
    double highest = 0.0;
    for (const Vec3& v : shape)
    {
      local.Add(frame.ToLocal(v));
      highest = std::max(highest, local[local.Size() - 1].z);
    }
    // What of the facet lies in a thin layer on the plane; its longest way is the foot.
    const Polygon layer = ClipToFront(
      ClipToFront(local, { Vec3(0.0, 0.0, 1.0), -contact }), { Vec3(0.0, 0.0, -1.0), -contact });
    if (layer.Empty() || highest <= 2.0 * contact)
    {
      continue;
    }
    Foot foot{ Vec2(layer[0]), Vec2(layer[0]) };
    for (const Vec3& a : layer)
    {
      for (const Vec3& b : layer)
      {
        if (glm::distance(Vec2(a), Vec2(b)) > glm::distance(foot.from, foot.to))
        {
          foot = { Vec2(a), Vec2(b) };
        }
      }
    }
    if (foot.from != foot.to)
    {
      feet.push_back(foot);
    }
  }
  return feet;
}

} // namespace

std::vector<IndirectSurface> SurfacesOf(
  const OccluderScene& occluders, const std::vector<IndirectSpot>& spots, std::size_t mostSpots)
{
  const std::vector<SpotPatch> patches = PatchesOf(occluders, spots);
  const std::vector<std::uint32_t> planeOf = JoinPlanes(occluders, patches);
  std::vector<PatchFrame> frames;
  for (const SpotPatch& patch : patches)
  {
    frames.emplace_back(patch.shape);
  }
  struct Plot
  {
    std::vector<SurfaceSpot> spots;
    Vec3 low, high;
  };
  std::vector<Plot> plots(patches.size());
  auto patch = patches.begin();
  for (std::uint32_t i = 0; i < spots.size(); ++i)
  {
    if (patch->patch != spots[i].patch)
    {
      patch = std::lower_bound(patches.begin(), patches.end(), spots[i].patch,
        [](const SpotPatch& a, PatchId id) { return a.patch < id; });
    }
    const std::uint32_t plane = planeOf[patch - patches.begin()];
    Plot& plot = plots[plane];
    const Vec3& point = spots[i].point;
    plot.low = plot.spots.empty() ? point : glm::min(plot.low, point);
    plot.high = plot.spots.empty() ? point : glm::max(plot.high, point);
    plot.spots.push_back({ frames[plane].InPlane(point), spots[i].weight, i });
  }
  std::vector<IndirectSurface> surfaces;
  for (std::uint32_t p = 0; p < plots.size(); ++p)
  {
    if (!plots[p].spots.empty())
    {
      const std::size_t most =
        std::min(mostSpots, std::max<std::size_t>(1, plots[p].spots.size() / LeastCells));
      surfaces.emplace_back(
        std::move(plots[p].spots), FeetIn(occluders, frames[p], plots[p].low, plots[p].high), most);
    }
  }
  return surfaces;
}

} // namespace vantage
