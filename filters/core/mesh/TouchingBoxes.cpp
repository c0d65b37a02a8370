#include "core/mesh/TouchingBoxes.h"

#include <algorithm>
#include <numeric>

namespace vantage
{

namespace
{

/// So few boxes are a leaf.
constexpr std::uint32_t SmallLeaf = 4;

/// A binary tree of boxes; the children of a node follow it, the second one after all of the first.
class BoxTree
{
public:
  BoxTree(const std::vector<Box>& boxes, double tolerance)
    : Boxes(boxes)
    , Tolerance(tolerance)
    , Order(boxes.size())
  {
    std::iota(this->Order.begin(), this->Order.end(), 0u);
    if (!boxes.empty())
    {
      this->Build(0, static_cast<std::uint32_t>(boxes.size()));
    }
  }

  /// Pairs of which both lie below a node.
  template <typename Visit>
  void JoinWithin(std::uint32_t index, const Visit& visit) const
  {
    const Node& node = this->Nodes[index];
    if (node.second == 0)
    {
      for (std::uint32_t k = node.first; k < node.last; ++k)
      {
        this->Compare(k, k + 1, node.last, visit);
      }
      return;
    }
    this->JoinWithin(index + 1, visit);
    this->JoinWithin(node.second, visit);
    this->JoinAcross(index + 1, node.second, visit);
  }

private:
  struct Node
  {
    Box box;
    std::uint32_t first, last; ///< in the order
    std::uint32_t second;      ///< child; 0: a leaf
  };

  /// Halves them along the longest side of the box around all.
  std::uint32_t Build(std::uint32_t first, std::uint32_t last)
  {
    const auto index = static_cast<std::uint32_t>(this->Nodes.size());
    Box all = this->Boxes[this->Order[first]];
    for (std::uint32_t k = first + 1; k < last; ++k)
    {
      all.low = glm::min(all.low, this->Boxes[this->Order[k]].low);
      all.high = glm::max(all.high, this->Boxes[this->Order[k]].high);
    }
    this->Nodes.push_back({ all, first, last, 0 });
    if (last - first > SmallLeaf)
    {
      const Vec3 extent = all.high - all.low;
      const int axis =
        extent.x >= std::max(extent.y, extent.z) ? 0 : (extent.y >= extent.z ? 1 : 2);
      const std::uint32_t middle = first + (last - first) / 2;
      const auto place = [&](std::uint32_t box)
      { return this->Boxes[box].low[axis] + this->Boxes[box].high[axis]; };
      std::nth_element(this->Order.begin() + first, this->Order.begin() + middle,
        this->Order.begin() + last,
        [&](std::uint32_t a, std::uint32_t b) { return place(a) < place(b); });
      this->Build(first, middle);
      const std::uint32_t second = this->Build(middle, last);
      this->Nodes[index].second = second;
    }
    return index;
  }

  /// Pairs of one below either node: the larger one is opened first.
  template <typename Visit>
  void JoinAcross(std::uint32_t a, std::uint32_t b, const Visit& visit) const
  {
    const Node& one = this->Nodes[a];
    const Node& other = this->Nodes[b];
    if (!one.box.Touches(other.box, this->Tolerance))
    {
      return;
    }
    const bool opensOne = one.second != 0 && one.last - one.first >= other.last - other.first;
    if (opensOne || (one.second != 0 && other.second == 0))
    {
      this->JoinAcross(a + 1, b, visit);
      this->JoinAcross(one.second, b, visit);
    }
    else if (other.second != 0)
    {
      this->JoinAcross(a, b + 1, visit);
      this->JoinAcross(a, other.second, visit);
    }
    else
    {
      for (std::uint32_t k = one.first; k < one.last; ++k)
      {
        this->Compare(k, other.first, other.last, visit);
      }
    }
  }

  template <typename Visit>
  void Compare(std::uint32_t one, std::uint32_t first, std::uint32_t last, const Visit& visit) const
  {
    const Box& box = this->Boxes[this->Order[one]];
    for (std::uint32_t k = first; k < last; ++k)
    {
      if (box.Touches(this->Boxes[this->Order[k]], this->Tolerance))
      {
        visit(this->Order[one], this->Order[k]);
      }
    }
  }

  const std::vector<Box>& Boxes;
  double Tolerance;
  std::vector<std::uint32_t> Order;
  std::vector<Node> Nodes;
};

} // namespace

void ForEachTouchingPair(const std::vector<Box>& boxes, double tolerance,
  const std::function<void(std::uint32_t, std::uint32_t)>& visit)
{
  if (!boxes.empty())
  {
    BoxTree(boxes, tolerance).JoinWithin(0, visit);
  }
}

} // namespace vantage
