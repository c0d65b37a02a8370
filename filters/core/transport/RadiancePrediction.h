#pragma once

#include "core/mesh/ElementTree.h"
#include "core/transport/PatchOptics.h"
#include "core/visibility/OccluderScene.h"

#include <vector>

/// \file RadiancePrediction.h
/// What a patch is likely to radiate in the end, before anything is solved.

namespace vantage
{

/// BF-refinement asks how much an interaction carries. Asking for the radiance of the moment would
/// make the interactions depend on the order of the steps, and refine again what has been shot
/// already. So they are refined once, when they are made, for a prediction: emission, plus the
/// reflected direct light at a few points of the patch (one shadow ray for each emitter that
/// matters there), plus the ambient radiance of the whole scene (Cohen et al. 1988, section 5).
class RadiancePrediction
{
public:
  /// Keeps references to tree, occluders and optics.
  RadiancePrediction(const ElementTree& tree, const OccluderScene& occluders,
    const std::vector<PatchOptics>& optics);

  /// Mean of channels, W m^-2 sr^-1. O(emitters); pure, so that many threads may ask.
  double Of(PatchId patch) const;

  /// Power of the strongest emitter, W, mean of channels; 0 in a dark scene.
  double StrongestPower() const { return this->Strongest; }

private:
  struct Emitter
  {
    PatchId patch;
    double radiance; ///< mean of channels
  };

  double DirectIrradiance(PatchId patch, const Vec3& point) const;

  const ElementTree* Tree;
  const OccluderScene* Occluders;
  const std::vector<PatchOptics>* Optics;
  std::vector<Emitter> Emitters;
  double Ambient = 0.0; ///< radiance
  double Strongest = 0.0;
};

} // namespace vantage
