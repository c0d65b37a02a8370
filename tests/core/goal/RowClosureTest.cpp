#include "core/goal/RowClosure.h"

#include "core/goal/GoalOrientedTransport.h"
#include "core/goal/GoalScenes.h"
#include "core/goal/SolvedLinks.h"
#include "properties/RandomScene.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>
#include <utility>

namespace vantage
{
namespace
{

constexpr double Smallest = 0.02;
constexpr double Largest = 64.0;

/// sum_k d_i F_ik d_k of every leaf.
std::vector<double> ClosedRows(
  const OpenTree& tree, const std::vector<Link>& links, const Closure& closure)
{
  std::vector<double> rows;
  for (const std::vector<double>& row : test::LeafFactors(tree, links, closure))
  {
    rows.push_back(std::accumulate(row.begin(), row.end(), 0.0));
  }
  return rows;
}

bool IsWithinBounds(double factor)
{
  return factor > Smallest && factor < Largest;
}

struct Rounds
{
  Rounds(const Scene& scene, int rounds, double share = 0.5)
    : stage(scene)
    , transport(stage.MakeTree(), stage.occluders, stage.optics, stage.facets.meanArea,
        GoalOrientedSettings())
  {
    transport.SetView(stage.View());
    transport.Solve();
    for (int round = 0; round < rounds; ++round)
    {
      transport.Refine(share);
      transport.Solve();
    }
  }

  /// Refines all links until no leaf is a cluster.
  void RefineClusters()
  {
    const auto hasCluster = [this]()
    {
      const std::vector<OpenId> leaves = test::LeavesOf(transport.Tree());
      return std::any_of(leaves.begin(), leaves.end(),
        [this](OpenId id) { return transport.Tree()[id].IsCluster(); });
    };
    while (hasCluster() && transport.Refine(1.0) > 0)
    {
      transport.Solve();
    }
  }

  Closure Factors(int calls = 10) const
  {
    const LinkMatrix matrix(transport.Tree(), transport.Links());
    Closure closure = test::NoClosure(transport.Tree());
    for (int call = 0; call < calls; ++call)
    {
      CloseRows(transport.Tree(), matrix, closure);
    }
    return closure;
  }

  test::Stage stage;
  GoalOrientedTransport transport;
};

void ExpectClosed(const Rounds& rounds)
{
  const OpenTree& tree = rounds.transport.Tree();
  const Closure closure = rounds.Factors();
  const std::vector<double> rows = ClosedRows(tree, rounds.transport.Links(), closure);
  int held = 0;
  int count = 0;
  for (const OpenId leaf : test::LeavesOf(tree))
  {
    if (tree[leaf].IsCluster())
    {
      EXPECT_LE(closure[WithCluster][leaf], 1.0);
      continue;
    }
    if (!tree[leaf].IsExposed())
    {
      continue;
    }
    ++count;
    ASSERT_EQ(tree[leaf].escaped, 0.0) << "node " << leaf;
    for (const std::vector<double>& factors : closure)
    {
      ASSERT_GE(factors[leaf], Smallest);
      ASSERT_LE(factors[leaf], Largest);
    }
    if (IsWithinBounds(closure[BetweenSurfaces][leaf]))
    {
      EXPECT_NEAR(rows[leaf] / Pi, 1.0, 1e-4) << "node " << leaf;
    }
    else
    {
      ++held;
    }
  }
  // Few need more than is allowed.
  EXPECT_LE(held, count / 20) << count;
}

TEST(RowClosure, RowsOfAClosedBoxAreCompleteAfterAnyNumberOfRounds)
{
  for (int rounds = 0; rounds <= 5; ++rounds)
  {
    SCOPED_TRACE(std::to_string(rounds) + " rounds");
    Rounds box(test::MakeFurnace(Color(0.5)), rounds);
    box.RefineClusters();
    ExpectClosed(box);
  }
}

TEST(RowClosure, RowsOfClosedRoomsWithFurnitureAreComplete)
{
  Rounds furnished(test::MakeFurnishedRoom(), 3);
  furnished.RefineClusters();
  ExpectClosed(furnished);
  for (std::uint64_t seed = 1; seed <= 5; ++seed)
  {
    SCOPED_TRACE("seed " + std::to_string(seed));
    Rounds room(test::MakeRandomScene(seed), 2);
    room.RefineClusters();
    ExpectClosed(room);
  }
}

/// What clusters that nobody looked into have after any number of rounds: factor and closed row.
std::vector<std::pair<double, double>> FactorsAndRowsOfClusters(const Scene& scene)
{
  std::vector<std::pair<double, double>> found;
  for (int rounds = 0; rounds <= 6; ++rounds)
  {
    const Rounds solved(scene, rounds);
    const OpenTree& tree = solved.transport.Tree();
    const Closure closure = solved.Factors();
    const std::vector<double> rows = ClosedRows(tree, solved.transport.Links(), closure);
    for (const OpenId leaf : test::LeavesOf(tree))
    {
      if (tree[leaf].IsCluster())
      {
        found.emplace_back(closure[WithCluster][leaf], rows[leaf]);
      }
    }
  }
  return found;
}

TEST(RowClosure, ClustersOfAClosedRoomSeeTheWholeHemisphere)
{
  const auto clusters = FactorsAndRowsOfClusters(test::MakeFurnishedRoom());
  EXPECT_GT(clusters.size(), 10u);
  for (const auto& [factor, row] : clusters)
  {
    EXPECT_NEAR(row / Pi, 1.0, 1e-4) << "factor " << factor;
  }
}

TEST(RowClosure, ClustersFromWhichLightEscapesSeeNoMoreThanAHemisphere)
{
  const auto clusters = FactorsAndRowsOfClusters(test::MakeOpenBox(Color(0.5), Color(1.0)));
  EXPECT_FALSE(clusters.empty());
  for (const auto& [factor, row] : clusters)
  {
    EXPECT_LE(factor, 1.0);
    EXPECT_LE(row, Pi * (1.0 + 1e-4));
  }
}

TEST(RowClosure, RowsOfAnOpenBoxAreWhatTheProbesSay)
{
  Rounds box(test::MakeOpenBox(Color(0.5), Color(1.0)), 0);
  box.RefineClusters();
  for (int round = 0; round < 3; ++round)
  {
    box.transport.Refine(1.0);
    box.transport.Solve();
  }
  const OpenTree& tree = box.transport.Tree();
  const std::vector<double> rows = ClosedRows(tree, box.transport.Links(), test::NoClosure(tree));
  const std::vector<OpenId> leaves = test::LeavesOf(tree);
  const auto isOutside = [&](OpenId leaf)
  {
    const double deviation = rows[leaf] / Pi - (1.0 - tree[leaf].escaped);
    return std::abs(deviation) > tree[leaf].escapeError;
  };
  // Two standard deviations.
  EXPECT_LT(std::count_if(leaves.begin(), leaves.end(), isOutside), 0.1 * leaves.size());
}

/// The floor and the walls of an open box with links that are as exact as can be.
struct OpenBoxLinks
{
  OpenBoxLinks()
    : stage(test::MakeOpenBox())
    , tree(stage.MakeOpenTree())
  {
    test::OpenTo(tree, 0);
    const LinkEvaluator evaluator(tree, stage.occluders, 16);
    const std::vector<OpenId> patches = test::LeavesOf(tree);
    for (const OpenId a : patches)
    {
      for (const OpenId b : patches)
      {
        if (a < b)
        {
          links.push_back(evaluator.Evaluate({ { a, b } }).link);
        }
      }
    }
  }

  test::Stage stage;
  OpenTree tree;
  std::vector<Link> links;
};

TEST(RowClosure, ExactLinksOfAnOpenBoxAreLeftAloneToTheBit)
{
  const OpenBoxLinks box;
  Closure closure = test::NoClosure(box.tree);
  CloseRows(box.tree, LinkMatrix(box.tree, box.links), closure);
  EXPECT_EQ(closure, test::NoClosure(box.tree));
}

TEST(RowClosure, WrongRowsOfAnOpenBoxAreBroughtToTheBorderOfWhatIsKnown)
{
  OpenBoxLinks box;
  for (Link& link : box.links)
  {
    link.throughput *= 1.4;
  }
  Closure closure = test::NoClosure(box.tree);
  for (int call = 0; call < 5; ++call)
  {
    CloseRows(box.tree, LinkMatrix(box.tree, box.links), closure);
  }
  const std::vector<double> rows = ClosedRows(box.tree, box.links, closure);
  for (const OpenId leaf : test::LeavesOf(box.tree))
  {
    const OpenNode& node = box.tree[leaf];
    EXPECT_LT(closure[BetweenSurfaces][leaf], 1.0);
    EXPECT_NEAR(rows[leaf], Pi * std::min(1.0, 1.0 - node.escaped + node.escapeError), 1e-3);
  }
}

TEST(RowClosure, FactorsStayWithinTheirBounds)
{
  OpenBoxLinks box;
  for (const double scale : { 1e-4, 1e4 })
  {
    std::vector<Link> links = box.links;
    for (Link& link : links)
    {
      link.throughput *= scale;
    }
    Closure closure = test::NoClosure(box.tree);
    CloseRows(box.tree, LinkMatrix(box.tree, links), closure);
    for (const OpenId leaf : test::LeavesOf(box.tree))
    {
      EXPECT_EQ(closure[BetweenSurfaces][leaf], scale < 1.0 ? Largest : Smallest);
    }
  }
}

TEST(RowClosure, WhatARowLacksIsPutWhereNextToNothingIsKnown)
{
  // Of the links of one wall of a closed box only that with a second one is known. There is one
  // more, with the cluster of all, and rays have found an eighth of what it brings.
  const test::Stage stage(test::MakeFurnace(Color(0.5)));
  OpenTree tree = stage.MakeOpenTree();
  test::OpenTo(tree, 0);
  const LinkEvaluator evaluator(tree, stage.occluders, 16);
  const std::vector<OpenId> walls = test::LeavesOf(tree);
  std::vector<Link> links;
  for (std::size_t a = 0; a < walls.size(); ++a)
  {
    for (std::size_t b = a + 1; b < walls.size(); ++b)
    {
      if (a > 0 || b == 1)
      {
        links.push_back(evaluator.Evaluate({ { walls[a], walls[b] } }).link);
      }
    }
  }
  Link unknown;
  unknown.ends = { walls[0], 0 };
  unknown.throughput = 0.1 * Pi * tree[walls[0]].area;
  links.push_back(unknown);
  Closure closure = test::NoClosure(tree);
  for (int call = 0; call < 10; ++call)
  {
    CloseRows(tree, LinkMatrix(tree, links), closure);
  }
  const std::vector<double> rows = ClosedRows(tree, links, closure);
  for (const OpenId wall : walls)
  {
    EXPECT_NEAR(rows[wall] / Pi, 1.0, 1e-4);
    EXPECT_NEAR(closure[BetweenSurfaces][wall], 1.0, 0.35);
  }
  EXPECT_GT(closure[WithCluster][walls[0]] * closure[WithCluster][walls[2]], 5.0);
}

} // namespace
} // namespace vantage
