#include "core/view/SpotPlanes.h"

#include "core/mesh/DisjointSets.h"
#include "core/mesh/FacetEdges.h"
#include "core/mesh/TouchingBoxes.h"
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
/// Cosines of the angles that planes of one curved surface make with a neighbour (15 degrees), and
/// with the one that the others are seen from (30 degrees).
constexpr double SmoothEdge = 0.966;
constexpr double SmoothSurface = 0.866;

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
    std::vector<Box> boxes;
    for (const std::uint32_t member : members)
    {
      boxes.emplace_back(patches[member].shape);
    }
    ForEachTouchingPair(boxes, tolerance,
      [&sets, &members = members](std::uint32_t a, std::uint32_t b)
      { sets.Join(members[a], members[b]); });
  }
  std::vector<std::uint32_t> first(patches.size());
  for (std::uint32_t i = 0; i < patches.size(); ++i)
  {
    first[i] = sets.Find(i);
  }
  return first;
}

/// Joins planes with few spots that follow each other smoothly, as the triangles of a ball do: what
/// falls onto them varies as it does on the ball. For each patch the first one of its plane, or of
/// the plane that those around it are seen from.
std::vector<std::uint32_t> JoinSmoothly(const std::vector<SpotPatch>& patches,
  const std::vector<std::uint32_t>& planeOf, const std::vector<bool>& hasFewSpots)
{
  std::vector<std::vector<std::uint32_t>> neighbours(patches.size());
  const auto cosine = [&](std::uint32_t a, std::uint32_t b)
  { return glm::dot(patches[a].plane.normal, patches[b].plane.normal); };
  const auto meet = [&](std::uint32_t first, std::uint32_t second)
  {
    const std::uint32_t a = planeOf[first];
    const std::uint32_t b = planeOf[second];
    if (a != b && hasFewSpots[a] && hasFewSpots[b] && cosine(a, b) > SmoothEdge)
    {
      neighbours[a].push_back(b);
      neighbours[b].push_back(a);
    }
  };
  const std::vector<FacetEdge> edges = EdgesOf(static_cast<std::uint32_t>(patches.size()),
    [&](std::uint32_t i) -> PolygonView { return patches[i].shape; });
  ForEachEdge(edges,
    [&](auto first, const auto last)
    {
      for (auto next = first + 1; next != last; first = next++)
      {
        meet(first->facet, next->facet);
      }
    });
  std::vector<std::uint32_t> surfaceOf(patches.size(), None);
  std::vector<std::uint32_t> open;
  for (std::uint32_t seed = 0; seed < patches.size(); ++seed)
  {
    if (planeOf[seed] != seed || surfaceOf[seed] != None)
    {
      continue;
    }
    surfaceOf[seed] = seed;
    open.assign(1, seed);
    for (std::size_t k = 0; k < open.size(); ++k)
    {
      for (const std::uint32_t next : neighbours[open[k]])
      {
        if (surfaceOf[next] == None && cosine(seed, next) > SmoothSurface)
        {
          surfaceOf[next] = seed;
          open.push_back(next);
        }
      }
    }
  }
  for (std::uint32_t i = 0; i < patches.size(); ++i)
  {
    surfaceOf[i] = surfaceOf[planeOf[i]];
  }
  return surfaceOf;
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

/// Of the patch of each spot, the place among the patches.
std::vector<std::uint32_t> PlacesOf(
  const std::vector<IndirectSpot>& spots, const std::vector<SpotPatch>& patches)
{
  std::vector<std::uint32_t> places;
  places.reserve(spots.size());
  auto patch = patches.begin();
  for (const IndirectSpot& spot : spots)
  {
    if (patch->patch != spot.patch)
    {
      patch = std::lower_bound(patches.begin(), patches.end(), spot.patch,
        [](const SpotPatch& a, PatchId id) { return a.patch < id; });
    }
    places.push_back(static_cast<std::uint32_t>(patch - patches.begin()));
  }
  return places;
}

/// Of each plane, whether a cell would do for it.
std::vector<bool> HaveFewSpots(const std::vector<std::uint32_t>& patchOfSpot,
  const std::vector<std::uint32_t>& planeOf, std::size_t mostSpots)
{
  std::vector<std::size_t> counts(planeOf.size(), 0);
  for (const std::uint32_t patch : patchOfSpot)
  {
    ++counts[planeOf[patch]];
  }
  std::vector<bool> few;
  for (const std::size_t count : counts)
  {
    few.push_back(count <= mostSpots);
  }
  return few;
}

/// The spots of a surface.
struct Plot
{
  std::vector<SurfaceSpot> spots;
  Vec3 low, high;
};

} // namespace

std::vector<IndirectSurface> SurfacesOf(
  const OccluderScene& occluders, const std::vector<IndirectSpot>& spots, std::size_t mostSpots)
{
  const std::vector<SpotPatch> patches = PatchesOf(occluders, spots);
  const std::vector<std::uint32_t> planeOf = JoinPlanes(occluders, patches);
  const std::vector<std::uint32_t> patchOf = PlacesOf(spots, patches);
  const std::vector<std::uint32_t> surfaceOf =
    JoinSmoothly(patches, planeOf, HaveFewSpots(patchOf, planeOf, mostSpots));
  std::vector<PatchFrame> frames;
  for (const SpotPatch& patch : patches)
  {
    frames.emplace_back(patch.shape);
  }
  std::vector<Plot> plots(patches.size());
  std::vector<bool> isCurved(patches.size(), false);
  for (std::uint32_t i = 0; i < spots.size(); ++i)
  {
    const std::uint32_t surface = surfaceOf[patchOf[i]];
    isCurved[surface] = isCurved[surface] || planeOf[patchOf[i]] != surface;
    Plot& plot = plots[surface];
    const Vec3& point = spots[i].point;
    plot.low = plot.spots.empty() ? point : glm::min(plot.low, point);
    plot.high = plot.spots.empty() ? point : glm::max(plot.high, point);
    plot.spots.push_back({ frames[surface].InPlane(point), spots[i].weight, i });
  }
  std::vector<IndirectSurface> surfaces;
  for (std::uint32_t p = 0; p < plots.size(); ++p)
  {
    if (!plots[p].spots.empty())
    {
      const std::size_t most =
        std::min(mostSpots, std::max<std::size_t>(1, plots[p].spots.size() / LeastCells));
      surfaces.emplace_back(std::move(plots[p].spots),
        isCurved[p] ? std::vector<Foot>()
                    : FeetIn(occluders, frames[p], plots[p].low, plots[p].high),
        most);
    }
  }
  return surfaces;
}

} // namespace vantage
