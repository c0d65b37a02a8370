#include "core/Solution.h"

#include "core/transport/Transport.h"

namespace vantage
{

namespace
{

/// What is still unshot at the nodes: the mean over the interactions of a node, its ancestors'
/// included, by throughput. A patch whose interactions do not exist yet has shot nothing.
class UnshotMeans
{
public:
  explicit UnshotMeans(const Transport& transport)
    : TheTransport(&transport)
    , Nodes(transport.Tree().Size())
  {
    for (InteractionId id = 0; id < transport.Graph().Size(); ++id)
    {
      const Interaction& link = transport.Graph()[id];
      for (End end = 0; end < 2; ++end)
      {
        Sums& sums = this->Nodes[link.ends[end]];
        sums.throughput += link.throughput;
        sums.radiance += link.throughput * transport.UnshotRadiance(id, end);
        sums.importance += link.throughput * transport.UnshotImportance(id, end);
      }
    }
  }

  Color Radiance(NodeId leaf) const
  {
    const Transport& transport = *this->TheTransport;
    const Sums sums = this->PathSums(leaf);
    return this->IsExpanded(leaf) ? Quotient(sums.radiance, sums.throughput)
                                  : transport.Radiance(leaf);
  }

  Color Importance(NodeId leaf) const
  {
    const Transport& transport = *this->TheTransport;
    const Sums sums = this->PathSums(leaf);
    return this->IsExpanded(leaf) ? Quotient(sums.importance, sums.throughput)
                                  : transport.ReflectedImportance(leaf);
  }

private:
  struct Sums
  {
    double throughput = 0.0;
    Color radiance{ 0.0 };
    Color importance{ 0.0 };
  };

  static Color Quotient(const Color& sum, double weight)
  {
    return weight > 0.0 ? sum / weight : Color(0.0);
  }

  bool IsExpanded(NodeId leaf) const
  {
    return this->TheTransport->IsExpanded(this->TheTransport->Tree()[leaf].patch);
  }

  /// Sums per area over the path from the patch to the leaf.
  Sums PathSums(NodeId leaf) const
  {
    const ElementTree& tree = this->TheTransport->Tree();
    Sums total;
    for (NodeId n = leaf;; n = tree[n].parent)
    {
      const double share = 1.0 / tree[n].area;
      total.throughput += share * this->Nodes[n].throughput;
      total.radiance += share * this->Nodes[n].radiance;
      total.importance += share * this->Nodes[n].importance;
      if (tree[n].level == 0)
      {
        return total;
      }
    }
  }

  const Transport* TheTransport;
  std::vector<Sums> Nodes;
};

} // namespace

ElementSolution ExtractElements(
  const Transport& transport, const FacetSet& facets, ElementTree elements, ElementSurface surface)
{
  const UnshotMeans unshot(transport);
  ElementSolution solution;
  solution.tree = std::make_shared<const ElementTree>(std::move(elements));
  const ElementTree& tree = *solution.tree;
  solution.surface = std::move(surface);
  for (const NodeId element : solution.surface.elements)
  {
    NodeId known = element;
    while (known >= transport.Tree().Size())
    {
      known = tree[known].parent;
    }
    const PatchId patchId = tree[element].patch;
    const Patch& patch = tree.Patches()[patchId];
    solution.radiance.push_back(transport.Radiance(known));
    solution.unshotRadiance.push_back(unshot.Radiance(known));
    solution.importance.push_back(transport.Importance(known));
    solution.unshotImportance.push_back(unshot.Importance(known));
    solution.viewImportance.push_back(transport.ViewImportance(known));
    solution.albedo.push_back(transport.OpticsOf(patchId).albedo);
    solution.emission.push_back(transport.OpticsOf(patchId).emission);
    solution.patch.push_back(patchId);
    solution.scenePolygon.push_back(facets.facets[patch.facet].ScenePolygonOf(patch.side));
    solution.side.push_back(patch.side);
    solution.level.push_back(tree[element].level);
  }
  solution.pointRadiance = PointValues(solution.surface, solution.radiance);
  return solution;
}

std::vector<InteractionRecord> ExtractInteractions(const Transport& transport)
{
  const ElementTree& tree = transport.Tree();
  std::vector<InteractionRecord> records;
  records.reserve(transport.Graph().Size());
  for (InteractionId id = 0; id < transport.Graph().Size(); ++id)
  {
    const Interaction& link = transport.Graph()[id];
    const auto power = [&](End end) { return Mean(link.shotRadiance[end]) * link.throughput; };
    // The end that has sent more is called the shooter.
    const End shooter = power(1) > power(0) ? 1 : 0;
    const Node& from = tree[link.ends[shooter]];
    const Node& to = tree[link.ends[Other(shooter)]];
    InteractionRecord record;
    record.shooterCentre = from.centre;
    record.receiverCentre = to.centre;
    record.shooter = from.patch;
    record.receiver = to.patch;
    record.shooterLevel = from.level;
    record.receiverLevel = to.level;
    record.formFactor = link.throughput / from.area;
    record.visibility = link.visibility;
    record.shotFlux = power(0) + power(1);
    record.contribution = 0.0;
    for (End end = 0; end < 2; ++end)
    {
      record.contribution += link.throughput * Mean(link.shotRadiance[end] *
                                                    transport.LeavingImportance(id, Other(end)));
    }
    record.step = link.step;
    records.push_back(record);
  }
  return records;
}

} // namespace vantage
