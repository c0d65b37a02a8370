#pragma once

#include "core/reference/ReferenceGeometry.h"

#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

/// \file LightMap.h
/// Radiosity by collocation: slow, plain, and independent of transport/.

namespace vantage
{

/// All sides are covered with square cells of one size. One of the first points that are visited in
/// a cell stands for what can be seen of it, so parts that nobody sees, under furniture, take no
/// part.
/// Each point knows its direct light exactly and gathers the rest from the points that a fixed set
/// of rays leads to. Different seeds give independent maps; over them the expected error is that of
/// cells of finite size only, of second order.
class LightMap
{
public:
  static constexpr std::uint32_t Nowhere = None;

  /// `cells` is how many would cover the scene, `rays` how many each point gathers with.
  /// The geometry must outlive this.
  LightMap(const ReferenceGeometry& geometry, int cells, int rays, std::uint64_t seed);

  /// The point that stands for this place, made if it is the first one there; Nowhere when nothing
  /// is hit or the side reflects nothing. Not for many threads.
  std::uint32_t Visit(const std::optional<Hit>& hit);

  /// Visits all that light on its way to the visited points can come from, and solves. `progress`
  /// is called with the part of the points known so far that are done.
  void Solve(const std::function<void(double)>& progress);

  /// Radiance reflected at a point, direct light included. Solve() comes first.
  Color Reflected(std::uint32_t point) const { return this->Radiance[point]; }

private:
  /// The cells of one side: where both dot products, times the cells along, count from.
  struct Grid
  {
    Vec3 origin, u, v;
    int across = 1;
    int along = 1;
    std::size_t first = 0; ///< its first cell
  };

  std::size_t CellOf(const Hit& hit) const;
  void Expand(std::size_t first, std::size_t last);

  const ReferenceGeometry* Geometry;
  int Rays;
  std::uint64_t Seed;
  std::vector<Grid> Grids;                ///< one a patch
  std::vector<std::uint32_t> PointOfCell; ///< Nowhere where none was visited
  std::vector<SurfacePlace> Points;
  std::vector<std::uint32_t> Visits;  ///< of each point before it was expanded
  std::vector<Color> Direct;          ///< irradiance over pi
  std::vector<std::uint32_t> Targets; ///< points that the rays of each point lead to
  std::vector<Color> Radiance;
};

} // namespace vantage
