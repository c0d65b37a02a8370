#pragma once

#include "core/view/NamedLamps.h"

#include <cstdint>
#include <vector>

/// \file DirectLight.h
/// Light straight from the lamps, at points.

namespace vantage
{

struct DirectCounters
{
  std::uint64_t lampEvaluations = 0; ///< a lamp that lights a point, whole or in part
  std::uint64_t cutEvaluations = 0;  ///< of these, with shadows cut out of the lamp
  std::uint64_t occluderQueries = 0; ///< for the facets between a group of points and a lamp
  std::uint64_t shadowRays = 0;

  void Add(const DirectCounters& other)
  {
    this->lampEvaluations += other.lampEvaluations;
    this->cutEvaluations += other.cutEvaluations;
    this->occluderQueries += other.occluderQueries;
    this->shadowRays += other.shadowRays;
  }
};

/// Irradiance from the lamps that the elements of a solution name, without noise. A lamp that was
/// cut into facets is one (NamedLamps.h). A group of points of one patch and a lamp have few facets
/// in between; without any, Lambert's formula holds, and the shadows of a few are cut out of the
/// lamp at each point. Groups are halved until one or the
/// other applies, or, if there is a tolerance, until a smooth fit to a few places does
/// (SmoothFit.h): penumbrae are smooth, and so is what a lamp of many facets gives. Where facets
/// leave so many parts of a lamp that rays are quicker (LampCutter.h), shadow rays decide; the
/// relative error is then about 0.2 %. Refers to occluders and solution, which must outlive it.
/// Safe to use from many threads.
class DirectLight
{
public:
  /// \param tolerance of what each lamp gives, relative to the most that points around get of it,
  /// >= 0. Tested at some places: most points err by much less, a few by more. 0: none
  DirectLight(
    const OccluderScene& occluders, const RadianceSolution& solution, double tolerance = 0.0)
    : Occluders(&occluders)
    , Solution(&solution)
    , Lamps(occluders, solution)
    , Tolerance(tolerance)
  {
  }

  /// Irradiance at points of one patch, W m^-2, the part of the unnamed lamps included: near points
  /// are best asked for together. (0,0,0) on an inactive side. Works on all threads of the arena;
  /// a point's result depends on the others by rounding and the tolerance only, and not on the
  /// threads.
  std::vector<Color> At(
    PatchId patch, const std::vector<Vec3>& points, DirectCounters& counters) const;
  /// The same without the unnamed lamps.
  std::vector<Color> OfNamed(
    PatchId patch, const std::vector<Vec3>& points, DirectCounters& counters) const;

private:
  std::vector<RadianceSolution::NodeIndex> LeavesAt(
    PatchId patch, const std::vector<Vec3>& points) const;
  std::vector<Color> OfNamed(PatchId patch, const std::vector<Vec3>& points,
    const std::vector<RadianceSolution::NodeIndex>& leaves, DirectCounters& counters) const;

  const OccluderScene* Occluders;
  const RadianceSolution* Solution;
  NamedLamps Lamps;
  double Tolerance;
};

} // namespace vantage
