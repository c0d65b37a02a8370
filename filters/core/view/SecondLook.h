#pragma once

#include "core/view/LitSurfaces.h"

#include <cstdint>
#include <vector>

/// \file SecondLook.h
/// One more reflection before the solution is looked up.

namespace vantage
{

/// Betters the indirect light of the elements that a gather meets, by rays: from each point that
/// was met, some look at the lit surfaces around. Elements take light as means over links, which is
/// too little where both are uneven. So,
///
/// - What an element has is replaced by what the rays from its points found; only what those
///   surfaces have got by further reflections comes from elements, a few times over, bettered
///   themselves. Where few hits tell of an element, the solution keeps its say. Elements that
///   nothing met stay.
/// - The indirect light of the solution should be what is reflected of that of lamps and of itself.
///   It be I on the elements that are met often, and D what is reflected there of all other light:
///   in the mean over all rays, s I = D + R s I says by which factor s it errs. So I is multiplied
///   by that, as far as it is more than noise. What is further away, as another room behind a slit,
///   may be right all the same.
///
/// Refers to occluders and solution, which must outlive it.
class SecondLook
{
public:
  SecondLook(const OccluderScene& occluders, const RadianceSolution& solution,
    std::uint32_t raysOfHit, std::uint64_t seed);

  /// Looks around from points, at surfaces that were not bettered yet. May be called again: which
  /// elements are met often, the first call says. Parallel over hits, the same for any number of
  /// threads.
  void From(const std::vector<Hit>& hits, const LitSurfaces& surfaces);

  /// s as the looks say it; 1 when too few were made to tell.
  double Factor() const;
  /// Standard error of that: large where most of the light comes from small spots, which few rays
  /// find. 0 when too few looks were made to tell.
  double Noise() const;
  /// The factor as far as it is not noise, in [1/2, 2].
  double Correction() const;
  void Apply(LitSurfaces& surfaces) const;

  std::uint64_t Rays() const { return this->Looks.size() * this->RaysOfHit; }
  std::uint64_t ShadowRays() const;

private:
  /// Radiance at a point that was met, W m^-2 sr^-1.
  struct Look
  {
    Color albedo{ 0.0 };
    Color direct{ 0.0 };   ///< reflected of the light of lamps
    Color fixed{ 0.0 };    ///< the same and of the other light of elements that are not met often
    Color ofMet{ 0.0 };    ///< reflected of the other light of those that are
    Color solution{ 0.0 }; ///< what the element has for both
    RadianceSolution::NodeIndex leaf = None;
    std::uint64_t shadowRays = 0;
  };

  /// What a ray of a look has met.
  struct Meeting
  {
    RadianceSolution::NodeIndex leaf = None; ///< None where that is nothing
    double weight = 0.0; ///< part of the radiance there that a white surface would reflect
  };

  /// Over the rays from one element.
  struct Sum
  {
    Color radiance{ 0.0 };
    double rays = 0.0;
  };

  /// As MetElements.h says.
  void FindMet(const std::vector<Hit>& hits);
  Look From(const Hit& hit, std::uint64_t index, const LitSurfaces& surfaces);
  std::vector<Sum> SumUp(const LitSurfaces& surfaces) const;

  const OccluderScene* Occluders;
  const RadianceSolution* Solution;
  std::uint32_t RaysOfHit;
  std::uint64_t Seed;
  std::vector<Look> Looks;
  std::vector<Meeting> Met;     ///< of all rays of each look
  std::vector<bool> IsMetOften; ///< of each element
};

} // namespace vantage
