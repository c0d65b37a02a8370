#include "core/mesh/PatchEdges.h"

#include "core/mesh/Weld.h"

#include <algorithm>
#include <cmath>
#include <tuple>

namespace vantage
{

namespace
{

/// A facet at one of its edges, between the points `low` < `high`.
struct EdgeUse
{
  std::uint32_t low;
  std::uint32_t high;
  std::uint32_t facet;
  std::uint8_t edge;     ///< of the front side
  bool frontRunsUpwards; ///< from low to high
  double angle = 0.0;    ///< around the direction from low to high

  bool IsSameEdge(const EdgeUse& other) const
  {
    return this->low == other.low && this->high == other.high;
  }
};

std::vector<Vec3> CornerPositions(const FacetSet& facets)
{
  std::vector<Vec3> positions;
  positions.reserve(4 * facets.facets.size());
  for (const Facet& facet : facets.facets)
  {
    positions.insert(positions.end(), facet.shape.begin(), facet.shape.end());
  }
  return positions;
}

/// All uses of all edges, the uses of one edge next to each other.
std::vector<EdgeUse> CollectEdgeUses(
  const FacetSet& facets, const std::vector<std::uint32_t>& points)
{
  std::vector<EdgeUse> uses;
  uses.reserve(points.size());
  std::uint32_t base = 0;
  for (std::uint32_t f = 0; f < facets.facets.size(); ++f)
  {
    const int n = facets.facets[f].shape.Size();
    for (int i = 0; i < n; ++i)
    {
      const std::uint32_t from = points[base + i];
      const std::uint32_t to = points[base + (i + 1) % n];
      uses.push_back(
        { std::min(from, to), std::max(from, to), f, static_cast<std::uint8_t>(i), from < to });
    }
    base += n;
  }
  std::sort(uses.begin(), uses.end(),
    [](const EdgeUse& a, const EdgeUse& b)
    { return std::tie(a.low, a.high, a.facet) < std::tie(b.low, b.high, b.facet); });
  return uses;
}

/// Sorts the uses of one edge by the angle of their facets around it, from the first one on.
void SortByAngle(std::vector<EdgeUse>::iterator first, std::vector<EdgeUse>::iterator last,
  const FacetSet& facets, const std::vector<Vec3>& points)
{
  const Vec3 axis = glm::normalize(points[first->high] - points[first->low]);
  const auto inward = [&](const EdgeUse& use)
  {
    const Vec3 d = glm::cross(UnitNormal(facets.facets[use.facet].shape), axis);
    return use.frontRunsUpwards ? d : -d;
  };
  const Vec3 x = inward(*first);
  const Vec3 y = glm::cross(axis, x);
  for (auto use = first + 1; use != last; ++use)
  {
    const Vec3 d = inward(*use);
    const double angle = std::atan2(glm::dot(d, y), glm::dot(d, x));
    use->angle = angle < 0.0 ? angle + 2.0 * Pi : angle;
  }
  std::sort(first, last,
    [](const EdgeUse& a, const EdgeUse& b)
    { return std::tie(a.angle, a.facet) < std::tie(b.angle, b.facet); });
}

/// The side whose edge runs from low to high faces growing angles: the direction into the facet is
/// normal x axis, so axis x (direction into the facet) = normal.
Side UpperSide(const EdgeUse& use)
{
  return use.frontRunsUpwards ? Side::Front : Side::Back;
}

Side LowerSide(const EdgeUse& use)
{
  return use.frontRunsUpwards ? Side::Back : Side::Front;
}

/// The edges of all active patches, none of them joined, and where those of each patch start.
struct EdgeList
{
  std::vector<PatchEdge> edges;
  std::vector<std::uint32_t> firstOfPatch;

  explicit EdgeList(const ElementTree& tree)
  {
    const std::vector<Patch>& patches = tree.Patches();
    for (PatchId p = 0; p < patches.size(); ++p)
    {
      const auto first = static_cast<std::uint32_t>(this->edges.size());
      const std::uint32_t n = patches[p].IsActive() ? tree[patches[p].node].cornerCount : 0;
      for (std::uint32_t i = 0; i < n; ++i)
      {
        this->edges.push_back({ p, i, first + (i + 1) % n });
      }
      this->firstOfPatch.push_back(first);
    }
    this->firstOfPatch.push_back(static_cast<std::uint32_t>(this->edges.size()));
  }

  /// The edge of one side of a facet; None when that side is not active.
  std::uint32_t Find(const EdgeUse& use, Side side) const
  {
    const PatchId patch = PatchOf(use.facet, side);
    const std::uint32_t n = this->firstOfPatch[patch + 1] - this->firstOfPatch[patch];
    if (n == 0)
    {
      return None;
    }
    // The corners of a back side are those of the front in reverse.
    return this->firstOfPatch[patch] +
           (side == Side::Front ? use.edge : (2 * n - 2 - use.edge) % n);
  }
};

} // namespace

std::vector<PatchEdge> PairEdges(const ElementTree& tree, const FacetSet& facets)
{
  EdgeList list(tree);
  const WeldedPoints welded = Weld(CornerPositions(facets), 0.0);
  std::vector<EdgeUse> uses = CollectEdgeUses(facets, welded.indices);
  for (auto first = uses.begin(); first != uses.end();)
  {
    const auto last = std::find_if_not(
      first, uses.end(), [first](const EdgeUse& use) { return use.IsSameEdge(*first); });
    if (last - first > 2)
    {
      SortByAngle(first, last, facets, welded.points);
    }
    for (auto use = first; use != last; ++use)
    {
      const EdgeUse& next = use + 1 == last ? *first : *(use + 1);
      const std::uint32_t upper = list.Find(*use, UpperSide(*use));
      const std::uint32_t lower = list.Find(next, LowerSide(next));
      if (upper != None && lower != None)
      {
        list.edges[upper].partner = lower;
        list.edges[lower].partner = upper;
      }
    }
    first = last;
  }
  return list.edges;
}

} // namespace vantage
