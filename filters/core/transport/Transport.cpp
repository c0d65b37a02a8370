#include "core/transport/Transport.h"

#include "core/transport/Closure.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <numeric>
#include <utility>

namespace vantage
{

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
  , Occluders(&occluders)
  , Optics(std::move(optics))
  , Evaluator(occluders, settings.accuracy, settings.visibilityRays)
  , TheRefiner(settings.refinement, meanFacetArea)
  , Prediction(this->TheTree, occluders, this->Optics)
  , Predicted(this->TheTree.Patches().size(), NotPredicted)
  , TheGraph(this->TheTree.Patches().size())
  , WeightedView(this->TheTree.Size(), 0.0)
  , Expanded(this->TheTree.Patches().size(), 0)
{
  this->RadianceField.Follow(this->TheTree);
  this->ImportanceField.Follow(this->TheTree);
  this->View.Set(this->TheTree, {});
  this->MeasureOptics();
}

void Transport::SetOptics(std::vector<PatchOptics> optics)
{
  this->Optics = std::move(optics);
  this->Prediction = RadiancePrediction(this->TheTree, *this->Occluders, this->Optics);
  this->Predicted.assign(this->Predicted.size(), NotPredicted);
  this->RadianceField.Clear();
  this->ImportanceField.Clear();
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
  this->ImportanceField.Clear();
  for (InteractionId id = 0; id < this->TheGraph.Size(); ++id)
  {
    this->TheGraph[id].shotImportance = { Color(0.0), Color(0.0) };
  }
  this->VisiblePatches.clear();
  for (PatchId p = 0; p < this->Optics.size(); ++p)
  {
    const Patch& patch = this->TheTree.Patches()[p];
    if (patch.IsActive())
    {
      this->WeighView(patch.node);
      if (!this->IsExpanded(p) && this->ViewImportance(patch.node) > 0.0)
      {
        this->VisiblePatches.push_back(p);
      }
    }
  }
  std::reverse(this->VisiblePatches.begin(), this->VisiblePatches.end());
  this->ResetFlux();
}

void Transport::Expand(PatchId patch, std::uint32_t step)
{
  if (this->IsExpanded(patch))
  {
    return;
  }
  // One level of all interactions at a time, so that pairs are evaluated in parallel.
  std::vector<Candidate> candidates = this->RootCandidates(patch);
  while (!candidates.empty())
  {
    this->Evaluate(candidates);
    std::vector<Candidate> finer;
    for (const Candidate& candidate : candidates)
    {
      if (candidate.value.throughput == 0.0)
      {
        continue;
      }
      if (const SplitChoice choice = this->ChooseSplit(candidate); choice.Any())
      {
        const std::vector<Candidate> children = this->Refine(candidate, choice);
        finer.insert(finer.end(), children.begin(), children.end());
      }
      else
      {
        this->AddInteraction(candidate, step);
      }
    }
    candidates = std::move(finer);
  }
  this->Expanded[patch] = 1;
  this->CloseRows(patch);
}

bool Transport::ExpandNextVisible(std::uint32_t step)
{
  while (!this->VisiblePatches.empty())
  {
    const PatchId patch = this->VisiblePatches.back();
    this->VisiblePatches.pop_back();
    if (!this->IsExpanded(patch))
    {
      this->Expand(patch, step);
      return true;
    }
  }
  return false;
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
  const Color power = unshot * link.throughput;
  const Color seen = power * this->Brdf(receiver) * this->WeightedView[receiver];
  this->FluxReceived += seen;
  this->FluxEstimate += this->IsExpanded(this->TheTree[receiver].patch)
                          ? power * this->UnshotImportance(id, Other(shooter))
                          : seen;
  this->RadianceField.Receive(this->TheTree, receiver, power / this->TheTree[receiver].area);
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
  const Color flow = unshot * link.throughput;
  if (this->IsExpanded(this->TheTree[receiver].patch))
  {
    this->FluxEstimate += flow * this->UnshotRadiance(id, Other(shooter));
  }
  this->ImportanceField.Receive(this->TheTree, receiver, flow / this->TheTree[receiver].area);
  link.shotImportance[shooter] = importance;
}

Color Transport::LeavingRadiance(InteractionId id, End shooter) const
{
  return this->Radiance(this->TheGraph[id].ends[shooter]);
}

Color Transport::LeavingImportance(InteractionId id, End shooter) const
{
  return this->ReflectedImportance(this->TheGraph[id].ends[shooter]);
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
         this->Brdf(node) * this->RadianceField.Weighted(this->TheTree, node);
}

Color Transport::Importance(NodeId node) const
{
  return Color(this->ViewImportance(node)) + this->ReceivedImportance(node);
}

Color Transport::ReceivedImportance(NodeId node) const
{
  return this->ImportanceField.Received(this->TheTree, node);
}

Color Transport::ReflectedImportance(NodeId node) const
{
  return this->Brdf(node) *
         (Color(this->WeightedView[node]) + this->ImportanceField.Weighted(this->TheTree, node));
}

double Transport::ViewImportance(NodeId node) const
{
  return this->View.Value(this->TheTree, node);
}

double Transport::ClosureWeight(NodeId leaf) const
{
  return this->RadianceField.Weight(leaf);
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
         this->RadianceField.Bytes() + this->ImportanceField.Bytes() + this->View.Bytes();
}

Color Transport::Brdf(NodeId node) const
{
  return this->Optics[this->TheTree[node].patch].albedo / Pi;
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

std::vector<Transport::Candidate> Transport::RootCandidates(PatchId patch)
{
  const NodeId self = this->TheTree.Patches()[patch].node;
  std::vector<Candidate> candidates;
  for (const NodeId other : this->PatchesInFrontOf(patch))
  {
    if (!this->IsExpanded(this->TheTree[other].patch))
    {
      Candidate candidate;
      candidate.pair.first = std::min(self, other);
      candidate.pair.second = std::max(self, other);
      candidate.pair.isRoot = true;
      candidates.push_back(candidate);
    }
  }
  return candidates;
}

std::vector<Transport::Candidate> Transport::Refine(const Candidate& coarse, SplitChoice choice)
{
  std::vector<Candidate> finer;
  for (const NodeId first : this->Parts(coarse.pair.first, choice.first))
  {
    for (const NodeId second : this->Parts(coarse.pair.second, choice.second))
    {
      Candidate candidate;
      candidate.pair.first = first;
      candidate.pair.second = second;
      candidate.pair.parentVisibility = coarse.value.visibility;
      candidate.pair.parentAgreeingRays = coarse.value.agreeingRays;
      finer.push_back(candidate);
    }
  }
  return finer;
}

std::vector<NodeId> Transport::Parts(NodeId node, bool isSplit)
{
  if (!isSplit)
  {
    return { node };
  }
  this->SplitNode(node);
  std::vector<NodeId> children(this->TheTree[node].childCount);
  std::iota(children.begin(), children.end(), this->TheTree[node].firstChild);
  return children;
}

void Transport::Evaluate(std::vector<Candidate>& candidates)
{
  tbb::parallel_for(std::size_t(0), candidates.size(),
    [&](std::size_t i)
    { candidates[i].value = this->Evaluator.Evaluate(this->TheTree, candidates[i].pair); });
  this->Counts.evaluations += candidates.size();
  for (const Candidate& candidate : candidates)
  {
    this->Counts.rays += candidate.value.rays;
  }
}

SplitChoice Transport::ChooseSplit(const Candidate& candidate)
{
  const PatchId first = this->TheTree[candidate.pair.first].patch;
  const PatchId second = this->TheTree[candidate.pair.second].patch;
  const double radiance = std::max(this->PredictedRadiance(first), this->PredictedRadiance(second));
  const double strongest = this->Prediction.StrongestPower();
  RefinementQuery query;
  query.first = candidate.pair.first;
  query.second = candidate.pair.second;
  query.throughput = candidate.value.throughput;
  query.visibility = candidate.value.visibility;
  query.relativePower = strongest > 0.0 ? radiance * query.throughput / strongest : 0.0;
  query.isDirect = MaxChannel(this->Optics[first].emission) > 0.0 ||
                   MaxChannel(this->Optics[second].emission) > 0.0;
  return this->TheRefiner.Choose(this->TheTree, query);
}

double Transport::PredictedRadiance(PatchId patch)
{
  if (this->Predicted[patch] == NotPredicted)
  {
    this->Predicted[patch] = this->Prediction.Of(patch);
  }
  return this->Predicted[patch];
}

void Transport::SplitNode(NodeId node)
{
  if (!this->TheTree[node].IsLeaf())
  {
    return;
  }
  const NodeId firstChild = this->TheTree.Split(node);
  this->RadianceField.Follow(this->TheTree);
  this->ImportanceField.Follow(this->TheTree);
  this->View.FollowSplit(this->TheTree, node);
  this->WeightedView.resize(this->TheTree.Size());
  for (NodeId c = firstChild; c < this->TheTree.Size(); ++c)
  {
    this->WeightedView[c] = this->ViewImportance(c);
  }
}

void Transport::AddInteraction(const Candidate& candidate, std::uint32_t step)
{
  Interaction link;
  link.ends = { candidate.pair.first, candidate.pair.second };
  link.throughput = candidate.value.throughput;
  link.visibility = candidate.value.visibility;
  link.step = step;
  this->TheGraph.Add(this->TheTree, link);
}

void Transport::CloseRows(PatchId patch)
{
  const NodeId root = this->TheTree.Patches()[patch].node;
  const auto leafSum = [&](auto&& value)
  {
    Color sum(0.0);
    for (const NodeId node : NodesOfPatch(this->TheTree, root))
    {
      if (this->TheTree[node].IsLeaf())
      {
        sum += this->Radiance(node) * this->TheTree[node].area * value(node);
      }
    }
    return sum;
  };
  const auto view = [&](NodeId node) { return Color(this->ViewImportance(node)); };
  const auto received = [&](NodeId node) { return this->ReceivedImportance(node); };

  const Color seenBefore = leafSum(view);
  const std::vector<double> factors =
    ClosureFactors(this->TheTree, *this->Occluders, this->TheGraph, patch);
  this->RadianceField.SetWeights(this->TheTree, root, factors);
  this->ImportanceField.SetWeights(this->TheTree, root, factors);
  this->WeighView(root);
  // All that the patch has is unshot now, and counts where its importance is known.
  const Color change = leafSum(view) - seenBefore;
  this->FluxReceived += change;
  this->FluxEstimate += change + leafSum(received);
}

void Transport::WeighView(NodeId patch)
{
  const std::vector<NodeId> nodes = NodesOfPatch(this->TheTree, patch);
  for (auto n = nodes.rbegin(); n != nodes.rend(); ++n)
  {
    const Node& node = this->TheTree[*n];
    this->WeightedView[*n] =
      node.IsLeaf() ? this->RadianceField.Weight(*n) * this->ViewImportance(*n) : 0.0;
    for (NodeId c = node.firstChild; c < node.firstChild + node.childCount; ++c)
    {
      this->WeightedView[*n] += this->TheTree[c].area / node.area * this->WeightedView[c];
    }
  }
}

void Transport::MeasureOptics()
{
  this->TotalEmittedPower = 0.0;
  this->AreaOfAll = 0.0;
  double reflectingArea = 0.0;
  for (PatchId p = 0; p < this->Optics.size(); ++p)
  {
    const Patch& patch = this->TheTree.Patches()[p];
    if (patch.IsActive())
    {
      const double area = this->TheTree[patch.node].area;
      this->AreaOfAll += area;
      reflectingArea += area * Mean(this->Optics[p].albedo);
      this->TotalEmittedPower += Pi * area * Mean(this->Optics[p].emission);
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
