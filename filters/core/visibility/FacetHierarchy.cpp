#include "core/visibility/FacetHierarchy.h"

#include <algorithm>
#include <array>

namespace vantage
{

namespace
{

constexpr std::uint32_t LeafSize = 4;

/// Median splits halve the number of facets: 32-bit ids give less than 32 levels, and a descent
/// leaves one box a level behind.
constexpr int StackSize = 64;

} // namespace

FacetHierarchy::FacetHierarchy(const FacetShapes& facets, double tolerance)
  : Facets(&facets)
  , Tolerance(tolerance)
{
  if (facets.Size() == 0)
  {
    return;
  }
  std::vector<Item> items;
  items.reserve(facets.Size());
  for (std::uint32_t f = 0; f < facets.Size(); ++f)
  {
    items.push_back({ vantage::Box(facets[f]), f });
  }
  this->Boxes.reserve(facets.Size() + 1); // leaves hold more than half of what they may
  this->Boxes.resize(1);
  this->Build(items.data(), 0, 0, facets.Size());
  this->Order.reserve(items.size());
  for (const Item& item : items)
  {
    this->Order.push_back(item.facet);
  }
}

void FacetHierarchy::Build(Item* items, std::uint32_t box, std::uint32_t first, std::uint32_t last)
{
  Vec3 low = items[first].box.low;
  Vec3 high = items[first].box.high;
  for (std::uint32_t i = first + 1; i < last; ++i)
  {
    low = glm::min(low, items[i].box.low);
    high = glm::max(high, items[i].box.high);
  }
  if (last - first <= LeafSize)
  {
    this->Boxes[box] = { low, high, first, last - first };
    return;
  }
  const Vec3 size = high - low;
  const int axis = size.x >= size.y ? (size.x >= size.z ? 0 : 2) : (size.y >= size.z ? 1 : 2);
  const std::uint32_t middle = first + (last - first) / 2;
  std::nth_element(items + first, items + middle, items + last,
    [axis](const Item& a, const Item& b)
    {
      const double x = a.box.low[axis] + a.box.high[axis];
      const double y = b.box.low[axis] + b.box.high[axis];
      return x != y ? x < y : a.facet < b.facet;
    });
  const auto children = static_cast<std::uint32_t>(this->Boxes.size());
  this->Boxes[box] = { low, high, children, 0 };
  this->Boxes.resize(children + 2);
  this->Build(items, children, first, middle);
  this->Build(items, children + 1, middle, last);
}

bool FacetHierarchy::Reaches(const Box& box, const ConvexRegion& region) const
{
  if (glm::any(glm::lessThan(box.high, region.low)) ||
      glm::any(glm::lessThan(region.high, box.low)))
  {
    return false;
  }
  const Vec3 middle = 0.5 * (box.low + box.high);
  const Vec3 half = 0.5 * (box.high - box.low);
  for (int k = 0; k < region.planeCount; ++k)
  {
    const Plane& plane = region.planes[k];
    const double furthest = plane.Distance(middle) + glm::dot(glm::abs(plane.normal), half);
    if (furthest <= this->Tolerance)
    {
      return false;
    }
  }
  return true;
}

template <typename Step, typename Visit>
bool FacetHierarchy::ForEachIn(
  const ConvexRegion& region, const Step& step, const Visit& visit) const
{
  std::array<std::uint32_t, StackSize> stack;
  int depth = 0;
  if (!this->Boxes.empty())
  {
    stack[depth++] = 0;
  }
  while (depth > 0)
  {
    const Box& box = this->Boxes[stack[--depth]];
    if (!step())
    {
      return false;
    }
    if (!this->Reaches(box, region))
    {
      continue;
    }
    if (box.count == 0)
    {
      stack[depth++] = box.first + 1;
      stack[depth++] = box.first;
    }
    for (std::uint32_t i = box.first; i < box.first + box.count; ++i)
    {
      const std::uint32_t facet = this->Order[i];
      if (!step() ||
          (ReachesInto((*this->Facets)[facet], region, this->Tolerance) && !visit(facet)))
      {
        return false;
      }
    }
  }
  return true;
}

std::vector<std::uint32_t> FacetHierarchy::FacetsIn(const ConvexRegion& region) const
{
  std::vector<std::uint32_t> found;
  this->ForEachIn(
    region, [] { return true; },
    [&](std::uint32_t facet)
    {
      found.push_back(facet);
      return true;
    });
  std::sort(found.begin(), found.end());
  return found;
}

bool FacetHierarchy::IsProvablyEmpty(const ConvexRegion& region, int effort) const
{
  return this->ForEachIn(
    region, [&] { return --effort >= 0; }, [](std::uint32_t) { return false; });
}

} // namespace vantage
