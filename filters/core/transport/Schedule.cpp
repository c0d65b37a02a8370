#include "core/transport/Schedule.h"

#include "core/transport/ImportanceGathering.h"
#include "core/transport/InteractionSchedule.h"
#include "core/transport/PatchSchedule.h"

#include <algorithm>

namespace vantage
{

std::unique_ptr<Schedule> MakeSchedule(
  Method method, Granularity granularity, const Transport& transport)
{
  if (granularity == Granularity::Interaction)
  {
    return std::make_unique<InteractionSchedule>(method, transport);
  }
  if (method == Method::GaussSeidel)
  {
    return std::make_unique<GatheringSchedule>(transport);
  }
  if (method == Method::ImportanceGathering)
  {
    return std::make_unique<ImportanceGathering>(transport);
  }
  return std::make_unique<PatchSchedule>(method, transport);
}

PatchId PatchCount(const Transport& transport)
{
  return static_cast<PatchId>(transport.Tree().Patches().size());
}

double PatchArea(const Transport& transport, PatchId patch)
{
  const Patch& p = transport.Tree().Patches()[patch];
  return p.IsActive() ? transport.Tree()[p.node].area : 0.0;
}

double PatchPower(const Transport& transport, PatchId patch, const Color& radiance)
{
  return Pi * PatchArea(transport, patch) * Mean(radiance);
}

void ShootPatch(Transport& transport, PatchId patch, Quantity quantity)
{
  for (const InteractionId id : transport.Graph().Of(patch))
  {
    const End end = EndOn(transport.Tree(), transport.Graph()[id], patch);
    if (quantity == Quantity::Radiance)
    {
      transport.ShootRadiance(id, end);
    }
    else
    {
      transport.ShootImportance(id, end);
    }
  }
}

double RelativeUnshotPower(const Transport& transport, double unshotPower)
{
  return unshotPower > 0.0 ? unshotPower / transport.EmittedPower() : 0.0;
}

double RelativeUnshotFlux(const Transport& transport, const ViewResidual& rest)
{
  // Nearly white scenes would make the estimate useless; they are seen to converge by the shots.
  constexpr double LargestAlbedo = 0.999;
  const double albedo = std::min(transport.MeanAlbedo(), LargestAlbedo);
  const double meanUnshot = rest.unshotPower / (Pi * transport.TotalArea());
  const double missing = rest.knownUnshot + meanUnshot * rest.unshotImportance / (1.0 - albedo);
  const double flux = Mean(transport.ViewFluxEstimate());
  if (missing == 0.0)
  {
    return 0.0;
  }
  return flux > 0.0 ? missing / flux : 1.0;
}

} // namespace vantage
