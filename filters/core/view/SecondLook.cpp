#include "core/view/SecondLook.h"

#include "core/math/Sampling.h"
#include "core/view/HemisphereGather.h"

#include <tbb/parallel_for.h>

#include <algorithm>

namespace vantage
{

namespace
{

/// The solution counts as much as this number of rays: it is smooth, and they are noisy.
constexpr double RaysOfSolution = 4.0;
/// Looks that can tell of their own noise.
constexpr std::size_t LeastLooks = 64;
/// Bounds of the correction: what is further off is no matter of means.
constexpr double SmallestCorrection = 0.5;
constexpr double LargestCorrection = 2.0;

/// Radiance at a point that was met, W m^-2 sr^-1.
struct Look
{
  Color direct{ 0.0 };   ///< reflected of light that lamps gave to the surfaces around
  Color indirect{ 0.0 }; ///< reflected of their indirect light
  Color solution{ 0.0 }; ///< what the element has for both
  RadianceSolution::NodeIndex leaf = None;
  std::uint64_t shadowRays = 0;
};

/// s with sum (D + s R I - s I) = 0, less its noise.
double CorrectionOf(const std::vector<Look>& looks)
{
  double direct = 0.0;
  double rest = 0.0;
  for (const Look& look : looks)
  {
    direct += Mean(look.direct);
    rest += Mean(look.solution - look.indirect);
  }
  if (looks.size() < LeastLooks || !(direct > 0.0 && rest > 0.0))
  {
    return 1.0;
  }
  const double factor = direct / rest;
  double variance = 0.0;
  for (const Look& look : looks)
  {
    const double difference = Mean(look.direct) - factor * Mean(look.solution - look.indirect);
    variance += difference * difference;
  }
  variance /= rest * rest;
  const double square = (factor - 1.0) * (factor - 1.0);
  const double certain = square > 0.0 ? std::max(0.0, 1.0 - variance / square) : 0.0;
  return std::clamp(1.0 + certain * (factor - 1.0), SmallestCorrection, LargestCorrection);
}

/// Sums over the rays from one element.
struct Sum
{
  Color radiance{ 0.0 };
  double rays = 0.0;
};

} // namespace

SecondLook LookAgain(const OccluderScene& occluders, const RadianceSolution& solution,
  const std::vector<Hit>& hits, std::uint32_t raysOfHit, std::uint64_t seed, LitSurfaces& surfaces)
{
  std::vector<Look> looks(hits.size());
  tbb::parallel_for(std::size_t(0), hits.size(),
    [&](std::size_t k)
    {
      const Hit& hit = hits[k];
      const PatchId patch = hit.Patch();
      const HemisphereEstimate seen = GatherHemisphere(occluders, surfaces, patch, hit.point,
        NormalOf(occluders, patch), raysOfHit, Hash(seed, k));
      Look& look = looks[k];
      look.leaf = solution.LeafAt(patch, hit.point);
      const RadianceSolution::Element& element = solution.elements[look.leaf];
      const Color brdf = solution.albedo[patch] / Pi;
      look.direct = brdf * (seen.irradiance - seen.indirect + element.unnamedDirect);
      look.indirect = brdf * seen.indirect;
      look.solution = element.indirect;
      look.shadowRays = seen.shadowRays;
    });
  SecondLook result;
  result.correction = CorrectionOf(looks);
  surfaces.ScaleIndirect(result.correction);
  std::vector<Sum> sums(solution.elements.size());
  for (const Look& look : looks)
  {
    sums[look.leaf].radiance +=
      (look.direct + result.correction * look.indirect) * double(raysOfHit);
    sums[look.leaf].rays += raysOfHit;
    result.rays += raysOfHit;
    result.shadowRays += look.shadowRays;
  }
  for (RadianceSolution::NodeIndex leaf = 0; leaf < sums.size(); ++leaf)
  {
    const Sum& sum = sums[leaf];
    if (sum.rays > 0.0)
    {
      surfaces.SetIndirect(leaf,
        (sum.radiance + RaysOfSolution * surfaces.Indirect(leaf)) / (sum.rays + RaysOfSolution));
    }
  }
  return result;
}

} // namespace vantage
