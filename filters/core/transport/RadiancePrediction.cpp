#include "core/transport/RadiancePrediction.h"

#include "core/formfactor/FormFactor.h"

#include <algorithm>
#include <array>

namespace vantage
{

namespace
{

/// Where a patch is asked for its direct light, in PointAt() coordinates.
constexpr std::array<std::array<double, 2>, 4> Places{ { { 0.25, 0.25 }, { 0.75, 0.25 },
  { 0.25, 0.75 }, { 0.75, 0.75 } } };

/// Emitters that could add less than this part of the ambient light are passed over.
constexpr double NegligiblePart = 0.1;

/// The ambient estimate has no bound in white scenes.
constexpr double LargestAlbedo = 0.99;

} // namespace

RadiancePrediction::RadiancePrediction(
  const ElementTree& tree, const OccluderScene& occluders, const std::vector<PatchOptics>& optics)
  : Tree(&tree)
  , Occluders(&occluders)
  , Optics(&optics)
{
  double emitted = 0.0;
  double absorbing = 0.0;
  for (PatchId p = 0; p < optics.size(); ++p)
  {
    if (tree.Patches()[p].IsActive())
    {
      const double area = tree[tree.Patches()[p].node].area;
      const double radiance = Mean(optics[p].emission);
      if (radiance > 0.0)
      {
        this->Emitters.push_back({ p, radiance });
        this->Strongest = std::max(this->Strongest, Pi * area * radiance);
      }
      emitted += area * radiance;
      absorbing += area * (1.0 - std::min(LargestAlbedo, Mean(optics[p].albedo)));
    }
  }
  this->Ambient = absorbing > 0.0 ? emitted / absorbing : 0.0;
}

double RadiancePrediction::Of(PatchId patch) const
{
  const Polygon shape = this->Tree->Shape(this->Tree->Patches()[patch].node);
  double direct = 0.0;
  for (const auto& place : Places)
  {
    direct =
      std::max(direct, this->DirectIrradiance(patch, PointAt(shape, Vec2(place[0], place[1]))));
  }
  const PatchOptics& optics = (*this->Optics)[patch];
  return Mean(optics.emission) + Mean(optics.albedo) * (direct / Pi + this->Ambient);
}

double RadiancePrediction::DirectIrradiance(PatchId patch, const Vec3& point) const
{
  const Patch& self = this->Tree->Patches()[patch];
  double sum = 0.0;
  for (const Emitter& emitter : this->Emitters)
  {
    const Patch& lamp = this->Tree->Patches()[emitter.patch];
    const Node& node = (*this->Tree)[lamp.node];
    // A cheap bound first: with many lamps, most are far away.
    const double nearest = std::max(0.0, glm::length(node.centre - point) - node.radius);
    if (lamp.facet == self.facet ||
        emitter.radiance * node.area < NegligiblePart * Pi * this->Ambient * nearest * nearest)
    {
      continue;
    }
    const double factor = PointToPolygon(point, self.normal, this->Tree->Shape(lamp.node));
    if (factor > 0.0 &&
        !this->Occluders->IsOccluded({ point, self.facet }, { node.centre, lamp.facet }))
    {
      sum += emitter.radiance * factor;
    }
  }
  return sum;
}

} // namespace vantage
