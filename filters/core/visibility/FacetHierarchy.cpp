#include "core/visibility/FacetHierarchy.h"

#include <algorithm>
#include <array>
#include <numeric>

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
  , Order(facets.Size())
{
  std::iota(this->Order.begin(), this->Order.end(), 0u);
  if (facets.Size() > 0)
  {
    std::vector<vantage::Box> boxes;
    boxes.reserve(facets.Size());
    for (std::uint32_t f = 0; f < facets.Size(); ++f)
    {
      boxes.emplace_back(facets[f]);
    }
    this->Boxes.resize(1);
    this->Build(boxes, 0, 0, facets.Size());
  }
}

void FacetHierarchy::Build(const std::vector<vantage::Box>& boxes, std::uint32_t box,
  std::uint32_t first, std::uint32_t last)
{
  Vec3 low = boxes[this->Order[first]].low;
  Vec3 high = boxes[this->Order[first]].high;
  for (std::uint32_t i = first + 1; i < last; ++i)
  {
    low = glm::min(low, boxes[this->Order[i]].low);
    high = glm::max(high, boxes[this->Order[i]].high);
  }
  if (last - first <= LeafSize)
  {
    this->Boxes[box] = { low, high, first, last - first };
    return;
  }
  const Vec3 size = high - low;
  const int axis = size.x >= size.y ? (size.x >= size.z ? 0 : 2) : (size.y >= size.z ? 1 : 2);
  const std::uint32_t middle = first + (last - first) / 2;
  std::nth_element(this->Order.begin() + first, this->Order.begin() + middle,
    this->Order.begin() + last,
    [&](std::uint32_t a, std::uint32_t b)
    {
      const double x = boxes[a].low[axis] + boxes[a].high[axis];
      const double y = boxes[b].low[axis] + boxes[b].high[axis];
      return x != y ? x < y : a < b;
    });
  const auto children = static_cast<std::uint32_t>(this->Boxes.size());
  this->Boxes[box] = { low, high, children, 0 };
  this->Boxes.resize(children + 2);
  this->Build(boxes, children, first, middle);
  this->Build(boxes, children + 1, middle, last);
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
