#include "core/mesh/Weld.h"

#include "core/math/Sampling.h"
#include "core/mesh/DisjointSets.h"
#include "core/mesh/Facets.h"
#include "core/mesh/Numbering.h"

#include <algorithm>
#include <cmath>
#include <tuple>

namespace vantage
{

namespace
{

bool IsBefore(const Vec3& a, const Vec3& b)
{
  return std::tie(a.x, a.y, a.z) < std::tie(b.x, b.y, b.z);
}

/// Shares positions that are equal.
WeldedPoints ShareEqual(const std::vector<Vec3>& positions)
{
  WeldedPoints result;
  result.indices.reserve(positions.size());
  Numbering<Vec3, HashOfPoint> numbers(positions.size() / 4); // about four corners share a place
  for (const Vec3& p : positions)
  {
    result.indices.push_back(numbers.Of(p));
  }
  struct Entry
  {
    Vec3 position;
    std::uint32_t number;
  };
  std::vector<Entry> entries;
  entries.reserve(numbers.Keys().size());
  for (const Vec3& p : numbers.Keys())
  {
    entries.push_back({ p, static_cast<std::uint32_t>(entries.size()) });
  }
  std::sort(entries.begin(), entries.end(),
    [](const Entry& a, const Entry& b) { return IsBefore(a.position, b.position); });
  result.points.reserve(entries.size());
  std::vector<std::uint32_t> places(entries.size());
  for (const Entry& entry : entries)
  {
    places[entry.number] = static_cast<std::uint32_t>(result.points.size());
    result.points.push_back(entry.position);
  }
  for (std::uint32_t& index : result.indices)
  {
    index = places[index];
  }
  return result;
}

/// The cells of a grid that a point reaches into: its own and those within the tolerance below it,
/// mostly none. Two points to be welded meet in a cell: along each axis, the upper one is entered
/// where the lower is.
class WeldGrid
{
public:
  WeldGrid(const Vec3& low, double tolerance)
    : Low(low)
    , CellSize(8.0 * tolerance)
  {
  }

  /// Visits hashes of the cells; a collision only costs a few comparisons.
  template <typename Visit>
  void ForEachCell(const Vec3& point, const Visit& visit) const
  {
    constexpr double Reach = 0.125; // of the tolerance, in cells
    // Half a cell of offset: the planes through the lowest corner do not lie on cell borders.
    const Vec3 t = (point - this->Low) / this->CellSize + 0.5;
    const glm::i64vec3 first(glm::floor(t - Reach));
    const glm::i64vec3 last(glm::floor(t));
    for (std::int64_t x = first.x; x <= last.x; ++x)
    {
      for (std::int64_t y = first.y; y <= last.y; ++y)
      {
        for (std::int64_t z = first.z; z <= last.z; ++z)
        {
          visit(Hash(static_cast<std::uint64_t>(x), static_cast<std::uint64_t>(y),
            static_cast<std::uint64_t>(z)));
        }
      }
    }
  }

private:
  Vec3 Low;
  double CellSize;
};

/// Points that may have another one within the tolerance, as far as their order tells. Along an
/// axis, those of [first, last) fall into chains of steps up to about the tolerance; a chain of one
/// has none, and one without any steps is sorted by the next axis.
/// \pre the points are sorted by x, y, z, those of the range are equal along the axes before
void FindCrowded(const std::vector<Vec3>& points, double tolerance, int axis, std::uint32_t first,
  std::uint32_t last, std::vector<std::uint32_t>& crowded)
{
  const double step = 2.0 * tolerance; // whatever rounding does to a distance
  for (std::uint32_t end = first; first < last; first = end)
  {
    for (++end; end < last && points[end][axis] - points[end - 1][axis] <= step; ++end)
    {
    }
    if (end - first == 1)
    {
      continue;
    }
    if (axis < 2 && points[first][axis] == points[end - 1][axis])
    {
      FindCrowded(points, tolerance, axis + 1, first, end, crowded);
      continue;
    }
    for (std::uint32_t point = first; point < end; ++point)
    {
      crowded.push_back(point);
    }
  }
}

/// Joins the points closer than the tolerance. \pre they are sorted by x, y, z
void JoinNear(const std::vector<Vec3>& points, double tolerance, DisjointSets& sets)
{
  struct Entry
  {
    std::uint32_t point;
    std::uint32_t before; ///< in the same cell, or None
  };
  Vec3 low = points.front();
  for (const Vec3& p : points)
  {
    low = glm::min(low, p);
  }
  std::vector<std::uint32_t> crowded;
  FindCrowded(points, tolerance, 0, 0, static_cast<std::uint32_t>(points.size()), crowded);
  const WeldGrid grid(low, tolerance);
  Numbering<std::uint64_t, Itself> cells(crowded.size());
  std::vector<std::uint32_t> lastOfCell; ///< entry
  std::vector<Entry> entries;
  for (const std::uint32_t point : crowded)
  {
    grid.ForEachCell(points[point],
      [&](std::uint64_t hash)
      {
        const std::uint32_t cell = cells.Of(hash);
        if (cell == lastOfCell.size())
        {
          lastOfCell.push_back(None);
        }
        for (std::uint32_t e = lastOfCell[cell]; e != None; e = entries[e].before)
        {
          if (glm::length(points[entries[e].point] - points[point]) <= tolerance)
          {
            sets.Join(entries[e].point, point);
          }
        }
        entries.push_back({ point, lastOfCell[cell] });
        lastOfCell[cell] = static_cast<std::uint32_t>(entries.size() - 1);
      });
  }
}

} // namespace

WeldedPoints Weld(const std::vector<Vec3>& positions, double tolerance)
{
  WeldedPoints result = ShareEqual(positions);
  if (tolerance == 0.0 || result.points.empty())
  {
    return result;
  }
  DisjointSets sets(result.points.size());
  JoinNear(result.points, tolerance, sets);
  std::vector<Vec3> kept;
  std::vector<std::uint32_t> newIndex(result.points.size());
  for (std::uint32_t i = 0; i < result.points.size(); ++i)
  {
    const std::uint32_t first = sets.Find(i);
    if (first == i)
    {
      newIndex[i] = static_cast<std::uint32_t>(kept.size());
      kept.push_back(result.points[i]);
    }
    newIndex[i] = newIndex[first];
  }
  result.moved = result.points.size() - kept.size();
  result.points = std::move(kept);
  for (std::uint32_t& index : result.indices)
  {
    index = newIndex[index];
  }
  return result;
}

} // namespace vantage
