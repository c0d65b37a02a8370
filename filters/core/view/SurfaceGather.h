#pragma once

#include "core/view/DirectLight.h"
#include "core/view/IndirectLight.h"

#include <cstdint>
#include <vector>

/// \file SurfaceGather.h
/// The light at any points of surfaces, from a solved scene.

namespace vantage
{

/// The least error that a gather may be asked for.
inline constexpr double LeastGatherError = 5e-4;

/// A point of a patch whose light is wanted.
struct GatherPoint
{
  PatchId patch;
  Vec3 point;          ///< on the patch, or within rounding of it
  double weight = 1.0; ///< of its error against that of others, >= 0: the area that it stands for
};

/// What the light of points has cost.
struct GatherCounts
{
  DirectCounters direct;
  std::uint64_t gatherPoints = 0;
  std::uint64_t gatherRays = 0;
  std::uint64_t hitShadowRays = 0; ///< from what these met to the lamps
  double directSeconds = 0.0;
  double indirectSeconds = 0.0;

  void Add(const GatherCounts& other)
  {
    this->direct.Add(other.direct);
    this->gatherPoints += other.gatherPoints;
    this->gatherRays += other.gatherRays;
    this->hitShadowRays += other.hitShadowRays;
    this->directSeconds += other.directSeconds;
    this->indirectSeconds += other.indirectSeconds;
  }
};

/// Radiance at points of surfaces: what the named lamps give, without noise, plus indirect light
/// that is gathered at some of the points and interpolated to the others, plus emission. So the
/// more points are asked for at once, and the closer together they lie, the less each of them
/// costs. Points on a border of their patch are moved inwards by a millionth of its size: there,
/// the wall that the patch meets stands in the way as it should. Refers to occluders and solution,
/// which must outlive it. Works on all threads of the arena; the results do not depend on their
/// number.
class SurfaceGather
{
public:
  struct Settings
  {
    /// Wanted: sum of weight |error| over sum of weight radiance, LeastGatherError .. 1.
    double error = 0.01;
    std::uint64_t seed = 1;
  };

  struct Result
  {
    std::vector<Color> radiance;   ///< of each point, W m^-2 sr^-1; (0,0,0) on an inactive side
    std::vector<Color> irradiance; ///< what it comes from, W m^-2, of the same error but on
                                   ///< surfaces that reflect nothing
    double error = 0.0;            ///< estimate of what Settings::error asks for
    GatherCounts counts;
  };

  SurfaceGather(const OccluderScene& occluders, const RadianceSolution& solution)
    : Occluders(&occluders)
    , Solution(&solution)
  {
  }

  /// Irradiance from lamps at each point, W m^-2.
  /// \param error of the gather that it is for, Settings::error: half of it, and 1 % at most, is
  /// the tolerance of what each lamp gives (DirectLight.h). 0: exact
  std::vector<Color> Direct(
    const std::vector<GatherPoint>& points, double error, GatherCounts& counts) const;

  Result Radiance(const std::vector<GatherPoint>& points, const Settings& settings) const;

  /// The same when the direct irradiance is known (or better known than at the points alone).
  Result Radiance(const std::vector<GatherPoint>& points, const std::vector<Color>& direct,
    const Settings& settings) const;

private:
  const OccluderScene* Occluders;
  const RadianceSolution* Solution;
};

} // namespace vantage
