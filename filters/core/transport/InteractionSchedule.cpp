#include "core/transport/InteractionSchedule.h"

#include <algorithm>

namespace vantage
{

InteractionSchedule::InteractionSchedule(Method method, const Transport& transport)
  : TheMethod(method)
  , States(transport.Tree().Patches().size())
{
}

std::optional<Step> InteractionSchedule::Next(Transport& transport, std::uint32_t stepNumber)
{
  if (this->TheMethod == Method::BasicShooting)
  {
    return this->NextInTurn(transport, stepNumber);
  }
  if (this->TheMethod == Method::ProgressiveShooting)
  {
    return this->HighestRanked(transport, Quantity::Radiance, stepNumber);
  }
  const Quantity wanted =
    this->LastShot == Quantity::Radiance ? Quantity::Importance : Quantity::Radiance;
  const auto step = this->HighestRanked(transport, wanted, stepNumber);
  return step ? step : this->HighestRanked(transport, this->LastShot, stepNumber);
}

void InteractionSchedule::Perform(Transport& transport, const Step& step, std::uint32_t stepNumber)
{
  if (step.interaction == None)
  {
    transport.Expand(step.patch, stepNumber);
    ShootPatch(transport, step.patch, step.quantity);
    this->MarkAllStale();
    return;
  }
  const Interaction& link = transport.Graph()[step.interaction];
  const End shooter = EndOn(transport.Tree(), link, step.patch);
  const PatchId receiver = transport.Tree()[link.ends[Other(shooter)]].patch;
  const bool isImportance = step.quantity == Quantity::Importance;
  if (isImportance)
  {
    transport.ShootImportance(step.interaction, shooter);
  }
  else
  {
    transport.ShootRadiance(step.interaction, shooter);
  }
  this->MarkStale(transport, step.patch, false);
  // The importance of the receiver is in the rank of everyone who could shoot radiance to it.
  this->MarkStale(transport, receiver, isImportance);
  this->LastShot = step.quantity;
}

Residual InteractionSchedule::Rest(const Transport& transport)
{
  this->Refresh(transport);
  ViewResidual rest;
  for (const PatchState& state : this->States)
  {
    rest.unshotPower += state.rest.unshotPower;
    rest.knownUnshot += state.rest.knownUnshot;
    rest.unshotImportance += state.rest.unshotImportance;
  }
  return { rest.unshotPower, this->TheMethod == Method::ImportanceShooting
                               ? RelativeUnshotFlux(transport, rest)
                               : RelativeUnshotPower(transport, rest.unshotPower) };
}

void InteractionSchedule::RestartRadiance(const Transport&)
{
  this->MarkAllStale();
  this->Cursor = 0;
  this->Turn.clear();
}

void InteractionSchedule::RestartImportance()
{
  this->MarkAllStale();
  this->LastShot = Quantity::Radiance;
}

std::optional<Step> InteractionSchedule::NextInTurn(Transport& transport, std::uint32_t stepNumber)
{
  this->Refresh(transport);
  const PatchId count = static_cast<PatchId>(this->States.size());
  for (PatchId tried = 0; tried <= count; ++tried)
  {
    while (!this->Turn.empty())
    {
      Step step;
      step.patch = this->Cursor;
      step.interaction = this->Turn.back();
      this->Turn.pop_back();
      const Interaction& link = transport.Graph()[step.interaction];
      const End end = EndOn(transport.Tree(), link, step.patch);
      if (MaxChannel(transport.UnshotRadiance(step.interaction, end)) > 0.0)
      {
        return step;
      }
    }
    this->Cursor = (this->Cursor + 1) % count;
    if (this->States[this->Cursor].rest.unshotPower > 0.0)
    {
      transport.Expand(this->Cursor, stepNumber);
      this->MarkStale(transport, this->Cursor, true);
      this->Refresh(transport);
      this->Turn = transport.Graph().Of(this->Cursor);
      std::reverse(this->Turn.begin(), this->Turn.end());
    }
  }
  return std::nullopt;
}

std::optional<Step> InteractionSchedule::HighestRanked(
  Transport& transport, Quantity quantity, std::uint32_t stepNumber)
{
  while (true)
  {
    this->Refresh(transport);
    Candidate best;
    PatchId patch = None;
    for (PatchId p = 0; p < this->States.size(); ++p)
    {
      const PatchState& state = this->States[p];
      const Candidate& candidate =
        quantity == Quantity::Radiance ? state.radiance : state.importance;
      if (candidate.rank > best.rank)
      {
        best = candidate;
        patch = p;
      }
    }
    if (patch == None)
    {
      return std::nullopt;
    }
    if (best.interaction == None)
    {
      transport.Expand(patch, stepNumber);
      this->MarkStale(transport, patch, true);
      continue;
    }
    Step step;
    step.quantity = quantity;
    step.patch = patch;
    step.interaction = best.interaction;
    return step;
  }
}

void InteractionSchedule::Refresh(const Transport& transport)
{
  for (PatchId p = 0; p < this->States.size(); ++p)
  {
    if (this->States[p].isStale)
    {
      this->States[p] = this->Assess(transport, p);
      this->States[p].isStale = false;
    }
  }
}

InteractionSchedule::PatchState InteractionSchedule::Assess(
  const Transport& transport, PatchId patch) const
{
  if (!transport.Tree().Patches()[patch].IsActive())
  {
    return PatchState();
  }
  PatchState state;
  if (!transport.IsExpanded(patch))
  {
    return this->AssessUnexpanded(transport, patch);
  }
  const bool usesImportance = this->TheMethod == Method::ImportanceShooting;
  for (const InteractionId id : transport.Graph().Of(patch))
  {
    const Interaction& link = transport.Graph()[id];
    const End end = EndOn(transport.Tree(), link, patch);
    const Color unshot = transport.UnshotRadiance(id, end);
    const double power = Mean(unshot) * link.throughput;
    double rank = power;
    state.rest.unshotPower += power;
    if (usesImportance)
    {
      rank = Mean(unshot * transport.LeavingImportance(id, Other(end))) * link.throughput;
      state.rest.knownUnshot += rank;
      const double importance = Mean(transport.UnshotImportance(id, end)) * link.throughput;
      state.rest.unshotImportance += importance;
      if (importance > state.importance.rank)
      {
        state.importance = { importance, id };
      }
    }
    if (rank > state.radiance.rank)
    {
      state.radiance = { rank, id };
    }
  }
  return state;
}

InteractionSchedule::PatchState InteractionSchedule::AssessUnexpanded(
  const Transport& transport, PatchId patch) const
{
  PatchState state;
  const NodeId node = transport.Tree().Patches()[patch].node;
  const double area = transport.Tree()[node].area;
  const Color radiance = transport.Radiance(node);
  state.rest.unshotPower = Pi * area * Mean(radiance);
  state.radiance.rank = state.rest.unshotPower;
  if (this->TheMethod == Method::ImportanceShooting)
  {
    state.rest.knownUnshot = area * Mean(radiance * transport.ReceivedImportance(node));
    state.radiance.rank = state.rest.knownUnshot;
    state.rest.unshotImportance = Pi * area * Mean(transport.ReflectedImportance(node));
    state.importance.rank = state.rest.unshotImportance;
  }
  return state;
}

void InteractionSchedule::MarkStale(Transport& transport, PatchId patch, bool withNeighbours)
{
  this->States[patch].isStale = true;
  if (!withNeighbours)
  {
    return;
  }
  for (const InteractionId id : transport.Graph().Of(patch))
  {
    const Interaction& link = transport.Graph()[id];
    const NodeId other = link.ends[Other(EndOn(transport.Tree(), link, patch))];
    this->States[transport.Tree()[other].patch].isStale = true;
  }
}

void InteractionSchedule::MarkAllStale()
{
  for (PatchState& state : this->States)
  {
    state.isStale = true;
  }
}

} // namespace vantage
