#include "core/reference/LightMap.h"

#include "core/math/Sampling.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>

namespace vantage
{

LightMap::LightMap(const ReferenceGeometry& geometry, int cells, int rays, std::uint64_t seed)
  : Geometry(&geometry)
  , Rays(rays)
  , Seed(seed)
{
  const std::vector<Facet>& facets = geometry.facets.facets;
  double area = 0.0;
  for (const Facet& facet : facets)
  {
    area += 2.0 * Area(facet.shape);
  }
  const double size = std::sqrt(area / cells);
  std::size_t count = 0;
  for (PatchId p = 0; p < 2 * facets.size(); ++p)
  {
    const Polygon& shape = facets[p / 2].shape;
    Grid grid;
    grid.u = glm::normalize(shape[1] - shape[0]) / size;
    grid.v = glm::cross(UnitNormal(shape), grid.u);
    Vec2 low(0.0);
    Vec2 high(0.0);
    for (const Vec3& corner : shape)
    {
      const Vec2 at(glm::dot(corner - shape[0], grid.u), glm::dot(corner - shape[0], grid.v));
      low = glm::min(low, at);
      high = glm::max(high, at);
    }
    // Shifted at random, so that cells of two maps do not end at the same shadows.
    RandomStream random(seed, p);
    low -= random.Next2();
    grid.origin = shape[0] + size * size * (low.x * grid.u + low.y * grid.v);
    grid.across = static_cast<int>(high.x - low.x) + 1;
    grid.along = static_cast<int>(high.y - low.y) + 1;
    grid.first = count;
    count += static_cast<std::size_t>(grid.across) * grid.along;
    this->Grids.push_back(grid);
  }
  this->PointOfCell.assign(count, Nowhere);
}

std::size_t LightMap::CellOf(const Hit& hit) const
{
  const Grid& grid = this->Grids[hit.Patch()];
  const Vec3 r = hit.point - grid.origin;
  const int x = std::clamp(static_cast<int>(glm::dot(r, grid.u)), 0, grid.across - 1);
  const int y = std::clamp(static_cast<int>(glm::dot(r, grid.v)), 0, grid.along - 1);
  return grid.first + static_cast<std::size_t>(y) * grid.across + x;
}

std::uint32_t LightMap::Visit(const std::optional<Hit>& hit)
{
  if (!hit)
  {
    return Nowhere;
  }
  std::uint32_t& point = this->PointOfCell[this->CellOf(*hit)];
  if (point == Nowhere)
  {
    const SurfacePlace place = this->Geometry->PlaceOf(*hit);
    if (MaxChannel(place.albedo) > 0.0)
    {
      point = static_cast<std::uint32_t>(this->Points.size());
      this->Points.push_back(place);
      this->Visits.push_back(1);
    }
  }
  else if (point >= this->Direct.size())
  {
    // Nobody has looked at it yet: each visit is as likely as another to be the one that stays.
    const std::uint32_t visit = ++this->Visits[point];
    if (ToUnit(Hash(this->Seed, point, visit)) * visit < 1.0)
    {
      this->Points[point].hit = *hit;
    }
  }
  return point;
}

/// Finds direct light and targets of points; the targets may be new points.
void LightMap::Expand(std::size_t first, std::size_t last)
{
  std::vector<std::vector<std::optional<Hit>>> hits(last - first);
  this->Direct.resize(last);
  tbb::parallel_for(first, last,
    [&](std::size_t i)
    {
      const SurfacePlace& place = this->Points[i];
      this->Direct[i] = this->Geometry->direct.At(place.hit, place.normal);
      hits[i - first] = this->Geometry->Gather(place, this->Rays, Hash(this->Seed, i));
    });
  for (const auto& hitsOfPoint : hits)
  {
    for (const auto& hit : hitsOfPoint)
    {
      this->Targets.push_back(this->Visit(hit));
    }
  }
}

void LightMap::Solve(const std::function<void(double)>& progress)
{
  constexpr std::size_t Batch = 1024;
  for (std::size_t first = 0; first < this->Points.size(); first = this->Direct.size())
  {
    progress(static_cast<double>(first) / static_cast<double>(this->Points.size()));
    this->Expand(first, std::min(first + Batch, this->Points.size()));
  }
  // Iteration of Jacobi: each round adds one bounce.
  constexpr double Enough = 1e-7;
  this->Radiance.assign(this->Points.size(), Color(0.0));
  double change = 1.0;
  double total = 0.0;
  while (change > Enough * total)
  {
    std::vector<Color> next(this->Points.size());
    tbb::parallel_for(std::size_t{ 0 }, next.size(),
      [&](std::size_t i)
      {
        Color sum(0.0);
        for (std::size_t ray = i * this->Rays; ray < (i + 1) * this->Rays; ++ray)
        {
          const std::uint32_t target = this->Targets[ray];
          sum += target != Nowhere ? this->Radiance[target] : Color(0.0);
        }
        next[i] =
          this->Points[i].albedo * (this->Direct[i] + sum / static_cast<double>(this->Rays));
      });
    change = total = 0.0;
    for (std::size_t i = 0; i < next.size(); ++i)
    {
      change += Mean(next[i] - this->Radiance[i]);
      total += Mean(next[i]);
    }
    this->Radiance.swap(next);
  }
}

} // namespace vantage
