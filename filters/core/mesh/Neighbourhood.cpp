#include "core/mesh/Neighbourhood.h"

#include "core/math/Box.h"

#include <algorithm>
#include <functional>
#include <utility>

namespace vantage
{

namespace
{

/// A grid of cells of about the size of the facets, hashed into buckets. Facets that are near each
/// other meet in a cell.
class Grid
{
public:
  Grid(const std::vector<Facet>& facets, double tolerance)
    : Tolerance(tolerance)
    , BucketCount(2 * static_cast<std::uint32_t>(facets.size()) + 1)
  {
    double sum = 0.0;
    this->Boxes.reserve(facets.size());
    for (const Facet& facet : facets)
    {
      this->Boxes.emplace_back(facet.shape);
      sum += glm::length(this->Boxes.back().high - this->Boxes.back().low);
    }
    this->CellSize = std::max(2.0 * sum / static_cast<double>(facets.size()), 8.0 * tolerance);
  }

  /// Each pair once.
  std::vector<std::pair<std::uint32_t, std::uint32_t>> Pairs() const
  {
    const PackedLists<std::uint32_t> buckets(this->BucketCount,
      [this](const auto& visit)
      {
        for (std::uint32_t f = 0; f < this->Boxes.size(); ++f)
        {
          this->ForEachCell(
            this->Boxes[f], [&](const Cell& cell) { visit(this->BucketOf(cell), f); });
        }
      });
    std::vector<std::pair<std::uint32_t, std::uint32_t>> pairs;
    std::vector<Entry> entries;
    for (std::uint32_t bucket = 0; bucket < this->BucketCount; ++bucket)
    {
      entries.clear();
      for (const std::uint32_t facet : buckets.Of(bucket))
      {
        // Cells may share a bucket: those of the same facet follow each other.
        if (entries.empty() || entries.back().facet != facet)
        {
          entries.push_back({ this->Boxes[facet], facet });
        }
      }
      for (auto a = entries.begin(); a != entries.end(); ++a)
      {
        for (auto b = a + 1; b != entries.end(); ++b)
        {
          if (a->box.Touches(b->box, this->Tolerance) &&
              this->BucketOf(this->CellAt(glm::max(a->box.low, b->box.low))) == bucket)
          {
            pairs.emplace_back(a->facet, b->facet);
          }
        }
      }
    }
    return pairs;
  }

private:
  using Cell = glm::i64vec3;

  struct Entry
  {
    Box box;
    std::uint32_t facet;
  };

  Cell CellAt(const Vec3& point) const
  {
    return Cell(glm::floor((point - this->Tolerance) / this->CellSize));
  }

  std::uint32_t BucketOf(const Cell& cell) const
  {
    const std::uint64_t hash = static_cast<std::uint64_t>(cell.x) * 0x9e3779b97f4a7c15ull ^
                               static_cast<std::uint64_t>(cell.y) * 0xc2b2ae3d27d4eb4full ^
                               static_cast<std::uint64_t>(cell.z) * 0x165667b19e3779f9ull;
    return static_cast<std::uint32_t>((hash >> 32) % this->BucketCount);
  }

  template <typename Visit>
  void ForEachCell(const Box& box, const Visit& visit) const
  {
    const Cell low = this->CellAt(box.low);
    const Cell high(glm::floor((box.high + this->Tolerance) / this->CellSize));
    for (std::int64_t x = low.x; x <= high.x; ++x)
    {
      for (std::int64_t y = low.y; y <= high.y; ++y)
      {
        for (std::int64_t z = low.z; z <= high.z; ++z)
        {
          visit(Cell(x, y, z));
        }
      }
    }
  }

  double Tolerance;
  std::uint32_t BucketCount;
  double CellSize = 1.0;
  std::vector<Box> Boxes;
};

} // namespace

PackedLists<std::uint32_t> NeighboursOf(const std::vector<Facet>& facets, double tolerance)
{
  const auto pairs = Grid(facets, tolerance).Pairs();
  PackedLists<std::uint32_t> neighbours(facets.size(),
    [&pairs](const auto& visit)
    {
      for (const auto& [a, b] : pairs)
      {
        visit(a, b);
        visit(b, a);
      }
    });
  neighbours.Sort(std::less<>());
  return neighbours;
}

} // namespace vantage
