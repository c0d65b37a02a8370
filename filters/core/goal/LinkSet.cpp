#include "core/goal/LinkSet.h"

#include <algorithm>

namespace vantage
{

namespace
{

/// Over the mean part of a leaf in the view. Walks through twenty rooms need the same links with
/// 0.01 to 0.1, and as much time.
constexpr double SmallPart = 0.05;
/// Part of all links that has to rest.
constexpr double LeastResting = 0.4;
/// Links that solutions go over between two of all, over the number of all. With 6 walks take 0.93
/// of the time; what rests is late for longer.
constexpr std::size_t LinksBetween = 3;

/// Leaves with small parts, and the nodes all of whose leaves are among them.
std::vector<bool> NodesToRest(const OpenTree& tree, const std::vector<double>& partOf)
{
  double sum = 0.0;
  std::size_t leaves = 0;
  for (OpenId id = 0; id < tree.Size(); ++id)
  {
    sum += tree[id].IsLeaf() ? partOf[id] : 0.0;
    leaves += tree[id].IsLeaf() ? 1 : 0;
  }
  const double small = SmallPart * sum / static_cast<double>(leaves);
  std::vector<bool> rests(tree.Size(), false);
  for (OpenId id = tree.Size(); id-- > 0;)
  {
    const OpenNode& node = tree[id];
    const auto first = rests.begin() + node.firstChild;
    rests[id] = node.IsLeaf()
                  ? partOf[id] < small
                  : std::all_of(first, first + node.childCount, [](bool child) { return child; });
  }
  return rests;
}

} // namespace

std::vector<Link> LinkSet::All() const
{
  std::vector<Link> all = this->AwakeLinks;
  all.insert(all.end(), this->RestingLinks.begin(), this->RestingLinks.end());
  return all;
}

std::vector<Link> LinkSet::TakeOut(const std::vector<std::uint32_t>& places)
{
  std::vector<Link> taken;
  taken.reserve(places.size());
  const std::size_t first = places.empty() ? this->AwakeLinks.size() : places.front();
  std::size_t kept = first;
  for (std::size_t i = first; i < this->AwakeLinks.size(); ++i)
  {
    if (taken.size() < places.size() && places[taken.size()] == i)
    {
      taken.push_back(this->AwakeLinks[i]);
    }
    else
    {
      this->AwakeLinks[kept++] = this->AwakeLinks[i];
    }
  }
  this->AwakeLinks.resize(kept);
  return taken;
}

void LinkSet::Follow(const OpenTree& tree)
{
  for (OpenId id = static_cast<OpenId>(this->IsResting.size()); id < tree.Size(); ++id)
  {
    this->IsResting.push_back(id > 0 && this->IsResting[tree[id].parent]);
  }
}

void LinkSet::WakeAll()
{
  this->AwakeLinks.insert(
    this->AwakeLinks.end(), this->RestingLinks.begin(), this->RestingLinks.end());
  this->RestingLinks.clear();
  std::fill(this->IsResting.begin(), this->IsResting.end(), false);
}

bool LinkSet::WakeWhenDue()
{
  if (this->DoSomeRest() && this->AwakeLinks.size() <= this->LinksUntilAll)
  {
    this->LinksUntilAll -= this->AwakeLinks.size();
    return false;
  }
  this->WakeAll();
  return true;
}

bool LinkSet::LetRest(const OpenTree& tree, const std::vector<double>& partOf)
{
  std::vector<bool> rests = NodesToRest(tree, partOf);
  const auto isAwake = [&](const Link& link)
  { return !rests[link.ends[0]] || !rests[link.ends[1]]; };
  const auto awake =
    static_cast<double>(std::count_if(this->AwakeLinks.begin(), this->AwakeLinks.end(), isAwake));
  if (awake > (1.0 - LeastResting) * static_cast<double>(this->AwakeLinks.size()))
  {
    return false;
  }
  this->LinksUntilAll = LinksBetween * this->AwakeLinks.size();
  const auto middle =
    std::stable_partition(this->AwakeLinks.begin(), this->AwakeLinks.end(), isAwake);
  this->RestingLinks.assign(middle, this->AwakeLinks.end());
  this->AwakeLinks.erase(middle, this->AwakeLinks.end());
  this->IsResting = std::move(rests);
  return true;
}

std::size_t LinkSet::Bytes() const
{
  return (this->AwakeLinks.capacity() + this->RestingLinks.capacity()) * sizeof(Link) +
         this->IsResting.capacity() / 8;
}

} // namespace vantage
