#include "core/mesh/Partition.h"

#include <algorithm>
#include <array>
#include <limits>
#include <tuple>
#include <utility>

namespace vantage
{

namespace
{

constexpr int BinCount = 16;
/// Of a bin: a row of patches whose middles lie on the border but for rounding is not torn apart.
constexpr double Slack = 1e-7;

/// Where to cut a range of items: those whose bin along the axis is below `bin` go left.
struct Cut
{
  int axis = 0;
  int bin = 0; ///< 0: no good cut was found
  double cost = std::numeric_limits<double>::infinity();
};

/// The items of a range in bins along one axis of their box. Most ranges are of a few items, so
/// most bins are empty.
class Binning
{
public:
  Binning(const Bounds& box, int axis)
    : Axis(axis)
    , Low(box.Low()[axis])
  {
    const double extent = box.Extent()[axis];
    this->Scale = extent > 0.0 ? BinCount / extent : 0.0;
  }

  int Of(const Vec3& key) const
  {
    const double place = (key[this->Axis] - this->Low) * this->Scale + Slack;
    return std::min(static_cast<int>(place), BinCount - 1);
  }

  void Add(const Vec3& key)
  {
    const int bin = this->Of(key);
    this->Boxes[bin].Add(key);
    ++this->Counts[bin];
  }

  /// Makes `best` the cheapest cut across the axis that leaves `least` of all items on each side,
  /// if it is cheaper. A cut below an empty bin is the same as the one above it.
  void Improve(Cut& best, std::ptrdiff_t total, std::ptrdiff_t least) const;

  /// Of the bins [first, last).
  Bounds BoxOf(int first, int last) const
  {
    Bounds box;
    for (int i = first; i < last; ++i)
    {
      box.Add(this->Boxes[i]);
    }
    return box;
  }

private:
  int Axis;
  double Low;
  double Scale;
  std::array<Bounds, BinCount> Boxes;
  std::array<std::uint32_t, BinCount> Counts{};
};

void Binning::Improve(Cut& best, std::ptrdiff_t total, std::ptrdiff_t least) const
{
  std::array<double, BinCount> costAbove; ///< of the used bins from i on
  Bounds above;
  std::ptrdiff_t countAbove = 0;
  for (int i = BinCount - 1; i > 0; --i)
  {
    if (this->Counts[i] > 0)
    {
      above.Add(this->Boxes[i]);
      countAbove += this->Counts[i];
      costAbove[i] = static_cast<double>(countAbove) * above.Diagonal();
    }
  }
  Bounds below;
  std::ptrdiff_t countBelow = 0;
  int bin = 0; ///< the first after the last used one
  for (int i = 0; i < BinCount; ++i)
  {
    if (this->Counts[i] == 0)
    {
      continue;
    }
    if (countBelow >= least && total - countBelow >= least && costAbove[i] < best.cost)
    {
      const double cost = static_cast<double>(countBelow) * below.Diagonal() + costAbove[i];
      if (cost < best.cost)
      {
        best = { this->Axis, bin, cost };
      }
    }
    below.Add(this->Boxes[i]);
    countBelow += this->Counts[i];
    bin = i + 1;
  }
}

/// Half of all ranges are of two. Any cut between them costs nothing, so the first axis on which
/// they differ is taken.
std::array<ClusterRange, 2> PartTwo(ClusterItem* items)
{
  const auto placeOf = [](const ClusterItem& item)
  { return std::tie(item.key.x, item.key.y, item.key.z, item.patch); };
  if (placeOf(items[1]) < placeOf(items[0]))
  {
    std::swap(items[0], items[1]);
  }
  return { ClusterRange{ items, items + 1, Bounds(items[0].key) },
    ClusterRange{ items + 1, items + 2, Bounds(items[1].key) } };
}

std::array<ClusterRange, 2> PartAtMedian(const ClusterRange& range)
{
  const Vec3 extent = range.box.Extent();
  const int axis =
    extent.x >= extent.y ? (extent.x >= extent.z ? 0 : 2) : (extent.y >= extent.z ? 1 : 2);
  ClusterItem* middle = range.first + range.Size() / 2;
  std::nth_element(range.first, middle, range.last,
    [axis](const ClusterItem& a, const ClusterItem& b)
    { return a.key[axis] != b.key[axis] ? a.key[axis] < b.key[axis] : a.patch < b.patch; });
  return { ClusterRange{ range.first, middle, BoxOf(range.first, middle) },
    ClusterRange{ middle, range.last, BoxOf(middle, range.last) } };
}

} // namespace

Bounds BoxOf(const ClusterItem* first, const ClusterItem* last)
{
  Bounds box;
  for (const ClusterItem* item = first; item != last; ++item)
  {
    box.Add(item->key);
  }
  return box;
}

std::array<ClusterRange, 2> Partition(const ClusterRange& range, std::ptrdiff_t least)
{
  if (range.Size() == 2)
  {
    return PartTwo(range.first);
  }
  std::array<Binning, 3> binnings{ Binning(range.box, 0), Binning(range.box, 1),
    Binning(range.box, 2) };
  for (const ClusterItem* item = range.first; item != range.last; ++item)
  {
    for (Binning& bins : binnings)
    {
      bins.Add(item->key);
    }
  }
  Cut best;
  for (const Binning& bins : binnings)
  {
    bins.Improve(best, range.Size(), least);
  }
  if (best.bin == 0)
  {
    return PartAtMedian(range);
  }
  const Binning& bins = binnings[best.axis];
  ClusterItem* middle = std::partition(
    range.first, range.last, [&](const ClusterItem& item) { return bins.Of(item.key) < best.bin; });
  return { ClusterRange{ range.first, middle, bins.BoxOf(0, best.bin) },
    ClusterRange{ middle, range.last, bins.BoxOf(best.bin, BinCount) } };
}

} // namespace vantage
