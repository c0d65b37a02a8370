#pragma once

#include "core/math/Image.h"
#include "core/scene/Camera.h"
#include "core/transport/RadianceSolution.h"
#include "core/visibility/OccluderScene.h"

#include <cstdint>
#include <functional>
#include <vector>

/// \file ViewGather.h
/// From a solved scene to a picture: the light of each pixel, gathered once more.

namespace vantage
{

struct GatherSettings
{
  int width = 512;           ///< pixels, 1 .. 32768
  int height = 512;          ///< pixels, 1 .. 32768
  double error = 0.01;       ///< relative L1 that the gather may add, LeastGatherError .. 1
  bool pixelCentres = false; ///< what the centre of each pixel sees, else the mean over the pixel
  std::uint64_t seed = 1;    ///< of the directions of the gather

  /// \throw InputError naming the first value out of range.
  void Validate() const;
};

/// What a gather has cost and how good it is.
struct GatherReport
{
  std::uint64_t primaryRays = 0;     ///< traced from the eye
  std::uint64_t primaryLooks = 0;    ///< rays from the eye decided among a few facets, not traced
  std::uint64_t viewPoints = 0;      ///< of which the light was computed
  std::uint64_t lampEvaluations = 0; ///< a lamp that lights a point, seen or met by rays
  std::uint64_t cutEvaluations = 0;  ///< of these, with shadows cut out of the lamp
  std::uint64_t occluderQueries = 0; ///< for the facets between a lamp and the points of a patch
  std::uint64_t shadowRays = 0;
  std::uint64_t gatherPoints = 0;
  std::uint64_t gatherRays = 0;
  std::uint64_t hitShadowRays = 0; ///< from what these met to the lamps
  double errorEstimate = 0.0; ///< relative L1 error that the gather added, noise and interpolation
  double primarySeconds = 0.0;
  double directSeconds = 0.0;
  double indirectSeconds = 0.0;
  double seconds = 0.0; ///< all of it
};

struct GatheredView
{
  Image radiance;             ///< W m^-2 sr^-1
  Image irradiance;           ///< of what a pixel sees, W m^-2; mean over the pixel, as radiance
  std::vector<float> depth;   ///< distance of a pixel's centre from the eye; +inf: nothing
  std::vector<PatchId> patch; ///< what is seen there; None: nothing, or an inactive side
  GatherReport report;
};

/// Called between the phases of a gather with the part of it that is done, as far as can be told;
/// returns false to give it up.
using GatherObserver = std::function<bool(double)>;

/// The radiance of each pixel: emission, plus albedo / pi times what arrives. Light from the named
/// lamps is computed at the points that the pixels see, without noise (DirectLight.h); what other
/// surfaces reflect is gathered at a few points and interpolated (IndirectLight.h). Inactive sides
/// are black. What was given up has no pixels. Works on all threads of the arena, with the same
/// result to the bit for any number. \throw InputError for bad settings or a bad camera
GatheredView GatherView(const OccluderScene& occluders, const RadianceSolution& solution,
  const Camera& camera, const GatherSettings& settings, const GatherObserver& observer = {});

} // namespace vantage
