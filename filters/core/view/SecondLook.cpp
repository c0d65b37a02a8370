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
/// Of what the looks have met.
constexpr int Readings = 3;

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
  this->Met.resize(this->Looks.size() * this->RaysOfHit);
  tbb::parallel_for(std::size_t(0), hits.size(),
    [&](std::size_t k) { this->Looks[first + k] = this->From(hits[k], first + k, surfaces); });
}

SecondLook::Look SecondLook::From(const Hit& hit, std::uint64_t index, const LitSurfaces& surfaces)
{
  const PatchId patch = hit.Patch();
  const Color albedo = this->Solution->albedo[patch];
  Look look;
  look.albedo = albedo;
  look.leaf = this->Solution->LeafAt(patch, hit.point);
  const RadianceSolution::Element& element = this->Solution->elements[look.leaf];
  look.direct = albedo / Pi * element.unnamedDirect;
  look.solution = element.indirect;
  const HemisphereRays rays(*this->Occluders, surfaces, patch, hit.point, LitBy::ShadowRays,
    this->RaysOfHit, Hash(this->Seed, index));
  for (std::uint32_t ray = 0; ray < this->RaysOfHit; ++ray)
  {
    const auto seen = rays.Cast(ray, look.shadowRays);
    if (!seen || seen->radiance.leaf == None)
    {
      continue;
    }
    const double weight = seen->weight / Pi;
    this->Met[index * this->RaysOfHit + ray] = { seen->radiance.leaf, weight };
    look.direct += weight * albedo * seen->radiance.direct;
    const bool isMet = this->IsMetOften[seen->radiance.leaf];
    (isMet ? look.ofMet : look.fixed) += weight * albedo * seen->radiance.indirect;
  }
  look.fixed += look.direct;
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

/// What the looks better they also see: so they are read once more with what they have found.
void SecondLook::Apply(LitSurfaces& surfaces) const
{
  const double correction = this->Correction();
  std::vector<Color> known(this->IsMetOften.size());
  for (RadianceSolution::NodeIndex leaf = 0; leaf < known.size(); ++leaf)
  {
    known[leaf] = (this->IsMetOften[leaf] ? correction : 1.0) * surfaces.Indirect(leaf);
    surfaces.SetIndirect(leaf, known[leaf]);
  }
  for (int reading = 0; reading < Readings; ++reading)
  {
    const std::vector<Sum> sums = this->SumUp(surfaces);
    for (RadianceSolution::NodeIndex leaf = 0; leaf < known.size(); ++leaf)
    {
      surfaces.SetIndirect(leaf,
        (sums[leaf].radiance + RaysOfSolution * known[leaf]) / (sums[leaf].rays + RaysOfSolution));
    }
  }
}

/// Of each element, over the rays from it; none where there was no look.
std::vector<SecondLook::Sum> SecondLook::SumUp(const LitSurfaces& surfaces) const
{
  std::vector<Sum> sums(this->IsMetOften.size());
  auto met = this->Met.begin();
  for (const Look& look : this->Looks)
  {
    Color arriving(0.0);
    for (const auto end = met + this->RaysOfHit; met != end; ++met)
    {
      arriving += met->leaf != None ? met->weight * surfaces.Indirect(met->leaf) : Color(0.0);
    }
    const Color radiance = look.direct + look.albedo * arriving;
    sums[look.leaf].radiance += static_cast<double>(this->RaysOfHit) * radiance;
    sums[look.leaf].rays += this->RaysOfHit;
  }
  return sums;
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
