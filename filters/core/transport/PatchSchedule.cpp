#include "core/transport/PatchSchedule.h"

#include <numeric>

namespace vantage
{

PatchSchedule::PatchSchedule(Method method, const Transport& transport)
  : TheMethod(method)
  , Shots(transport.Tree().Patches().size())
{
}

std::optional<Step> PatchSchedule::Next(Transport& transport, std::uint32_t)
{
  Step step;
  if (this->TheMethod == Method::BasicShooting)
  {
    step.patch = this->NextInTurn(transport);
  }
  else
  {
    step.patch = None;
    if (this->TheMethod == Method::ImportanceShooting && this->LastShot == Quantity::Radiance)
    {
      step.quantity = Quantity::Importance;
      step.patch = this->HighestImportance(transport);
    }
    if (step.patch == None)
    {
      step.quantity = Quantity::Radiance;
      step.patch = this->HighestRadiance(transport);
    }
    if (step.patch == None && this->TheMethod == Method::ImportanceShooting)
    {
      step.quantity = Quantity::Importance;
      step.patch = this->HighestImportance(transport);
    }
  }
  return step.patch == None ? std::nullopt : std::optional<Step>(step);
}

void PatchSchedule::Perform(Transport& transport, const Step& step, std::uint32_t stepNumber)
{
  transport.Expand(step.patch, stepNumber);
  const NodeId node = transport.Tree().Patches()[step.patch].node;
  if (step.quantity == Quantity::Radiance)
  {
    this->Shots[step.patch].radiance = transport.Radiance(node);
  }
  else
  {
    this->Shots[step.patch].importance = transport.ReflectedImportance(node);
  }
  ShootPatch(transport, step.patch, step.quantity);
  this->LastShot = step.quantity;
}

Residual PatchSchedule::Rest(const Transport& transport)
{
  ViewResidual rest;
  const bool usesImportance = this->TheMethod == Method::ImportanceShooting;
  for (PatchId p = 0; p < PatchCount(transport); ++p)
  {
    if (PatchArea(transport, p) > 0.0)
    {
      rest.unshotPower += PatchPower(transport, p, this->UnshotRadiance(transport, p));
      if (usesImportance)
      {
        rest.knownUnshot += this->RadianceRank(transport, p);
        rest.unshotImportance += this->ImportanceRank(transport, p);
      }
    }
  }
  return { rest.unshotPower, usesImportance ? RelativeUnshotFlux(transport, rest)
                                            : RelativeUnshotPower(transport, rest.unshotPower) };
}

void PatchSchedule::RestartRadiance(const Transport&)
{
  for (Shot& shot : this->Shots)
  {
    shot = Shot();
  }
  this->Cursor = 0;
}

void PatchSchedule::RestartImportance()
{
  for (Shot& shot : this->Shots)
  {
    shot.importance = Color(0.0);
  }
  this->LastShot = Quantity::Radiance;
}

Color PatchSchedule::UnshotRadiance(const Transport& transport, PatchId patch) const
{
  const NodeId node = transport.Tree().Patches()[patch].node;
  return UnshotPart(transport.Radiance(node), this->Shots[patch].radiance);
}

Color PatchSchedule::UnshotImportance(const Transport& transport, PatchId patch) const
{
  const NodeId node = transport.Tree().Patches()[patch].node;
  return UnshotPart(transport.ReflectedImportance(node), this->Shots[patch].importance);
}

double PatchSchedule::RadianceRank(const Transport& transport, PatchId patch) const
{
  const Color unshot = this->UnshotRadiance(transport, patch);
  if (this->TheMethod != Method::ImportanceShooting)
  {
    return PatchPower(transport, patch, unshot);
  }
  const NodeId node = transport.Tree().Patches()[patch].node;
  return PatchArea(transport, patch) * Mean(unshot * transport.ReceivedImportance(node));
}

double PatchSchedule::ImportanceRank(const Transport& transport, PatchId patch) const
{
  return PatchPower(transport, patch, this->UnshotImportance(transport, patch));
}

PatchId PatchSchedule::NextInTurn(const Transport& transport)
{
  const PatchId count = PatchCount(transport);
  for (PatchId tried = 0; tried < count; ++tried)
  {
    const PatchId patch = this->Cursor;
    this->Cursor = (this->Cursor + 1) % count;
    if (PatchArea(transport, patch) > 0.0 && this->RadianceRank(transport, patch) > 0.0)
    {
      return patch;
    }
  }
  return None;
}

PatchId PatchSchedule::HighestRadiance(const Transport& transport) const
{
  return HighestRanked(
    transport, [&](PatchId patch) { return this->RadianceRank(transport, patch); });
}

PatchId PatchSchedule::HighestImportance(const Transport& transport) const
{
  return HighestRanked(
    transport, [&](PatchId patch) { return this->ImportanceRank(transport, patch); });
}

GatheringSchedule::GatheringSchedule(const Transport& transport)
{
  this->RestartRadiance(transport);
}

std::optional<Step> GatheringSchedule::Next(Transport& transport, std::uint32_t)
{
  if (transport.EmittedPower() == 0.0)
  {
    return std::nullopt;
  }
  Step step;
  step.kind = Step::Kind::Gather;
  while (PatchArea(transport, this->Cursor) == 0.0)
  {
    this->Cursor = (this->Cursor + 1) % PatchCount(transport);
  }
  step.patch = this->Cursor;
  return step;
}

void GatheringSchedule::Perform(Transport& transport, const Step& step, std::uint32_t stepNumber)
{
  transport.Expand(step.patch, stepNumber);
  if (step.kind == Step::Kind::Shoot)
  {
    ShootPatch(transport, step.patch, Quantity::Radiance);
    return;
  }
  for (const InteractionId id : transport.Graph().Of(step.patch))
  {
    const Interaction& link = transport.Graph()[id];
    const NodeId sender = link.ends[Other(EndOn(transport.Tree(), link, step.patch))];
    transport.Expand(transport.Tree()[sender].patch, stepNumber);
  }
  const NodeId node = transport.Tree().Patches()[step.patch].node;
  const Color before = transport.Radiance(node);
  for (const InteractionId id : transport.Graph().Of(step.patch))
  {
    transport.ShootRadiance(id, Other(EndOn(transport.Tree(), transport.Graph()[id], step.patch)));
  }
  this->LastChange[step.patch] =
    PatchPower(transport, step.patch, UnshotPart(transport.Radiance(node), before));
  this->Cursor = (step.patch + 1) % PatchCount(transport);
}

Residual GatheringSchedule::Rest(const Transport& transport)
{
  Residual rest;
  rest.unshotPower = std::accumulate(this->LastChange.begin(), this->LastChange.end(), 0.0);
  rest.relativeUnshot = RelativeUnshotPower(transport, rest.unshotPower);
  return rest;
}

void GatheringSchedule::RestartRadiance(const Transport& transport)
{
  this->LastChange.assign(PatchCount(transport), 0.0);
  for (PatchId p = 0; p < PatchCount(transport); ++p)
  {
    if (PatchArea(transport, p) > 0.0)
    {
      this->LastChange[p] = transport.EmittedPower();
    }
  }
  this->Cursor = 0;
}

} // namespace vantage
