#include "core/goal/LinkSet.h"

#include "core/goal/GoalScenes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>

namespace vantage
{
namespace
{

/// The walls of a room as leaves, their parts in the view, and links between any two, told apart by
/// their throughput.
struct Walls
{
  Walls()
    : stage(test::MakeRoom())
    , tree(stage.MakeOpenTree())
  {
    test::OpenTo(tree, 1);
    set.Follow(tree);
    leaves = test::LeavesOf(tree);
    parts.assign(tree.Size(), 0.0);
    for (const OpenId a : leaves)
    {
      parts[a] = 1.0;
      for (const OpenId b : leaves)
      {
        if (b > a)
        {
          Link link;
          link.ends = { a, b };
          link.throughput = static_cast<double>(set.Size() + 1);
          set.Add(link);
        }
      }
    }
  }

  /// All but `count` leaves get no part in the view.
  void LookAt(std::size_t count)
  {
    for (std::size_t i = count; i < leaves.size(); ++i)
    {
      parts[leaves[i]] = 0.0;
    }
  }

  bool AreAllThere() const
  {
    const std::vector<Link> all = set.All();
    std::vector<double> names;
    std::transform(all.begin(), all.end(), std::back_inserter(names),
      [](const Link& link) { return link.throughput; });
    std::sort(names.begin(), names.end());
    std::vector<double> expected(leaves.size() * (leaves.size() - 1) / 2);
    std::iota(expected.begin(), expected.end(), 1.0);
    return names == expected && set.Size() == expected.size();
  }

  test::Stage stage;
  OpenTree tree;
  LinkSet set;
  std::vector<OpenId> leaves;
  std::vector<double> parts;
};

TEST(LinkSet, LeavesRestThatHaveLessThanATwentiethOfTheMeanPart)
{
  Walls w;
  ASSERT_EQ(w.leaves.size(), 24u);
  // The mean is 0.1737: 0.0087 is a twentieth of it.
  for (std::size_t i = 4; i < w.leaves.size(); ++i)
  {
    w.parts[w.leaves[i]] = i < 8 ? 0.010 : 0.008;
  }
  ASSERT_TRUE(w.set.LetRest(w.tree, w.parts));
  EXPECT_TRUE(w.AreAllThere());
  const std::vector<bool>& rests = w.set.RestingNodes();
  EXPECT_EQ(
    std::count_if(w.leaves.begin(), w.leaves.end(), [&](OpenId id) { return rests[id]; }), 16);
  for (OpenId id = 0; id < w.tree.Size(); ++id)
  {
    const OpenNode& node = w.tree[id];
    bool doAllChildren = true;
    for (OpenId c = node.firstChild; c < node.firstChild + node.childCount; ++c)
    {
      doAllChildren = doAllChildren && rests[c];
    }
    EXPECT_TRUE(node.IsLeaf() || rests[id] == doAllChildren) << "node " << id;
  }
  for (const Link& link : w.set.Awake())
  {
    EXPECT_FALSE(rests[link.ends[0]] && rests[link.ends[1]]);
  }
}

TEST(LinkSet, NothingRestsWhereAllMatterOrNothingIsSeen)
{
  Walls w;
  EXPECT_FALSE(w.set.LetRest(w.tree, w.parts));
  // A quarter of the walls would rest, so 15 links of 276.
  w.LookAt(18);
  EXPECT_FALSE(w.set.LetRest(w.tree, w.parts));
  w.LookAt(0);
  EXPECT_FALSE(w.set.LetRest(w.tree, w.parts));
  EXPECT_FALSE(w.set.DoSomeRest());
  EXPECT_EQ(std::count(w.set.RestingNodes().begin(), w.set.RestingNodes().end(), true), 0);
}

TEST(LinkSet, AllAreAwakeAgainAfterThreeTimesTheirNumber)
{
  Walls w;
  EXPECT_TRUE(w.set.WakeWhenDue());
  w.LookAt(4);
  ASSERT_TRUE(w.set.LetRest(w.tree, w.parts));
  const std::size_t awake = w.set.Awake().size();
  EXPECT_EQ(awake, 4u * 20u + 6u);
  std::size_t gone = 0;
  while (!w.set.WakeWhenDue())
  {
    gone += awake;
    ASSERT_LE(gone, 3 * w.set.Size());
  }
  EXPECT_GT(gone + awake, 3 * w.set.Size());
  EXPECT_FALSE(w.set.DoSomeRest());
  EXPECT_EQ(w.set.Awake().size(), w.set.Size());
  EXPECT_TRUE(w.AreAllThere());
  EXPECT_EQ(std::count(w.set.RestingNodes().begin(), w.set.RestingNodes().end(), true), 0);
}

TEST(LinkSet, PartsOfWhatRestsRestAsWell)
{
  Walls w;
  w.LookAt(4);
  ASSERT_TRUE(w.set.LetRest(w.tree, w.parts));
  w.tree.Open(w.leaves.front());
  w.tree.Open(w.leaves.back());
  w.set.Follow(w.tree);
  for (OpenId c = 0; c < 4; ++c)
  {
    EXPECT_FALSE(w.set.RestingNodes()[w.tree[w.leaves.front()].firstChild + c]);
    EXPECT_TRUE(w.set.RestingNodes()[w.tree[w.leaves.back()].firstChild + c]);
  }
}

TEST(LinkSet, TakesOutWhatIsNamedAndKeepsTheOrderOfTheRest)
{
  Walls w;
  const std::vector<Link> taken = w.set.TakeOut({ 0, 5, 275 });
  ASSERT_EQ(taken.size(), 3u);
  EXPECT_EQ(taken[0].throughput, 1.0);
  EXPECT_EQ(taken[1].throughput, 6.0);
  EXPECT_EQ(taken[2].throughput, 276.0);
  ASSERT_EQ(w.set.Awake().size(), 273u);
  EXPECT_TRUE(std::is_sorted(w.set.Awake().begin(), w.set.Awake().end(),
    [](const Link& a, const Link& b) { return a.throughput < b.throughput; }));
}

} // namespace
} // namespace vantage
