#include "core/Solution.h"
#include "core/goal/GoalOrientedTransport.h"

namespace vantage
{

namespace
{

/// The open leaf that each leaf of a tree belongs to: itself, what was split in this tree only, or
/// the cluster that no one looked into.
std::vector<OpenId> OpenLeaves(const OpenTree& open, const ElementTree& tree)
{
  std::vector<OpenId> leaves(tree.Size(), None);
  for (OpenId id = 0; id < open.Size(); ++id)
  {
    leaves[open[id].node] = id;
  }
  for (NodeId node = 1; node < tree.Size(); ++node)
  {
    if (leaves[node] == None)
    {
      leaves[node] = leaves[tree[node].parent];
    }
  }
  return leaves;
}

} // namespace

ElementSolution ExtractElements(const GoalOrientedTransport& transport, const FacetSet& facets,
  ElementTree elements, ElementSurface surface)
{
  ElementSolution solution;
  solution.tree = std::make_shared<const ElementTree>(std::move(elements));
  const ElementTree& tree = *solution.tree;
  const OpenTree& open = transport.Tree();
  const std::vector<OpenId> leaves = OpenLeaves(open, tree);
  solution.surface = std::move(surface);
  for (const NodeId element : solution.surface.elements)
  {
    const OpenId leaf = leaves[element];
    const PatchId patchId = tree[element].patch;
    const Patch& patch = tree.Patches()[patchId];
    const PatchOptics& optics = open.Optics()[patchId];
    const double view = open[leaf].IsExposed() ? open[leaf].view / open[leaf].area : 0.0;
    solution.radiance.push_back(optics.emission + transport.Radiance().Received(leaf));
    solution.irradiance.push_back(transport.Radiance().Arriving(leaf));
    solution.unshotRadiance.emplace_back(0.0);
    solution.importance.push_back(Color(view) + transport.Importance().Arriving(leaf));
    solution.unshotImportance.emplace_back(0.0);
    solution.viewImportance.push_back(view);
    solution.albedo.push_back(optics.albedo);
    solution.emission.push_back(optics.emission);
    solution.patch.push_back(patchId);
    solution.scenePolygon.push_back(facets.facets[patch.facet].ScenePolygonOf(patch.side));
    solution.side.push_back(patch.side);
    solution.level.push_back(tree[element].level);
  }
  solution.pointRadiance = PointValues(solution.surface, solution.radiance);
  solution.pointIrradiance = PointValues(solution.surface, solution.irradiance);
  return solution;
}

std::vector<InteractionRecord> ExtractInteractions(const GoalOrientedTransport& transport)
{
  const OpenTree& tree = transport.Tree();
  const auto levelOf = [&tree](OpenId id)
  { return tree.Geometry(id).IsCluster() ? InteractionRecord::ClusterLevel : tree[id].level; };
  std::vector<InteractionRecord> records;
  records.reserve(transport.LinkCount());
  for (const Link& link : transport.Links())
  {
    const LinkKind kind = KindOf(tree, link);
    const auto sent = [&](int end) { return transport.Radiance().Weighted(kind, link.ends[end]); };
    const auto power = [&](int end)
    { return link.throughput * transport.ClosureOf(kind, link.ends[1 - end]) * Mean(sent(end)); };
    const int shooter = power(1) > power(0) ? 1 : 0;
    const OpenId from = link.ends[shooter];
    const OpenId to = link.ends[1 - shooter];
    InteractionRecord record;
    record.shooterCentre = tree.Geometry(from).centre;
    record.receiverCentre = tree.Geometry(to).centre;
    record.shooter = tree.Geometry(from).patch;
    record.receiver = tree.Geometry(to).patch;
    record.shooterLevel = levelOf(from);
    record.receiverLevel = levelOf(to);
    record.formFactor = link.throughput / tree[from].area;
    record.visibility = link.visibility;
    record.shotFlux = link.IsSelf() ? power(0) : power(0) + power(1);
    record.contribution = 0.0;
    for (int end = 0; end < (link.IsSelf() ? 1 : 2); ++end)
    {
      record.contribution += link.throughput * Mean(sent(end) * transport.Importance().Weighted(
                                                                  kind, link.ends[1 - end]));
    }
    record.step = link.step;
    records.push_back(record);
  }
  return records;
}

} // namespace vantage
