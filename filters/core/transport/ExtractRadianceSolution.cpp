#include "core/transport/ExtractRadianceSolution.h"

#include "core/mesh/CurvedSurfaces.h"
#include "core/transport/Transport.h"

#include <algorithm>
#include <map>
#include <unordered_map>

namespace vantage
{

namespace
{

using LampList = std::vector<PatchId>;

/// The lamps of a scene, of which those of one curved surface go by its name.
class LampSurfaces
{
public:
  using Name = NodeId;

  explicit LampSurfaces(const Transport& transport)
    : NameOfPatch(transport.Tree().Patches().size(), None)
  {
    const ElementTree& tree = transport.Tree();
    for (PatchId patch = 0; patch < this->NameOfPatch.size(); ++patch)
    {
      if (tree.Patches()[patch].IsActive() && MaxChannel(transport.OpticsOf(patch).emission) > 0.0)
      {
        this->NameOfPatch[patch] = SurfaceAbove(tree, tree.Patches()[patch].node);
        this->LampsOf[this->NameOfPatch[patch]].push_back(patch);
      }
    }
  }

  /// None if the patch does not emit.
  Name NameOf(PatchId patch) const { return this->NameOfPatch[patch]; }
  LampList AllOf(const std::vector<Name>& names) const
  {
    LampList all;
    for (const Name name : names)
    {
      const LampList& lamps = this->LampsOf.at(name);
      all.insert(all.end(), lamps.begin(), lamps.end());
    }
    std::sort(all.begin(), all.end());
    return all;
  }

private:
  std::vector<Name> NameOfPatch;
  std::unordered_map<Name, LampList> LampsOf;
};

using NameList = std::vector<LampSurfaces::Name>;

/// Names of the lamps that each node interacts with, ascending, without those of its ancestors.
std::vector<NameList> LampsOfNodes(const Transport& transport, const LampSurfaces& surfaces)
{
  const ElementTree& tree = transport.Tree();
  std::vector<NameList> lamps(tree.Size());
  for (InteractionId id = 0; id < transport.Graph().Size(); ++id)
  {
    const Interaction& link = transport.Graph()[id];
    for (End end = 0; end < 2; ++end)
    {
      const LampSurfaces::Name name = surfaces.NameOf(tree[link.ends[Other(end)]].patch);
      if (name != None)
      {
        lamps[link.ends[end]].push_back(name);
      }
    }
  }
  for (NameList& list : lamps)
  {
    std::sort(list.begin(), list.end());
    list.erase(std::unique(list.begin(), list.end()), list.end());
  }
  return lamps;
}

/// Irradiance of each node, not of its ancestors, from what emitters have shot: without closure.
std::vector<Color> EmissionReceived(const Transport& transport)
{
  const ElementTree& tree = transport.Tree();
  std::vector<Color> irradiance(tree.Size(), Color(0.0));
  for (InteractionId id = 0; id < transport.Graph().Size(); ++id)
  {
    const Interaction& link = transport.Graph()[id];
    for (End end = 0; end < 2; ++end)
    {
      const NodeId to = link.ends[end];
      const Color& emission = transport.OpticsOf(tree[link.ends[Other(end)]].patch).emission;
      irradiance[to] +=
        link.throughput / tree[to].area * glm::min(emission, link.shotRadiance[Other(end)]);
    }
  }
  return irradiance;
}

NameList Union(const NameList& a, const NameList& b)
{
  NameList all;
  std::set_union(a.begin(), a.end(), b.begin(), b.end(), std::back_inserter(all));
  return all;
}

/// The lamps that the leaves name. An interaction whose few rays were all blocked does not exist,
/// although a part of the element may see the lamp; so an element takes over what those around it
/// name: all of the patch when these are few, else the elements below its grandparent. Of a curved
/// surface all lamps are named where one is.
class LampsOfLeaves
{
public:
  explicit LampsOfLeaves(const Transport& transport)
    : Tree(&transport.Tree())
    , Surfaces(transport)
    , Above(LampsOfNodes(transport, this->Surfaces))
    , Below(this->Above)
  {
    const ElementTree& tree = *this->Tree;
    for (NodeId id = tree.Size(); id-- > 0;)
    {
      if (tree[id].level > 0)
      {
        NameList& ofParent = this->Below[tree[id].parent];
        ofParent = Union(ofParent, this->Below[id]);
      }
    }
    for (NodeId id = 0; id < tree.Size(); ++id)
    {
      if (tree[id].level > 0)
      {
        this->Above[id] = Union(this->Above[id], this->Above[tree[id].parent]);
      }
    }
  }

  LampList Of(NodeId leaf) const { return this->Surfaces.AllOf(this->NamesOf(leaf)); }

private:
  static constexpr std::size_t FewLamps = 16;

  NameList NamesOf(NodeId leaf) const
  {
    const ElementTree& tree = *this->Tree;
    const NameList& ofPatch = this->Below[tree.PatchOfNode(leaf).node];
    if (ofPatch.size() <= FewLamps)
    {
      return ofPatch;
    }
    NodeId around = leaf;
    for (int k = 0; k < 2 && tree[around].level > 0; ++k)
    {
      around = tree[around].parent;
    }
    return Union(this->Above[leaf], this->Below[around]);
  }

  const ElementTree* Tree;
  LampSurfaces Surfaces;
  std::vector<NameList> Above; ///< of a node and its ancestors
  std::vector<NameList> Below; ///< of a node and its descendants
};

/// Hands out ranges of the solution's lamps, each list once.
class LampRanges
{
public:
  explicit LampRanges(std::vector<PatchId>& lamps)
    : Lamps(&lamps)
  {
  }

  std::uint32_t FirstOf(const LampList& list)
  {
    const auto [place, isNew] =
      this->Known.emplace(list, static_cast<std::uint32_t>(this->Lamps->size()));
    if (isNew)
    {
      this->Lamps->insert(this->Lamps->end(), list.begin(), list.end());
    }
    return place->second;
  }

private:
  std::vector<PatchId>* Lamps;
  std::map<LampList, std::uint32_t> Known;
};

} // namespace

RadianceSolution ExtractRadianceSolution(const Transport& transport)
{
  const ElementTree& tree = transport.Tree();
  std::vector<PatchOptics> optics(tree.Patches().size());
  for (PatchId p = 0; p < optics.size(); ++p)
  {
    optics[p] = transport.OpticsOf(p);
  }
  RadianceSolution solution;
  solution.SetPatches(optics);
  const LampsOfLeaves lamps(transport);
  LampRanges ranges(solution.lamps);
  std::vector<Color> direct = EmissionReceived(transport);
  solution.elements.resize(tree.Size());
  for (NodeId id = 0; id < tree.Size(); ++id)
  {
    const Node& node = tree[id];
    if (node.IsCluster())
    {
      continue;
    }
    RadianceSolution::Element& element = solution.elements[id];
    element.node = id;
    element.area = node.area;
    element.firstChild = node.firstChild;
    element.childCount = node.childCount;
    element.reflected = transport.Radiance(id) - optics[node.patch].emission;
    if (node.level == 0)
    {
      solution.StartAt(node.patch, tree.Shape(id), id);
    }
    if (node.level > 0)
    {
      direct[id] += direct[node.parent];
    }
    if (node.IsLeaf())
    {
      const Color named = optics[node.patch].albedo / Pi * transport.ClosureWeight(id) * direct[id];
      element.indirect = glm::max(element.reflected - named, Color(0.0));
      const LampList list = lamps.Of(id);
      element.firstLamp = ranges.FirstOf(list);
      element.lastLamp = element.firstLamp + static_cast<std::uint32_t>(list.size());
    }
  }
  return solution;
}

} // namespace vantage
