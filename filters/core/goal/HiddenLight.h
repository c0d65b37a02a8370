#pragma once

#include "core/goal/Link.h"

#include <array>
#include <cstdint>

/// \file HiddenLight.h
/// How much passes between clusters though no ray has found a way.

namespace vantage
{

/// After n rays that were all stopped, a fraction of 1 / (n + 2) may still be open (Laplace's rule
/// of succession); that is all that one link says. But links are many, and each that is refined
/// tells what it had kept from its rays. In a place of many rooms that is next to nothing after a
/// hundred rays, where the rule expects a hundredth; then it is no use to refine ten thousand such
/// links only to be sure. So what is expected is what the links with about as many rays that were
/// refined carried, over what they could have carried, the rule counting as some of them.
class HiddenLight
{
public:
  /// That a link which is known to be hidden so far, and no more. Others are not its business.
  static bool Concerns(const OpenTree& tree, const Link& link);

  /// Such a link was refined, and its parts carry this throughput together, m^2 sr.
  void Learn(const Link& link, double throughput);

  /// Of the uncertainty of such a link, what is left in the light of those that were refined, in
  /// (0, 1]. Never larger for more rays. O(1).
  double Doubt(const Link& link) const;

private:
  /// Links with 2^b - 1 to 2^(b+1) - 2 rays.
  struct Bin
  {
    std::uint32_t links = 0; ///< that were refined
    double most = 0.0;       ///< throughput that these could have had, m^2 sr
    double carried = 0.0;    ///< and had
    double least = 1.0;      ///< that is expected of any bin below this one

    double Expected(double rule) const;
  };

  std::array<Bin, 16> Bins{};
};

} // namespace vantage
