#include "core/transport/Transport.h"

#include <algorithm>
#include <utility>

namespace vantage
{

namespace
{

/// What a part of an end has shot when the whole end, with mean `whole`, has shot `shot`.
Color InheritedPart(const Color& shot, const Color& whole, const Color& part)
{
  Color inherited(0.0);
  for (int k = 0; k < 3; ++k)
  {
    inherited[k] = whole[k] > 0.0 ? part[k] * std::min(1.0, shot[k] / whole[k]) : 0.0;
  }
  return inherited;
}

} // namespace

Color UnshotPart(const Color& total, const Color& shot)
{
  constexpr double Roundings = 8.0 * 2.3e-16;
  Color rest(0.0);
  for (int k = 0; k < 3; ++k)
  {
    const double difference = total[k] - shot[k];
    rest[k] = difference > Roundings * total[k] ? difference : 0.0;
  }
  return rest;
}

Transport::Transport(ElementTree tree, const OccluderScene& occluders,
  std::vector<PatchOptics> optics, double meanFacetArea, const TransportSettings& settings)
  : TheTree(std::move(tree))
  , Optics(std::move(optics))
  , Evaluator(occluders, settings.accuracy, settings.visibilityRays)
  , TheRefiner(settings.refinement, meanFacetArea)
  , TheGraph(this->TheTree.Patches().size())
  , Expanded(this->TheTree.Patches().size(), 0)
{
  this->ReceivedRadiance.Follow(this->TheTree);
  this->ReceivedImportances.Follow(this->TheTree);
  this->View.Set(this->TheTree, {});
  this->MeasureOptics();
}

void Transport::SetOptics(std::vector<PatchOptics> optics)
{
  this->Optics = std::move(optics);
  this->ReceivedRadiance.Clear();
  this->ReceivedImportances.Clear();
  for (InteractionId id = 0; id < this->TheGraph.Size(); ++id)
  {
    this->TheGraph[id].shotRadiance = { Color(0.0), Color(0.0) };
    this->TheGraph[id].shotImportance = { Color(0.0), Color(0.0) };
  }
  this->MeasureOptics();
  this->ResetFlux();
}

void Transport::SetView(std::vector<ViewSample> samples)
{
  this->View.Set(this->TheTree, std::move(samples));
  this->IsViewSet = true;
  this->ReceivedImportances.Clear();
  for (InteractionId id = 0; id < this->TheGraph.Size(); ++id)
  {
    this->TheGraph[id].shotImportance = { Color(0.0), Color(0.0) };
  }
  this->ResetFlux();
}

void Transport::Expand(PatchId patch, std::uint32_t step)
{
  if (this->IsExpanded(patch))
  {
    return;
  }
  const NodeId self = this->TheTree.Patches()[patch].node;
  std::vector<ElementPair> pairs;
  for (const NodeId other : this->PatchesInFrontOf(patch))
  {
    if (!this->IsExpanded(this->TheTree[other].patch))
    {
      ElementPair pair;
      pair.first = std::min(self, other);
      pair.second = std::max(self, other);
      pair.isRoot = true;
      pairs.push_back(pair);
    }
  }
  const std::vector<PairValue> values = this->EvaluateAndCount(pairs);
  for (std::size_t i = 0; i < pairs.size(); ++i)
  {
    if (values[i].throughput > 0.0)
    {
      this->TheGraph.Add(this->TheTree, this->MakeInteraction(pairs[i], values[i], step));
    }
  }
  this->Expanded[patch] = 1;
  if (this->TheRefiner.DependsOnGeometryOnly())
  {
    this->RefineInteractionsOf(patch, Flow::Leaving, step);
  }
}

void Transport::RefineInteractionsOf(PatchId patch, Flow flow, std::uint32_t step)
{
  // One level of all interactions at a time, so that the new pairs are evaluated in parallel.
  std::vector<InteractionId> candidates = this->TheGraph.Of(patch);
  while (!candidates.empty())
  {
    std::vector<Refinement> refinements;
    for (const InteractionId id : candidates)
    {
      const End own = EndOn(this->TheTree, this->TheGraph[id], patch);
      const auto split = this->EndToSplit(id, flow == Flow::Leaving ? own : Other(own));
      if (split)
      {
        refinements.push_back({ id, *split });
      }
    }
    const InteractionId firstNew = this->TheGraph.Size();
    this->Refine(refinements, step);
    candidates.clear();
    for (InteractionId id = firstNew; id < this->TheGraph.Size(); ++id)
    {
      candidates.push_back(id);
    }
  }
}

bool Transport::RefineInteraction(InteractionId id, End shooter, std::uint32_t step)
{
  const auto split = this->EndToSplit(id, shooter);
  if (split)
  {
    this->Refine({ { id, *split } }, step);
  }
  return split.has_value();
}

void Transport::ShootRadiance(InteractionId id, End shooter)
{
  Interaction& link = this->TheGraph[id];
  const Color radiance = this->LeavingRadiance(id, shooter);
  const Color unshot = UnshotPart(radiance, link.shotRadiance[shooter]);
  if (MaxChannel(unshot) == 0.0)
  {
    return;
  }
  const NodeId receiver = link.ends[Other(shooter)];
  const double area = this->TheTree[receiver].area;
  const Color reflected = this->Brdf(receiver) * unshot * (link.throughput / area);
  this->FluxEstimate += unshot * link.throughput * this->UnshotImportance(id, Other(shooter));
  this->FluxReceived += reflected * (area * this->ViewImportance(receiver));
  this->ReceivedRadiance.Receive(this->TheTree, receiver, reflected);
  link.shotRadiance[shooter] = radiance;
}

void Transport::ShootImportance(InteractionId id, End shooter)
{
  Interaction& link = this->TheGraph[id];
  const Color importance = this->LeavingImportance(id, shooter);
  const Color unshot = UnshotPart(importance, link.shotImportance[shooter]);
  if (MaxChannel(unshot) == 0.0)
  {
    return;
  }
  const NodeId receiver = link.ends[Other(shooter)];
  this->FluxEstimate += unshot * link.throughput * this->UnshotRadiance(id, Other(shooter));
  this->ReceivedImportances.Receive(
    this->TheTree, receiver, unshot * (link.throughput / this->TheTree[receiver].area));
  link.shotImportance[shooter] = importance;
}

Color Transport::LeavingRadiance(InteractionId id, End shooter) const
{
  return this->Radiance(this->TheGraph[id].ends[shooter]);
}

Color Transport::LeavingImportance(InteractionId id, End shooter) const
{
  const NodeId node = this->TheGraph[id].ends[shooter];
  return this->Brdf(node) * this->Importance(node);
}

Color Transport::UnshotRadiance(InteractionId id, End shooter) const
{
  return UnshotPart(this->LeavingRadiance(id, shooter), this->TheGraph[id].shotRadiance[shooter]);
}

Color Transport::UnshotImportance(InteractionId id, End shooter) const
{
  return UnshotPart(
    this->LeavingImportance(id, shooter), this->TheGraph[id].shotImportance[shooter]);
}

Color Transport::Radiance(NodeId node) const
{
  return this->Optics[this->TheTree[node].patch].emission +
         this->ReceivedRadiance.Value(this->TheTree, node);
}

Color Transport::ReceivedImportance(NodeId node) const
{
  return this->ReceivedImportances.Value(this->TheTree, node);
}

Color Transport::Importance(NodeId node) const
{
  return Color(this->ViewImportance(node)) + this->ReceivedImportance(node);
}

double Transport::ViewImportance(NodeId node) const
{
  return this->View.Value(this->TheTree, node);
}

Color Transport::ViewFluxOfRadiance() const
{
  Color flux(0.0);
  for (NodeId n = 0; n < this->TheTree.Size(); ++n)
  {
    const Node& node = this->TheTree[n];
    if (!node.IsCluster() && node.IsLeaf())
    {
      flux += this->Radiance(n) * (node.area * this->ViewImportance(n));
    }
  }
  return flux;
}

Color Transport::ViewFluxOfImportance() const
{
  // Emission is constant over a patch, so the mean importance of the patch is all that matters.
  Color flux(0.0);
  for (PatchId p = 0; p < this->Optics.size(); ++p)
  {
    const Patch& patch = this->TheTree.Patches()[p];
    if (patch.IsActive())
    {
      flux +=
        this->Optics[p].emission * this->Importance(patch.node) * this->TheTree[patch.node].area;
    }
  }
  return flux;
}

std::size_t Transport::Bytes() const
{
  return this->TheTree.Size() * sizeof(Node) + this->TheGraph.Bytes() +
         this->ReceivedRadiance.Bytes() + this->ReceivedImportances.Bytes() + this->View.Bytes();
}

Color Transport::Brdf(NodeId node) const
{
  return this->Optics[this->TheTree[node].patch].albedo / Pi;
}

std::optional<End> Transport::EndToSplit(InteractionId id, End shooter) const
{
  const Interaction& link = this->TheGraph[id];
  const Color power = this->LeavingRadiance(id, shooter) * link.throughput;
  RefinementQuery query;
  query.first = link.ends[0];
  query.second = link.ends[1];
  query.throughput = link.throughput;
  query.visibility = link.visibility;
  query.relativePower =
    this->StrongestEmitterPower > 0.0 ? Mean(power) / this->StrongestEmitterPower : 0.0;
  const PatchId patch = this->TheTree[link.ends[shooter]].patch;
  query.isDirect = MaxChannel(this->Optics[patch].emission) > 0.0;
  return this->TheRefiner.EndToSplit(this->TheTree, query);
}

void Transport::Refine(const std::vector<Refinement>& refinements, std::uint32_t step)
{
  std::vector<ElementPair> pairs;
  std::vector<InteractionId> parents;
  for (const Refinement& refinement : refinements)
  {
    const Interaction& parent = this->TheGraph[refinement.parent];
    const NodeId node = parent.ends[refinement.splitEnd];
    this->SplitNode(node);
    const NodeId firstChild = this->TheTree[node].firstChild;
    for (NodeId child = firstChild; child < firstChild + this->TheTree[node].childCount; ++child)
    {
      ElementPair pair;
      pair.first = refinement.splitEnd == 0 ? child : parent.ends[0];
      pair.second = refinement.splitEnd == 1 ? child : parent.ends[1];
      pair.parentVisibility = parent.visibility;
      pair.parentAgreeingRays = parent.agreeingRays;
      pairs.push_back(pair);
      parents.push_back(refinement.parent);
    }
  }
  const std::vector<PairValue> values = this->EvaluateAndCount(pairs);
  for (std::size_t i = 0; i < pairs.size(); ++i)
  {
    if (values[i].throughput > 0.0)
    {
      Interaction child = this->MakeInteraction(pairs[i], values[i], step);
      this->InheritShotParts(child, this->TheGraph[parents[i]]);
      this->TheGraph.Add(this->TheTree, child);
    }
  }
  for (const Refinement& refinement : refinements)
  {
    this->TheGraph.Retire(refinement.parent);
  }
}

void Transport::SplitNode(NodeId node)
{
  if (!this->TheTree[node].IsLeaf())
  {
    return;
  }
  this->TheTree.Split(node);
  this->ReceivedRadiance.Follow(this->TheTree);
  this->ReceivedImportances.Follow(this->TheTree);
  this->View.FollowSplit(this->TheTree, node);
}

std::vector<NodeId> Transport::PatchesInFrontOf(PatchId patch) const
{
  const Patch& self = this->TheTree.Patches()[patch];
  const Plane plane = SupportingPlane(this->TheTree.Shape(self.node));
  std::vector<NodeId> found;
  std::vector<NodeId> pending{ this->TheTree.Root() };
  while (!pending.empty())
  {
    const NodeId id = pending.back();
    pending.pop_back();
    const Node& node = this->TheTree[id];
    if (id == self.node || plane.Distance(node.centre) + node.radius <= 0.0)
    {
      continue;
    }
    if (!node.IsCluster())
    {
      found.push_back(id);
      continue;
    }
    for (NodeId child = node.firstChild; child < node.firstChild + node.childCount; ++child)
    {
      pending.push_back(child);
    }
  }
  std::sort(found.begin(), found.end());
  return found;
}

Interaction Transport::MakeInteraction(
  const ElementPair& pair, const PairValue& value, std::uint32_t step) const
{
  Interaction link;
  link.ends = { pair.first, pair.second };
  link.throughput = value.throughput;
  link.visibility = value.visibility;
  link.agreeingRays = value.agreeingRays;
  link.step = step;
  return link;
}

void Transport::InheritShotParts(Interaction& child, const Interaction& parent) const
{
  for (End end = 0; end < 2; ++end)
  {
    const NodeId whole = parent.ends[end];
    const NodeId part = child.ends[end];
    child.shotRadiance[end] =
      InheritedPart(parent.shotRadiance[end], this->Radiance(whole), this->Radiance(part));
    const Color brdf = this->Brdf(part);
    child.shotImportance[end] = InheritedPart(
      parent.shotImportance[end], brdf * this->Importance(whole), brdf * this->Importance(part));
  }
}

std::vector<PairValue> Transport::EvaluateAndCount(const std::vector<ElementPair>& pairs)
{
  std::vector<PairValue> values = this->Evaluator.Evaluate(this->TheTree, pairs);
  this->Counts.evaluations += pairs.size();
  for (const PairValue& value : values)
  {
    this->Counts.rays += value.rays;
  }
  return values;
}

void Transport::MeasureOptics()
{
  this->TotalEmittedPower = 0.0;
  this->StrongestEmitterPower = 0.0;
  this->AreaOfAll = 0.0;
  double reflectingArea = 0.0;
  for (PatchId p = 0; p < this->Optics.size(); ++p)
  {
    const Patch& patch = this->TheTree.Patches()[p];
    if (patch.IsActive())
    {
      const double area = this->TheTree[patch.node].area;
      const double power = Pi * area * Mean(this->Optics[p].emission);
      this->AreaOfAll += area;
      reflectingArea += area * Mean(this->Optics[p].albedo);
      this->TotalEmittedPower += power;
      this->StrongestEmitterPower = std::max(this->StrongestEmitterPower, power);
    }
  }
  this->AlbedoOfAll = reflectingArea / this->AreaOfAll;
}

void Transport::ResetFlux()
{
  this->FluxReceived = this->ViewFluxOfRadiance();
  this->FluxEstimate = this->FluxReceived;
}

} // namespace vantage
