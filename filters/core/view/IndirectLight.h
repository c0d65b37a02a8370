#pragma once

#include "core/transport/RadianceSolution.h"
#include "core/visibility/OccluderScene.h"

#include <cstdint>
#include <vector>

/// \file IndirectLight.h
/// Indirect light at very many points, gathered at a few.

namespace vantage
{

/// A point that asks for its indirect light.
struct IndirectSpot
{
  PatchId patch; ///< active
  Vec3 point;
  double weight; ///< what an error of 1 W m^-2 here adds to the error of all, >= 0
};

struct IndirectSettings
{
  double error = 0.01; ///< sum of weight times error, relative to `total`, that is aimed at
  double total = 0.0;  ///< what the error is relative to, without the indirect light itself
  std::uint64_t seed = 1;
};

struct IndirectReport
{
  std::uint64_t gatherPoints = 0;
  std::uint64_t gatherRays = 0;
  std::uint64_t shadowRays = 0; ///< from what these met to the lamps
  double error = 0.0;           ///< estimate of the sum of weight times error
  double sum = 0.0;             ///< of weight times irradiance, mean of channels
};

/// Irradiance at the spots from the light that surfaces reflect, W m^-2. Gathered by rays at some
/// of the spots and interpolated between them, plane by plane; points are added where they
/// contradict what the points around them predict. Parallel over points and planes.
std::vector<Color> IndirectLight(const OccluderScene& occluders, const RadianceSolution& solution,
  const std::vector<IndirectSpot>& spots, const IndirectSettings& settings, IndirectReport& report);

} // namespace vantage
