#pragma once

#include "core/transport/Method.h"
#include "core/transport/Transport.h"

#include <memory>
#include <optional>

/// \file Schedule.h
/// The order of the moves: what a method is.

namespace vantage
{

enum class Quantity
{
  Radiance,
  Importance
};

/// One move of a method.
struct Step
{
  enum class Kind
  {
    Shoot,
    Gather
  };
  Kind kind = Kind::Shoot;
  Quantity quantity = Quantity::Radiance;
  PatchId patch = None;             ///< that shoots or gathers
  InteractionId interaction = None; ///< the only one to shoot over; None: all of the patch
};

/// How far a method still has to go.
struct Residual
{
  double unshotPower = 0.0;    ///< W, mean of channels, of the radiance that is not shot yet
  double relativeUnshot = 0.0; ///< 0 at convergence; see Solver::Run()
};

/// Chooses steps and performs them.
class Schedule
{
public:
  virtual ~Schedule() = default;

  /// The next step, or nothing when nothing is left to shoot. May make interactions in order to
  /// choose among them; `stepNumber` is noted in these.
  virtual std::optional<Step> Next(Transport& transport, std::uint32_t stepNumber) = 0;

  /// Performs a step, one that Next() has returned or, of methods without importance, a shot of
  /// radiance from any whole patch.
  virtual void Perform(Transport& transport, const Step& step, std::uint32_t stepNumber) = 0;

  /// As of now; before the first step as well.
  virtual Residual Rest(const Transport& transport) = 0;

  /// Emission or materials have changed: nothing is shot.
  virtual void RestartRadiance(const Transport& transport) = 0;

  /// The view has changed: no importance is shot.
  virtual void RestartImportance() = 0;
};

std::unique_ptr<Schedule> MakeSchedule(
  Method method, Granularity granularity, const Transport& transport);

/// \name Of patches
///@{
PatchId PatchCount(const Transport& transport);
/// 0 for one that takes no part.
double PatchArea(const Transport& transport, PatchId patch);
/// W, mean of channels, of a mean radiance (sr of a reflected importance).
double PatchPower(const Transport& transport, PatchId patch, const Color& radiance);

/// The patch with the largest rank(patch) above zero, the first of equals; None without one.
template <typename Rank>
PatchId HighestRanked(const Transport& transport, const Rank& rank)
{
  PatchId best = None;
  double bestRank = 0.0;
  for (PatchId p = 0; p < PatchCount(transport); ++p)
  {
    const double found = PatchArea(transport, p) > 0.0 ? rank(p) : 0.0;
    if (found > bestRank)
    {
      bestRank = found;
      best = p;
    }
  }
  return best;
}
///@}

/// Shoots a quantity over all interactions of a patch. They must be there and fine enough.
void ShootPatch(Transport& transport, PatchId patch, Quantity quantity);

/// Unshot power relative to what the emitters emit.
double RelativeUnshotPower(const Transport& transport, double unshotPower);

/// What a view still misses, summed over all patches.
struct ViewResidual
{
  double unshotPower = 0.0;      ///< of radiance, sum of pi A dL, W
  double knownUnshot = 0.0;      ///< sum of A dL (P - V): unshot, but known to matter
  double unshotImportance = 0.0; ///< sum of pi A dY, sr
};

/// Estimate of the part of the view flux that is not in the radiance yet: the unshot radiance that
/// the known importance finds, and what the importance that is not shot yet would find if it met
/// the mean unshot radiance of the scene, at every reflection.
double RelativeUnshotFlux(const Transport& transport, const ViewResidual& rest);

} // namespace vantage
