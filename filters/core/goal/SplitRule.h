#pragma once

#include "core/goal/Link.h"
#include "core/goal/OpenTree.h"

#include <array>
#include <vector>

/// \file SplitRule.h
/// Which ends of a link are split when it is refined.

namespace vantage
{

/// Clusters may always be split, patches and elements while their parts are large enough. Of a
/// cluster and a surface the cluster is, of two clusters the larger one, of two surfaces the larger
/// one as well, but both if they are of one size.
class SplitRule
{
public:
  /// \param minimumLength of the longest edge of what is split off
  /// \param maximumLevel splits below a patch
  SplitRule(double minimumLength, int maximumLevel)
    : MinimumLength(minimumLength)
    , MaximumLevel(maximumLevel)
  {
  }

  /// Gets to know new nodes.
  void Follow(const OpenTree& tree);

  /// Whether an end of the link may be split.
  bool MayRefine(const Link& link) const
  {
    return this->MaySplit[link.ends[0]] || this->MaySplit[link.ends[1]];
  }
  /// \pre MayRefine
  std::array<bool, 2> EndsToSplit(const OpenTree& tree, const Link& link) const;

  std::size_t Bytes() const { return this->MaySplit.capacity() / 8; }

private:
  bool IsLargeEnough(const OpenTree& tree, OpenId id) const;

  double MinimumLength;
  int MaximumLevel;
  std::vector<bool> MaySplit; ///< of each node
};

} // namespace vantage
