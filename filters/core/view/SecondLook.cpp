#include "core/view/SecondLook.h"

#include "core/math/Sampling.h"
#include "core/view/HemisphereGather.h"

#include <tbb/parallel_for.h>

namespace vantage
{

namespace
{

/// The solution counts as much as this number of rays: it is smooth, and they are noisy.
constexpr double RaysOfSolution = 4.0;

/// Sums over the rays from one element.
struct Sum
{
  Color radiance{ 0.0 };
  double rays = 0.0;
};

} // namespace

SecondLookCounts LookAgain(const OccluderScene& occluders, const RadianceSolution& solution,
  const std::vector<Hit>& hits, std::uint32_t raysOfHit, std::uint64_t seed, LitSurfaces& surfaces)
{
  std::vector<HemisphereEstimate> looks(hits.size());
  tbb::parallel_for(std::size_t(0), hits.size(),
    [&](std::size_t k)
    {
      const Hit& hit = hits[k];
      looks[k] = GatherHemisphere(occluders, surfaces, hit.Patch(), hit.point,
        NormalOf(occluders, hit.Patch()), raysOfHit, Hash(seed, k));
    });
  SecondLookCounts counts;
  std::vector<Sum> sums(solution.elements.size());
  for (std::size_t k = 0; k < hits.size(); ++k)
  {
    const PatchId patch = hits[k].Patch();
    const RadianceSolution::NodeIndex leaf = solution.LeafAt(patch, hits[k].point);
    const Color irradiance = looks[k].irradiance + solution.elements[leaf].unnamedDirect;
    sums[leaf].radiance += solution.albedo[patch] / Pi * irradiance * double(raysOfHit);
    sums[leaf].rays += raysOfHit;
    counts.rays += raysOfHit;
    counts.shadowRays += looks[k].shadowRays;
  }
  for (RadianceSolution::NodeIndex leaf = 0; leaf < sums.size(); ++leaf)
  {
    const Sum& sum = sums[leaf];
    if (sum.rays > 0.0)
    {
      surfaces.SetIndirect(
        leaf, (sum.radiance + RaysOfSolution * solution.elements[leaf].indirect) /
                (sum.rays + RaysOfSolution));
    }
  }
  return counts;
}

} // namespace vantage
