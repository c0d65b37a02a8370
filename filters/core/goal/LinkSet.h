#pragma once

#include "core/goal/Link.h"

#include <cstdint>
#include <vector>

/// \file LinkSet.h
/// The links that were made, and which of them rest.

namespace vantage
{

/// Who walks through a building leaves behind the links of every room that was looked at. They are
/// as fine as that view needed and bring next to nothing into this one, yet each sweep would go
/// over all of them. So leaves with next to no part in the view *rest*: they keep what has been
/// found for them, and other rows read it. With them rest the nodes all of whose leaves do, and the
/// links between two of those. Every so often all are awake for a solution, so that nothing stays
/// wrong for long, and those that have come to matter take part from then on.
class LinkSet
{
public:
  /// In the order in which they were added, but for those that have rested.
  const std::vector<Link>& Awake() const { return this->AwakeLinks; }
  /// A copy of all, those that rest at the end.
  std::vector<Link> All() const;
  std::size_t Size() const { return this->AwakeLinks.size() + this->RestingLinks.size(); }
  bool DoSomeRest() const { return !this->RestingLinks.empty(); }
  /// Of each node that the set knows, whether it rests.
  const std::vector<bool>& RestingNodes() const { return this->IsResting; }

  void Add(const Link& link) { this->AwakeLinks.push_back(link); }
  /// Removes awake links, given by their places in ascending order, and returns them. O(awake links
  /// from the first of them on).
  std::vector<Link> TakeOut(const std::vector<std::uint32_t>& places);
  /// New nodes rest where their parent does.
  void Follow(const OpenTree& tree);

  void WakeAll();
  /// Called before each solution, wakes all when those since the last of all have gone over a few
  /// times as many links as there are: so that costs a part of them, however few are awake. Returns
  /// whether all are awake.
  bool WakeWhenDue();
  /// Lets leaves rest that have less than a twentieth of the mean part in the view; `partOf` has
  /// that of each leaf, >= 0, in any unit. Does nothing, and returns false, when few links would
  /// rest: they cost less than what is late. O(links + nodes). \pre all are awake
  bool LetRest(const OpenTree& tree, const std::vector<double>& partOf);

  std::size_t Bytes() const;

private:
  std::vector<Link> AwakeLinks;
  std::vector<Link> RestingLinks;
  std::vector<bool> IsResting;
  std::size_t LinksUntilAll = 0; ///< that solutions may go over before all are awake again
};

} // namespace vantage
