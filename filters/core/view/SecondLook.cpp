#include "core/view/SecondLook.h"

#include "core/math/Sampling.h"
#include "core/view/HemisphereGather.h"
#include "core/view/MetElements.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>

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

/// Sums over the rays from one element.
struct Sum
{
  Color radiance{ 0.0 };
  double rays = 0.0;
};

} // namespace

SecondLook::SecondLook(const OccluderScene& occluders, const RadianceSolution& solution,
  std::uint32_t raysOfHit, std::uint64_t seed)
  : Occluders(&occluders)
  , Solution(&solution)
  , RaysOfHit(raysOfHit)
  , Seed(seed)
{
}

void SecondLook::FindMet(const std::vector<Hit>& hits)
{
  std::vector<std::uint32_t> times(this->Solution->elements.size(), 0);
  for (const Hit& hit : hits)
  {
    ++times[this->Solution->LeafAt(hit.Patch(), hit.point)];
  }
  this->IsMetOften = FindMetOften(*this->Solution, times);
}

void SecondLook::From(const std::vector<Hit>& hits, const LitSurfaces& surfaces)
{
  if (this->Looks.empty())
  {
    this->FindMet(hits);
  }
  const std::size_t first = this->Looks.size();
  this->Looks.resize(first + hits.size());
  tbb::parallel_for(std::size_t(0), hits.size(),
    [&](std::size_t k) { this->Looks[first + k] = this->From(hits[k], first + k, surfaces); });
}

SecondLook::Look SecondLook::From(
  const Hit& hit, std::uint64_t index, const LitSurfaces& surfaces) const
{
  const PatchId patch = hit.Patch();
  const Color ofRay = this->Solution->albedo[patch] / static_cast<double>(this->RaysOfHit);
  Look look;
  look.leaf = this->Solution->LeafAt(patch, hit.point);
  const RadianceSolution::Element& element = this->Solution->elements[look.leaf];
  look.fixed = this->Solution->albedo[patch] / Pi * element.unnamedDirect;
  look.solution = element.indirect;
  look.shadowRays = ForEachSeen(*this->Occluders, surfaces, patch, hit.point,
    NormalOf(*this->Occluders, patch), this->RaysOfHit, Hash(this->Seed, index),
    [&](std::uint32_t, const LitRadiance& radiance)
    {
      const bool isMet = radiance.leaf != None && this->IsMetOften[radiance.leaf];
      look.fixed += ofRay * radiance.direct;
      (isMet ? look.ofMet : look.fixed) += ofRay * radiance.indirect;
    });
  return look;
}

/// From sum (D + s R I - s I) = 0 over the points on elements that are met often.
double SecondLook::Factor() const
{
  double fixed = 0.0;
  double own = 0.0;
  for (const Look& look : this->Looks)
  {
    if (this->IsMetOften[look.leaf])
    {
      fixed += Mean(look.fixed);
      own += Mean(look.solution - look.ofMet);
    }
  }
  const bool tells = this->Looks.size() >= LeastLooks && fixed > 0.0 && own > 0.0;
  return tells ? fixed / own : 1.0;
}

double SecondLook::Noise() const
{
  if (this->Looks.size() < LeastLooks)
  {
    return 0.0;
  }
  const double factor = this->Factor();
  double variance = 0.0;
  double sum = 0.0;
  for (const Look& look : this->Looks)
  {
    if (this->IsMetOften[look.leaf])
    {
      const double own = Mean(look.solution - look.ofMet);
      const double difference = Mean(look.fixed) - factor * own;
      variance += difference * difference;
      sum += own;
    }
  }
  return sum > 0.0 ? std::sqrt(variance) / sum : 0.0;
}

double SecondLook::Correction() const
{
  const double factor = this->Factor();
  const double off = std::abs(factor - 1.0);
  const double noise = this->Noise();
  const double certain = off > noise ? 1.0 - (noise / off) * (noise / off) : 0.0;
  return std::clamp(1.0 + certain * (factor - 1.0), SmallestCorrection, LargestCorrection);
}

void SecondLook::Apply(LitSurfaces& surfaces) const
{
  const double correction = this->Correction();
  std::vector<Sum> sums(this->IsMetOften.size()); // none where there was no look
  for (const Look& look : this->Looks)
  {
    Sum& sum = sums[look.leaf];
    sum.radiance += (look.fixed + correction * look.ofMet) * double(this->RaysOfHit);
    sum.rays += this->RaysOfHit;
  }
  for (RadianceSolution::NodeIndex leaf = 0; leaf < sums.size(); ++leaf)
  {
    const Sum& sum = sums[leaf];
    const Color known = (this->IsMetOften[leaf] ? correction : 1.0) * surfaces.Indirect(leaf);
    surfaces.SetIndirect(
      leaf, (sum.radiance + RaysOfSolution * known) / (sum.rays + RaysOfSolution));
  }
}

std::uint64_t SecondLook::ShadowRays() const
{
  std::uint64_t sum = 0;
  for (const Look& look : this->Looks)
  {
    sum += look.shadowRays;
  }
  return sum;
}

} // namespace vantage
