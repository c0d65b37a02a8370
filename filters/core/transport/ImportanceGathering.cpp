#include "core/transport/ImportanceGathering.h"

namespace vantage
{

ImportanceGathering::ImportanceGathering(const Transport& transport)
  : Ungathered(PatchCount(transport), Color(0.0))
  , ShotImportance(PatchCount(transport), Color(0.0))
{
}

std::optional<Step> ImportanceGathering::Next(Transport& transport, std::uint32_t)
{
  this->CountNewInteractions(transport);
  const PatchId shooter =
    HighestRanked(transport, [&](PatchId p) { return this->ShootRank(transport, p); });
  const PatchId gatherer =
    HighestRanked(transport, [&](PatchId p) { return this->GatherRank(transport, p); });
  if (shooter == None && gatherer == None)
  {
    return std::nullopt;
  }
  Step step;
  if (gatherer == None || (shooter != None && this->LastMoved == Quantity::Radiance))
  {
    step.quantity = Quantity::Importance;
    step.patch = shooter;
  }
  else
  {
    step.kind = Step::Kind::Gather;
    step.patch = gatherer;
  }
  return step;
}

void ImportanceGathering::Perform(Transport& transport, const Step& step, std::uint32_t stepNumber)
{
  transport.Expand(step.patch, stepNumber);
  if (step.quantity == Quantity::Importance)
  {
    this->ShootImportance(transport, step.patch);
  }
  else
  {
    this->ExpandSenders(transport, step.patch, stepNumber);
    this->CountNewInteractions(transport);
    this->Gather(transport, step.patch);
  }
  this->CountNewInteractions(transport);
  this->LastMoved = step.quantity;
}

Residual ImportanceGathering::Rest(const Transport& transport)
{
  this->CountNewInteractions(transport);
  ViewResidual rest;
  for (PatchId p = 0; p < PatchCount(transport); ++p)
  {
    if (PatchArea(transport, p) > 0.0)
    {
      rest.unshotPower += Mean(this->Ungathered[p]);
      if (!transport.IsExpanded(p))
      {
        rest.unshotPower += PatchPower(transport, p, transport.OpticsOf(p).emission);
      }
      rest.knownUnshot += this->GatherRank(transport, p);
      rest.unshotImportance += this->ShootRank(transport, p);
    }
  }
  return { rest.unshotPower, RelativeUnshotFlux(transport, rest) };
}

void ImportanceGathering::RestartRadiance(const Transport& transport)
{
  this->Ungathered.assign(PatchCount(transport), Color(0.0));
  this->Counted = 0;
  this->CountNewInteractions(transport);
}

void ImportanceGathering::RestartImportance()
{
  this->ShotImportance.assign(this->ShotImportance.size(), Color(0.0));
  this->LastMoved = Quantity::Radiance;
}

/// Nothing was carried over them yet. Both ends may be worth something.
void ImportanceGathering::CountNewInteractions(const Transport& transport)
{
  for (; this->Counted < transport.Graph().Size(); ++this->Counted)
  {
    const Interaction& link = transport.Graph()[this->Counted];
    for (const End sender : { 0, 1 })
    {
      this->UngatheredAt(transport, link.ends[Other(sender)]) +=
        link.throughput * transport.UnshotRadiance(this->Counted, sender);
    }
  }
}

/// Those that have something to send. As a patch is expanded before it gathers, the others emit
/// nothing and have received nothing.
void ImportanceGathering::ExpandSenders(
  Transport& transport, PatchId receiver, std::uint32_t stepNumber)
{
  for (const InteractionId id : transport.Graph().Of(receiver))
  {
    const Interaction& link = transport.Graph()[id];
    const End sender = Other(EndOn(transport.Tree(), link, receiver));
    if (MaxChannel(transport.LeavingRadiance(id, sender)) > 0.0)
    {
      transport.Expand(transport.Tree()[link.ends[sender]].patch, stepNumber);
    }
  }
}

void ImportanceGathering::Gather(Transport& transport, PatchId patch)
{
  const std::vector<InteractionId>& links = transport.Graph().Of(patch);
  const auto endHere = [&](InteractionId id)
  { return EndOn(transport.Tree(), transport.Graph()[id], patch); };
  std::vector<Color> before;
  before.reserve(links.size());
  for (const InteractionId id : links)
  {
    before.push_back(transport.LeavingRadiance(id, endHere(id)));
  }
  for (const InteractionId id : links)
  {
    transport.ShootRadiance(id, Other(endHere(id)));
  }
  this->Ungathered[patch] = Color(0.0);
  for (std::size_t i = 0; i < links.size(); ++i)
  {
    const Interaction& link = transport.Graph()[links[i]];
    const End here = endHere(links[i]);
    this->UngatheredAt(transport, link.ends[Other(here)]) +=
      link.throughput * UnshotPart(transport.LeavingRadiance(links[i], here), before[i]);
  }
}

void ImportanceGathering::ShootImportance(Transport& transport, PatchId patch)
{
  this->ShotImportance[patch] =
    transport.ReflectedImportance(transport.Tree().Patches()[patch].node);
  ShootPatch(transport, patch, Quantity::Importance);
}

Color& ImportanceGathering::UngatheredAt(const Transport& transport, NodeId node)
{
  return this->Ungathered[transport.Tree()[node].patch];
}

double ImportanceGathering::GatherRank(const Transport& transport, PatchId patch) const
{
  const NodeId node = transport.Tree().Patches()[patch].node;
  return Mean(this->Ungathered[patch] * transport.ReflectedImportance(node));
}

double ImportanceGathering::ShootRank(const Transport& transport, PatchId patch) const
{
  const NodeId node = transport.Tree().Patches()[patch].node;
  return PatchPower(
    transport, patch, UnshotPart(transport.ReflectedImportance(node), this->ShotImportance[patch]));
}

} // namespace vantage
