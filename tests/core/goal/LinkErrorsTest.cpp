#include "core/goal/LinkErrors.h"

#include "core/goal/GoalOrientedTransport.h"
#include "core/goal/GoalScenes.h"
#include "core/goal/SolvedLinks.h"
#include "support/TestScenes.h"

#include <gtest/gtest.h>

#include <cmath>

namespace vantage
{
namespace
{

/// Five surfaces of a lit box and flows over links of given values: radiance leaves surface 0, the
/// eye sees surface 3. What surface 2 gets is looked up by a gather, and lamps are integrated
/// there.
struct Fixture
{
  test::Stage stage{ test::MakeLitBox() };
  OpenTree tree = stage.MakeOpenTree();
  Flow radiance, importance;
  std::vector<OpenId> surfaces;

  Fixture()
  {
    test::OpenTo(this->tree, 0);
    this->radiance.Follow(this->tree);
    this->importance.Follow(this->tree);
    for (OpenId id = 0; id < this->tree.Size() && this->surfaces.size() < 5; ++id)
    {
      if (!this->tree[id].IsCluster())
      {
        this->surfaces.push_back(id);
      }
    }
  }

  Link Between(int a, int b, double throughput, double variation, double uncertainty) const
  {
    Link link;
    link.ends = { this->surfaces[a], this->surfaces[b] };
    link.throughput = throughput;
    link.variation = variation;
    link.uncertainty = uncertainty;
    return link;
  }

  LinkErrors Errors(const std::vector<Link>& links)
  {
    const LinkMatrix matrix(this->tree, links);
    const Closure closure = test::NoClosure(this->tree);
    for (const OpenId id : this->surfaces)
    {
      this->radiance.SetSource(id, Color(id == this->surfaces[0] ? 1.0 : 0.0));
      this->importance.SetSource(id, Color(id == this->surfaces[3] ? 1.0 : 0.0));
    }
    for (int sweep = 0; sweep < 3; ++sweep)
    {
      this->radiance.Sweep(matrix, closure);
      this->importance.Sweep(matrix, closure);
    }
    this->radiance.FindSpreads(this->tree, matrix, links);
    this->importance.FindSpreads(this->tree, matrix, links);
    this->importance.FindStraight(matrix, closure);
    return LinkErrors(this->tree, links, this->radiance, this->importance, closure);
  }
};

TEST(LinkErrors, LinksThatAreKnownExactlyHaveNone)
{
  Fixture f;
  const LinkErrors errors = f.Errors({ f.Between(0, 1, 0.1, 0.0, 0.0),
    f.Between(1, 2, 0.1, 0.0, 0.0), f.Between(2, 3, 0.1, 0.0, 0.0) });
  EXPECT_EQ(errors.All(), 0.0);
  EXPECT_EQ(errors.OfLinks(), (std::vector<double>{ 0.0, 0.0, 0.0 }));
}

TEST(LinkErrors, UncertaintiesAddAsSquares)
{
  const auto errorOf = [](double first, double second)
  {
    Fixture f;
    return f
      .Errors({ f.Between(0, 1, 0.1, 0.0, first), f.Between(0, 4, 0.1, 0.0, second),
        f.Between(1, 2, 0.1, 0.0, 0.0), f.Between(4, 2, 0.1, 0.0, 0.0),
        f.Between(2, 3, 0.1, 0.0, 0.0) })
      .All();
  };
  const double one = errorOf(0.02, 0.0);
  const double other = errorOf(0.0, 0.05);
  EXPECT_GT(one, 0.0);
  EXPECT_GT(other, 0.0);
  EXPECT_NEAR(errorOf(0.02, 0.05), std::hypot(one, other), 1e-12);
}

TEST(LinkErrors, ANamedLampDoesNotErrWhereItIsIntegratedOnceMore)
{
  // An uncertain link to what the gather meets: from a lamp, and from a surface that it lights.
  Fixture f;
  const double ofLamp =
    f.Errors({ f.Between(0, 2, 0.1, 0.0, 0.02), f.Between(2, 3, 0.1, 0.0, 0.0) }).All();
  const double importance = Mean(f.importance.Received(f.surfaces[2]));
  Fixture g;
  const double ofSurface =
    g.Errors({ g.Between(0, 1, 0.1, 0.0, 0.0), g.Between(1, 2, 0.1, 0.0, 0.02),
               g.Between(2, 3, 0.1, 0.0, 0.0) })
      .All();
  const double radiance = Mean(g.radiance.Value(g.surfaces[1]));
  const double ofSurfaceAsBright = ofSurface / radiance;
  EXPECT_GT(ofSurfaceAsBright, 0.1 * 0.02 * importance);
  // What is left: light that goes to and fro between surfaces 2 and 3 and arrives once more.
  EXPECT_LT(ofLamp, 0.13 * ofSurfaceAsBright);
}

TEST(LinkErrors, VariationsAtOneEndAddAsTheyAre)
{
  // Surface 1 receives importance unevenly; what arrives over its two links errs the same way.
  Fixture f;
  const auto errorOf = [&](double variation)
  {
    const Link twice = f.Between(0, 1, 0.05, variation, 0.0);
    const Link uneven = f.Between(1, 2, 0.1, 0.03, 0.0);
    return f.Errors({ twice, twice, uneven, f.Between(2, 3, 0.1, 0.0, 0.0) });
  };
  Fixture g;
  const LinkErrors both = errorOf(0.02);
  const LinkErrors whole = g.Errors({ g.Between(0, 1, 0.1, 0.04, 0.0),
    g.Between(1, 2, 0.1, 0.03, 0.0), g.Between(2, 3, 0.1, 0.0, 0.0) });
  ASSERT_GT(whole.All(), 0.0);
  // As one link of both: but for the spread of what arrives, whose parts add as squares.
  EXPECT_GT(both.All(), 0.7 * whole.All());
  EXPECT_LT(both.All(), whole.All() * (1.0 + 1e-12));
}

TEST(LinkErrors, WhatALinkCostsIsWhatTheSquareLosesWithoutIt)
{
  const auto errorsOf = [](double first, double second)
  {
    Fixture f;
    return f.Errors({ f.Between(0, 1, 0.1, 0.0, first), f.Between(0, 4, 0.1, 0.0, second),
      f.Between(1, 2, 0.1, 0.0, 0.0), f.Between(4, 2, 0.1, 0.0, 0.0),
      f.Between(2, 3, 0.1, 0.0, 0.0) });
  };
  const LinkErrors both = errorsOf(0.02, 0.05);
  const LinkErrors one = errorsOf(0.0, 0.05);
  ASSERT_EQ(both.OfLinks().size(), 5u);
  EXPECT_GT(both.OfLinks()[0], 0.0);
  EXPECT_EQ(both.OfLinks()[2], 0.0);
  EXPECT_NEAR(both.OfLinks()[0], both.All() * both.All() - one.All() * one.All(),
    1e-12 * both.All() * both.All());
}

/// The error of uncertain links from a lamp to what the eye sees.
double ErrorFromLamp(const OpenTree& tree, OpenId lamp, OpenId seen, int links)
{
  Flow radiance, importance;
  radiance.Follow(tree);
  importance.Follow(tree);
  radiance.SetSource(lamp, tree[lamp].emission, tree[lamp].emissionRms);
  importance.SetSource(seen, Color(0.1), 0.1); // evenly: nothing else can err
  const LinkMatrix matrix(tree, {});
  const Closure closure = test::NoClosure(tree);
  radiance.Sweep(matrix, closure);
  importance.Sweep(matrix, closure);
  radiance.FindSpreads(tree, matrix, {});
  importance.FindSpreads(tree, matrix, {});
  importance.FindStraight(matrix, closure);
  Link link;
  link.ends = { std::min(lamp, seen), std::max(lamp, seen) };
  link.throughput = 0.2;
  link.uncertainty = 0.4;
  const std::vector<Link> all(static_cast<std::size_t>(links), link);
  return LinkErrors(tree, all, radiance, importance, closure).All();
}

TEST(LinkErrors, LampsWithoutANameErrByTheirSum)
{
  // A lamp in a cluster that was not looked into, and a surface that the eye sees.
  const test::Stage stage(test::MakeLitBox());
  OpenTree tree = stage.MakeOpenTree();
  tree.Open(0);
  ASSERT_TRUE(tree[1].IsCluster() && tree[2].IsCluster());
  const OpenId lamps = Mean(tree[1].emission) > 0.0 ? 1 : 2;
  const double once = ErrorFromLamp(tree, lamps, 3 - lamps, 1);
  EXPECT_GE(once, 0.1 * 0.4 * Mean(tree[lamps].emission) * 0.1);
  EXPECT_NEAR(ErrorFromLamp(tree, lamps, 3 - lamps, 3), 3.0 * once, 1e-12 * once);
}

/// What a gather integrates at what the eye sees does not err there.
TEST(LinkErrors, ALampOfManyFacetsHasAName)
{
  Scene scene = test::MakeLitBox();
  scene.materials.push_back(test::MakeMaterial(Color(0.5), Color(8.0), false));
  test::AddBall(scene, Vec3(0.5), 0.1, 8, static_cast<std::uint32_t>(scene.materials.size() - 1));
  const test::Stage stage(scene);
  OpenTree tree = stage.MakeOpenTree();
  OpenId ball = 0;
  for (; !tree.Geometry(ball).IsSmooth() || !tree[ball].IsCluster(); ++ball)
  {
    tree.Open(ball);
  }
  ASSERT_GT(Mean(tree[ball].emission), 0.0);
  EXPECT_EQ(tree.Patches().LampCount(tree.RangeOf(ball)), 1u);
  OpenId wall = 0;
  while (tree[wall].IsCluster())
  {
    tree.Open(wall++);
  }
  EXPECT_EQ(ErrorFromLamp(tree, ball, wall, 1), 0.0);
}

/// The error of a link from a cluster to what the eye sees, by what is known of it.
double ErrorFromCluster(bool hasLamp, double variation, double uncertainty)
{
  Fixture f;
  OpenId cluster = 1;
  while (!f.tree[cluster].IsCluster() || test::IsBelow(f.tree, f.surfaces[0], cluster) != hasLamp ||
         test::IsBelow(f.tree, f.surfaces[2], cluster))
  {
    ++cluster;
  }
  std::vector<Link> links = { f.Between(0, 1, 0.1, 0.0, 0.0), f.Between(1, 2, 0.1, 0.0, 0.0),
    f.Between(2, 3, 0.1, 0.0, 0.0) };
  links[0].ends[1] = links[1].ends[0] = cluster;
  f.Errors(links);
  links[1].variation = variation;
  links[1].uncertainty = uncertainty;
  return LinkErrors(f.tree, links, f.radiance, f.importance, test::NoClosure(f.tree)).All();
}

TEST(LinkErrors, PartsOfCurvedSurfacesErrByTheirVariation)
{
  const double uncertain = ErrorFromCluster(false, 0.0, 0.02);
  EXPECT_GT(uncertain, 0.0);
  EXPECT_NEAR(ErrorFromCluster(false, 0.02, 0.5), uncertain, 1e-12 * uncertain);
  EXPECT_NEAR(ErrorFromCluster(false, 0.01, 0.5), 0.5 * uncertain, 1e-12 * uncertain);
}

TEST(LinkErrors, WhatTheClosureMultipliesErrsByAsMuch)
{
  Fixture f;
  const std::vector<Link> links = { f.Between(0, 1, 0.1, 0.0, 0.0),
    f.Between(1, 2, 0.1, 0.03, 0.02), f.Between(2, 3, 0.1, 0.0, 0.0) };
  const double all = f.Errors(links).All();
  ASSERT_GT(all, 0.0);
  const auto errorOf = [&](LinkKind kind, double first, double second)
  {
    Closure closure = test::NoClosure(f.tree);
    closure[kind][f.surfaces[1]] = first;
    closure[kind][f.surfaces[2]] = second;
    return LinkErrors(f.tree, links, f.radiance, f.importance, closure).All();
  };
  EXPECT_NEAR(errorOf(BetweenSurfaces, 2.0, 8.0), 16.0 * all, 1e-12 * all);
  EXPECT_EQ(errorOf(WithCluster, 2.0, 8.0), all);
  EXPECT_EQ(errorOf(BetweenSurfaces, 0.1, 0.5), all);
}

TEST(LinkErrors, ALampThatComesToLightIsExpectedToErrAsItDoes)
{
  // Half of the box, with the lamp somewhere in it, and what the eye sees, whose parts come next.
  const test::Stage stage(test::MakeLitBox());
  OpenTree tree = stage.MakeOpenTree();
  tree.Open(0);
  const OpenId lamps = Mean(tree[1].emission) > 0.0 ? 1 : 2;
  const OpenId seen = 3 - lamps;
  Flow radiance, importance;
  const auto solve = [&]
  {
    const LinkMatrix matrix(tree, {});
    const Closure closure = test::NoClosure(tree);
    for (Flow* flow : { &radiance, &importance })
    {
      flow->Follow(tree);
      for (OpenId id = 0; id < tree.Size(); ++id)
      {
        const OpenNode& node = tree[id];
        if (node.IsLeaf() && flow == &radiance)
        {
          flow->SetSource(id, node.emission, node.emissionRms);
        }
        else if (id == seen)
        {
          flow->SetSource(id, Color(0.1), 0.3);
        }
      }
      flow->Sweep(matrix, closure);
      flow->FindSpreads(tree, matrix, {});
      flow->FindStraight(matrix, closure);
    }
  };
  solve();
  Link link;
  link.ends = { 1, 2 };
  link.uncertainty = 0.4; // a link that brings nothing: what nodes have received stays the same
  LinkErrors errors(tree, { link }, radiance, importance, test::NoClosure(tree));
  tree.Open(lamps);
  const OpenId child = tree[lamps].firstChild;
  link.ends = { Mean(tree[child].emission) > 0.0 ? child : child + 1, seen };
  radiance.Follow(tree);
  importance.Follow(tree);
  for (OpenId id = child; id < tree.Size(); ++id)
  {
    radiance.SetSource(id, tree[id].emission, tree[id].emissionRms);
  }
  errors.Follow(tree, radiance, importance);
  const double expected = errors.Expected(tree, link, {});
  EXPECT_GT(expected, errors.OfLinks()[0]); // brighter, as it is smaller
  solve();
  const double found =
    LinkErrors(tree, { link }, radiance, importance, test::NoClosure(tree)).OfLinks()[0];
  EXPECT_NEAR(expected / found, 1.0, 1e-12);
}

} // namespace
} // namespace vantage
