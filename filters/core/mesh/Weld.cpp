#include "core/mesh/Weld.h"

#include "core/math/Sampling.h"
#include "core/mesh/DisjointSets.h"

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
  struct Entry
  {
    Vec3 position;
    std::uint32_t index;
  };
  std::vector<Entry> entries;
  entries.reserve(positions.size());
  for (const Vec3& p : positions)
  {
    entries.push_back({ p, static_cast<std::uint32_t>(entries.size()) });
  }
  std::sort(entries.begin(), entries.end(),
    [](const Entry& a, const Entry& b) { return IsBefore(a.position, b.position); });
  WeldedPoints result;
  result.indices.resize(positions.size());
  for (const Entry& entry : entries)
  {
    if (result.points.empty() || result.points.back() != entry.position)
    {
      result.points.push_back(entry.position);
    }
    result.indices[entry.index] = static_cast<std::uint32_t>(result.points.size() - 1);
  }
  return result;
}

/// A point that reaches into a cell of the grid.
struct CellEntry
{
  std::uint64_t cell; ///< hash of its coordinates; a collision only costs a few comparisons
  std::uint32_t point;

  bool operator<(const CellEntry& other) const
  {
    return std::tie(this->cell, this->point) < std::tie(other.cell, other.point);
  }
};

/// Every point is entered in its cell and in those within the tolerance below it, mostly none. Two
/// points to be welded meet in a cell: along each axis, the upper one is entered where the lower
/// is.
std::vector<CellEntry> EnterIntoGrid(const std::vector<Vec3>& points, double tolerance)
{
  const double cellSize = 8.0 * tolerance;
  Vec3 low = points.front();
  for (const Vec3& p : points)
  {
    low = glm::min(low, p);
  }
  std::vector<CellEntry> entries;
  entries.reserve(points.size());
  for (std::uint32_t i = 0; i < points.size(); ++i)
  {
    std::int64_t first[3];
    std::int64_t last[3];
    for (int axis = 0; axis < 3; ++axis)
    {
      // Half a cell of offset: the planes through the lowest corner do not lie on cell borders.
      const double t = (points[i][axis] - low[axis]) / cellSize + 0.5;
      const double reach = tolerance / cellSize;
      first[axis] = static_cast<std::int64_t>(std::floor(t - reach));
      last[axis] = static_cast<std::int64_t>(std::floor(t));
    }
    for (std::int64_t x = first[0]; x <= last[0]; ++x)
    {
      for (std::int64_t y = first[1]; y <= last[1]; ++y)
      {
        for (std::int64_t z = first[2]; z <= last[2]; ++z)
        {
          entries.push_back({ Hash(static_cast<std::uint64_t>(x), static_cast<std::uint64_t>(y),
                                static_cast<std::uint64_t>(z)),
            i });
        }
      }
    }
  }
  std::sort(entries.begin(), entries.end());
  return entries;
}

/// Joins the points closer than the tolerance.
void JoinNear(const std::vector<Vec3>& points, double tolerance, DisjointSets& sets)
{
  const std::vector<CellEntry> entries = EnterIntoGrid(points, tolerance);
  for (auto a = entries.begin(); a != entries.end(); ++a)
  {
    for (auto b = a + 1; b != entries.end() && b->cell == a->cell; ++b)
    {
      if (glm::length(points[a->point] - points[b->point]) <= tolerance)
      {
        sets.Join(a->point, b->point);
      }
    }
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
