#include "core/goal/SolutionOfLinks.h"

#include <algorithm>
#include <map>

namespace vantage
{

namespace
{

/// A lamp that so many rays did not find is taken for hidden.
constexpr std::uint32_t RaysToGiveUp = 64;
/// The lamps in a cluster are named as well, if they are no more than this and give at least this
/// part of what is received: then a gather has them one by one, with their shadows, at little cost.
constexpr std::uint32_t FewLamps = 16;
constexpr double LeastToName = 1e-3;

/// Direct light that arrives at a node, not at its children alone.
struct DirectLight
{
  std::vector<PatchId> lamps;
  OfKinds<Color> named{}; ///< irradiance from these as the links have it, W m^-2
  Color unnamed{ 0.0 };   ///< from others, without closure
};

class SolutionMaker
{
public:
  explicit SolutionMaker(const GoalOrientedTransport& transport)
    : Transport(transport)
    , Tree(transport.Tree())
    , Direct(transport.Tree().Size())
  {
    for (const Link& link : transport.Links())
    {
      this->Note(link, 0);
      this->Note(link, 1);
    }
    this->Made.SetPatches(this->Tree.Optics());
    this->Made.elements.resize(this->Tree.Size());
  }

  RadianceSolution Make()
  {
    for (OpenId id = 0; id < this->Tree.Size(); ++id)
    {
      if (id > 0)
      {
        this->Inherit(this->Direct[id], this->Direct[this->Tree[id].parent]);
      }
      this->MakeElement(id);
    }
    return std::move(this->Made);
  }

private:
  /// What the other end of a link emits toward `end`.
  void Note(const Link& link, int end)
  {
    const OpenId to = link.ends[end];
    const OpenId from = link.ends[1 - end];
    const OpenNode& lamp = this->Tree[from];
    if (!(Mean(lamp.emission) > 0.0) || (link.IsSelf() && end == 1))
    {
      return;
    }
    const Color irradiance = link.throughput / this->Tree[to].area * lamp.emission;
    if (!this->IsWorthNames(from, to, irradiance))
    {
      this->Direct[to].unnamed += irradiance;
    }
    else if (link.throughput > 0.0 || link.agreeingRays < RaysToGiveUp)
    {
      const LinkKind kind = KindOf(this->Tree, link);
      const std::vector<PatchId> lamps = this->LampsOf(from);
      this->Direct[to].lamps.insert(this->Direct[to].lamps.end(), lamps.begin(), lamps.end());
      this->Direct[to].named[kind] += this->Transport.ClosureOf(kind, from) * irradiance;
    }
  }

  std::vector<PatchId> LampsOf(OpenId id) const
  {
    return this->Tree.Geometry(id).IsCluster()
             ? this->Tree.Patches().LampsIn(this->Tree.RangeOf(id))
             : std::vector<PatchId>{ this->Tree[id].patch };
  }

  /// Whether lamps shall be known by name: those of a surface, flat or curved, are.
  bool IsWorthNames(OpenId lamps, OpenId to, const Color& irradiance) const
  {
    if (this->Tree.Geometry(lamps).IsSmooth())
    {
      return true;
    }
    const double reflected = Mean(this->Tree[to].albedo) / Pi * Mean(irradiance);
    return this->Tree.Patches().LampCount(this->Tree.RangeOf(lamps)) <= FewLamps &&
           reflected >= LeastToName * Mean(this->Transport.Radiance().Received(to));
  }

  static void Inherit(DirectLight& child, const DirectLight& parent)
  {
    for (const LinkKind kind : LinkKinds)
    {
      child.named[kind] += parent.named[kind];
    }
    child.unnamed += parent.unnamed;
    child.lamps.insert(child.lamps.end(), parent.lamps.begin(), parent.lamps.end());
    std::sort(child.lamps.begin(), child.lamps.end());
    child.lamps.erase(std::unique(child.lamps.begin(), child.lamps.end()), child.lamps.end());
  }

  void MakeElement(OpenId id)
  {
    const OpenNode& node = this->Tree[id];
    RadianceSolution::Element& element = this->Made.elements[id];
    element.node = node.node;
    element.area = node.area;
    element.reflected = this->Transport.Radiance().Received(id);
    element.unnamedDirect = this->Direct[id].unnamed;
    if (!node.IsLeaf())
    {
      element.firstChild = node.firstChild;
      element.childCount = node.childCount;
    }
    else
    {
      Color named(0.0);
      for (const LinkKind kind : LinkKinds)
      {
        named += this->Transport.ClosureOf(kind, id) * this->Direct[id].named[kind];
      }
      element.indirect = glm::max(element.reflected - node.albedo / Pi * named, Color(0.0));
      this->NameLamps(element, this->Direct[id].lamps);
    }
    const bool hasManyPatches = this->Tree.Geometry(id).IsCluster();
    if (hasManyPatches ? node.IsLeaf() : node.level == 0)
    {
      const PatchRange range = this->Tree.RangeOf(id);
      for (std::uint32_t place = range.first; place < range.last; ++place)
      {
        const PatchId patch = this->Tree.Patches()[place];
        const ElementTree& tree = this->Tree.Tree();
        this->Made.StartAt(patch, tree.Shape(tree.Patches()[patch].node), id);
      }
    }
  }

  /// Neighbours tend to have the same lamps: each list is stored once.
  void NameLamps(RadianceSolution::Element& element, const std::vector<PatchId>& lamps)
  {
    const auto [known, isNew] =
      this->Lists.try_emplace(lamps, static_cast<std::uint32_t>(this->Made.lamps.size()));
    if (isNew)
    {
      this->Made.lamps.insert(this->Made.lamps.end(), lamps.begin(), lamps.end());
    }
    element.firstLamp = known->second;
    element.lastLamp = known->second + static_cast<std::uint32_t>(lamps.size());
  }

  const GoalOrientedTransport& Transport;
  const OpenTree& Tree;
  std::vector<DirectLight> Direct; ///< of each open node, then with that of its ancestors
  std::map<std::vector<PatchId>, std::uint32_t> Lists;
  RadianceSolution Made;
};

} // namespace

RadianceSolution SolutionOfLinks(const GoalOrientedTransport& transport)
{
  return SolutionMaker(transport).Make();
}

} // namespace vantage
