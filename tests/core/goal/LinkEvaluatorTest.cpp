#include "core/goal/LinkEvaluator.h"

#include "core/goal/GoalScenes.h"
#include "core/reference/DenseSolve.h"
#include "core/scene/Labyrinth.h"
#include "core/transport/PairEvaluator.h"
#include "core/visibility/PairVisibility.h"
#include "properties/RandomScene.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace vantage
{
namespace
{

constexpr std::uint32_t Rays = 16;

/// Throughput between all pairs of patches, as exactly as it can be had.
class ExactThroughputs
{
public:
  ExactThroughputs(const test::Stage& stage, const OpenTree& tree)
    : Tree(&tree)
    , Count(tree.RangeOf(0).last)
  {
    std::vector<NodeId> nodes;
    for (std::uint32_t place = 0; place < this->Count; ++place)
    {
      nodes.push_back(tree.Tree().Patches()[tree.Patches()[place]].node);
    }
    this->OfPatches = DenseThroughput(stage.facets, tree.Tree(), nodes, {});
  }

  /// Between all that lies in two clusters or patches.
  double Between(OpenId a, OpenId b) const
  {
    const PatchRange first = this->Tree->RangeOf(a);
    const PatchRange second = this->Tree->RangeOf(b);
    double sum = 0.0;
    for (std::uint32_t i = first.first; i < first.last; ++i)
    {
      for (std::uint32_t k = second.first; k < second.last; ++k)
      {
        sum += this->OfPatches[i * this->Count + k];
      }
    }
    return sum;
  }

private:
  const OpenTree* Tree;
  std::size_t Count;
  std::vector<double> OfPatches; ///< by places in the order of the patches
};

/// Relative errors of estimates.
struct Bias
{
  double sum = 0.0;
  double squares = 0.0;
  int count = 0;

  void Add(double error)
  {
    this->sum += error;
    this->squares += error * error;
    ++this->count;
  }
  double Mean() const { return this->sum / this->count; }
  /// Of the mean.
  double Deviation() const
  {
    return std::sqrt((this->squares / this->count - this->Mean() * this->Mean()) / this->count);
  }
};

/// Of all links between clusters and others of a scene: each draws points of its own, by the seed.
/// Those that come near to the bound of a hemisphere are left out, as estimates are cut there.
void AddErrors(const Scene& scene, std::uint64_t seed, Bias& bias)
{
  const test::Stage stage(scene);
  OpenTree tree = stage.MakeOpenTree();
  test::OpenTo(tree, 0);
  const ExactThroughputs exact(stage, tree);
  const LinkEvaluator evaluator(tree, stage.occluders, Rays, seed);
  for (OpenId a = 0; a < tree.Size(); ++a)
  {
    for (OpenId b = a; b < tree.Size(); ++b)
    {
      const double bound = Pi * std::min(tree.Geometry(a).area, tree.Geometry(b).area);
      const double throughput = exact.Between(a, b);
      if ((tree[a].IsCluster() || tree[b].IsCluster()) && throughput > 0.05 * bound &&
          throughput < 0.4 * bound)
      {
        bias.Add(evaluator.Evaluate({ { a, b } }).link.throughput / throughput - 1.0);
      }
    }
  }
}

template <typename MakeScene>
Bias BiasOf(int scenes, const MakeScene& makeScene)
{
  Bias bias;
  for (int seed = 1; seed <= scenes; ++seed)
  {
    AddErrors(makeScene(seed), static_cast<std::uint64_t>(seed), bias);
  }
  return bias;
}

Vec2 PanelSize(RandomStream& random)
{
  return Vec2(0.1 + 0.3 * random.Next(), 0.1 + 0.3 * random.Next());
}

/// Panels on the floor that face up and panels above that face down: each pair sees all of each
/// other.
Scene MakeFacingPanels(std::uint64_t seed)
{
  RandomStream random(seed, 7u);
  Scene scene;
  scene.materials = { test::MakeMaterial(Color(0.5)), test::MakeMaterial(Color(0.5), Color(5.0)) };
  for (int i = 0; i < 6; ++i)
  {
    const bool facesUp = i % 2 == 0;
    // Beside each other: none overlaps another one.
    const Vec3 centre(0.5 * (i / 2) + 0.1 * random.Next(), random.Next(), facesUp ? 0.0 : 0.8);
    test::AddPanel(scene, centre, PanelSize(random), facesUp, i == 1 ? 1 : 0);
  }
  return scene;
}

/// Tiles on the floor beside two walls that reach as far below the floor as above it. Nothing hides
/// anything.
Scene MakeCutWalls(std::uint64_t seed)
{
  RandomStream random(seed, 8u);
  Scene scene;
  scene.materials = { test::MakeMaterial(Color(0.5)), test::MakeMaterial(Color(0.5), Color(2.0)) };
  for (int i = 0; i < 4; ++i)
  {
    const Vec3 centre(0.25 + 0.5 * (i % 2), 0.25 + 0.5 * (i / 2), 0.0);
    test::AddPanel(scene, centre, PanelSize(random), true, i == 1 ? 1 : 0);
  }
  const double x = -0.3 - random.Next();
  const double y = -0.3 - random.Next();
  scene.AddPolygon({ Vec3(x, 0, -1), Vec3(x, 1, -1), Vec3(x, 1, 1), Vec3(x, 0, 1) }, 0);
  scene.AddPolygon({ Vec3(1, y, -1), Vec3(0, y, -1), Vec3(0, y, 1), Vec3(1, y, 1) }, 0);
  return scene;
}

TEST(LinkEvaluator, SurfacesHaveTheClosedFormTimesWhatIsVisible)
{
  for (std::uint64_t seed = 1; seed <= 3; ++seed)
  {
    SCOPED_TRACE("seed " + std::to_string(seed));
    const test::Stage stage(test::MakeRandomScene(seed));
    OpenTree tree = stage.MakeOpenTree();
    test::OpenTo(tree, 1);
    const LinkEvaluator evaluator(tree, stage.occluders, Rays);
    for (const OpenId a : test::LeavesOf(tree))
    {
      for (const OpenId b : test::LeavesOf(tree))
      {
        if (a == b)
        {
          continue;
        }
        const EvaluatedLink made = evaluator.Evaluate({ { a, b } });
        const EvaluatedLink swapped = evaluator.Evaluate({ { b, a } });
        ASSERT_EQ(made.link.throughput, swapped.link.throughput);
        ASSERT_EQ(made.link.visibility, swapped.link.visibility);
        ASSERT_EQ(made.link.uncertainty, swapped.link.uncertainty);
        ASSERT_EQ(made.link.variation, swapped.link.variation);
        ASSERT_EQ(made.link.agreeingRays, swapped.link.agreeingRays);
        const double unoccluded = Throughput(tree.Shape(a), tree.Shape(b));
        if (made.isKnownHidden)
        {
          ASSERT_EQ(made.link.throughput, 0.0);
          ASSERT_EQ(unoccluded * EstimateVisibility(stage.occluders,
                                   { tree.Shape(a), tree.PatchOf(a).facet },
                                   { tree.Shape(b), tree.PatchOf(b).facet }, 64, 1)
                                   .fraction,
            0.0);
          continue;
        }
        ASSERT_EQ(made.link.throughput, made.link.visibility * unoccluded);
        ASSERT_LE(made.link.variation, made.link.throughput);
        const bool isMixed = made.link.visibility > 0.0 && made.link.visibility < 1.0;
        ASSERT_EQ(made.link.agreeingRays == 0, isMixed);
      }
    }
  }
}

TEST(LinkEvaluator, FacesOfACubeAreCertain)
{
  const test::Stage stage(test::MakeRoom());
  OpenTree tree = stage.MakeOpenTree();
  test::OpenTo(tree, 0);
  const LinkEvaluator evaluator(tree, stage.occluders, Rays);
  const OpenId floor = test::PatchAt(tree, Vec3(0.5, 0.5, 0.0), Vec3(0, 0, 1));
  const OpenId ceiling = test::PatchAt(tree, Vec3(0.5, 0.5, 1.0), Vec3(0, 0, -1));
  const EvaluatedLink made = evaluator.Evaluate({ { floor, ceiling } });
  EXPECT_NEAR(made.link.throughput, Pi * 0.199824895698387, 1e-5);
  EXPECT_EQ(made.link.visibility, 1.0);
  EXPECT_GE(made.link.agreeingRays, Certain);
  EXPECT_LT(made.link.uncertainty, 1e-5);
  EXPECT_LE(made.rays, 1u);
}

TEST(LinkEvaluator, AfterEnoughAgreeingRaysNoneIsTraced)
{
  const test::Stage stage(test::MakeFurnishedRoom());
  OpenTree tree = stage.MakeOpenTree();
  test::OpenTo(tree, 0);
  const LinkEvaluator evaluator(tree, stage.occluders, Rays);
  const OpenId floor = test::PatchAt(tree, Vec3(0.1, 0.1, 0.0), Vec3(0, 0, 1));
  const OpenId lamp = test::PatchAt(tree, Vec3(0.45, 0.5, 0.95), Vec3(0, 0, -1));
  const EvaluatedLink certified = evaluator.Evaluate({ { floor, lamp }, 1.0, CertifyingRays });
  EXPECT_EQ(certified.rays, 0u);
  EXPECT_EQ(certified.link.visibility, 1.0);
  EXPECT_EQ(certified.link.agreeingRays, CertifyingRays);
  EXPECT_EQ(certified.link.throughput, Throughput(tree.Shape(floor), tree.Shape(lamp)));
  EXPECT_GT(evaluator.Evaluate({ { floor, lamp }, 1.0, CertifyingRays - 1 }).rays, 0u);
  EXPECT_GT(evaluator.Evaluate({ { floor, lamp }, 0.0, Certain }).rays, 0u);
}

/// Two panels with a screen of two parts between them: no single facet hides all, so that only rays
/// can tell.
Scene MakeHiddenPair()
{
  Scene scene;
  scene.materials = { test::MakeMaterial(Color(0.5)) };
  test::AddPanel(scene, Vec3(0.0), Vec2(1.0, 1.0), true, 0);
  test::AddPanel(scene, Vec3(0.0, 0.0, 1.0), Vec2(1.0, 1.0), false, 0);
  test::AddPanel(scene, Vec3(-1.0, 0.0, 0.5), Vec2(2.0, 4.0), true, 0);
  test::AddPanel(scene, Vec3(1.0, 0.0, 0.5), Vec2(2.0, 4.0), true, 0);
  return scene;
}

TEST(LinkEvaluator, UncertaintyOfAHiddenPairFallsWithTheRaysOfItsChain)
{
  const test::Stage stage(MakeHiddenPair());
  OpenTree tree = stage.MakeOpenTree();
  test::OpenTo(tree, 0);
  const LinkEvaluator evaluator(tree, stage.occluders, Rays);
  const OpenId low = test::PatchAt(tree, Vec3(0.0), Vec3(0, 0, 1));
  const OpenId high = test::PatchAt(tree, Vec3(0.0, 0.0, 1.0), Vec3(0, 0, -1));
  const double unoccluded = Throughput(tree.Shape(low), tree.Shape(high));
  double last = unoccluded;
  LinkRequest request{ { low, high } };
  for (int generation = 0; generation < 4; ++generation)
  {
    const EvaluatedLink made = evaluator.Evaluate(request);
    EXPECT_FALSE(made.isKnownHidden);
    EXPECT_EQ(made.link.throughput, 0.0);
    EXPECT_EQ(made.link.visibility, 0.0);
    // Those of the proof that fails go along one line, and tell as much as one.
    EXPECT_EQ(made.link.agreeingRays, request.parentAgreeingRays + Rays + 1);
    EXPECT_GT(made.rays, Rays + 1);
    EXPECT_NEAR(made.link.uncertainty, unoccluded / (made.link.agreeingRays + 2.0), 1e-12);
    EXPECT_LT(made.link.uncertainty, last);
    last = made.link.uncertainty;
    request.parentVisibility = made.link.visibility;
    request.parentAgreeingRays = made.link.agreeingRays;
  }
  // A parent that was seen says nothing about what is hidden of its child.
  request.parentVisibility = 1.0;
  request.parentAgreeingRays = CertifyingRays - 1;
  EXPECT_EQ(evaluator.Evaluate(request).link.agreeingRays, Rays + 1);
}

TEST(LinkEvaluator, ClustersThatSeeAllOfEachOtherHaveAnUnbiasedEstimate)
{
  const Bias bias = BiasOf(100, MakeFacingPanels);
  EXPECT_NEAR(bias.Mean(), 0.0, 4.0 * bias.Deviation());
  EXPECT_LT(bias.Deviation(), 0.02);
}

TEST(LinkEvaluator, ClustersWithSurfacesThatSeeEachOtherInPartHaveAnUnbiasedEstimate)
{
  const Bias bias = BiasOf(100, MakeCutWalls);
  EXPECT_NEAR(bias.Mean(), 0.0, 4.0 * bias.Deviation());
  EXPECT_LT(bias.Deviation(), 0.02);
}

TEST(LinkEvaluator, ClustersWithOccludersHaveNextToNoBias)
{
  const Bias bias = BiasOf(20, [](int seed) { return test::MakeRandomScene(seed); });
  // A surface may be hidden where most of its light would come from, which pairs of points do not
  // know.
  EXPECT_NEAR(bias.Mean(), 0.0, 0.05 + 4.0 * bias.Deviation());
  EXPECT_LT(bias.Deviation(), 0.02);
}

TEST(LinkEvaluator, ASmallBrightLampInABigClusterIsMet)
{
  // Fifty panels with their backs to the receivers, and one lamp of a centimetre that faces them.
  Scene scene;
  scene.materials = { test::MakeMaterial(Color(0.5)), test::MakeMaterial(Color(0.5), Color(1e4)) };
  for (int i = 0; i < 50; ++i)
  {
    test::AddPanel(scene, Vec3(i % 10, i / 10, 5.0), Vec2(0.9, 0.9), true, 0);
    test::AddPanel(scene, Vec3(i % 10, i / 10, -15.0), Vec2(0.9, 0.9), true, 0);
  }
  test::AddPanel(scene, Vec3(4.5, 2.5, 5.0), Vec2(0.01, 0.01), false, 1);
  const test::Stage stage(scene);
  OpenTree tree = stage.MakeOpenTree();
  tree.Open(0);
  const bool isUpperFirst = Mean(tree[1].emission) > 0.0;
  const OpenId upper = isUpperFirst ? 1 : 2;
  const OpenId lower = isUpperFirst ? 2 : 1;
  ASSERT_EQ(tree.RangeOf(upper).last - tree.RangeOf(upper).first, 51u);
  const EvaluatedLink made = LinkEvaluator(tree, stage.occluders, Rays).Evaluate({ { 1, 2 } });
  EXPECT_EQ(made.link.agreeingRays, 0u);
  EXPECT_GT(made.link.visibility, 0.0);
  const double exact = ExactThroughputs(stage, tree).Between(upper, lower);
  EXPECT_NEAR(made.link.throughput / exact, 1.0, 0.5);
}

TEST(LinkEvaluator, WhatIsWithinAClusterIsInDoubtHoweverManyRaysWereStopped)
{
  // Of few points in many rooms, hardly two see each other; neighbours do.
  LabyrinthSettings rooms;
  rooms.rows = 6;
  rooms.columns = 6;
  const test::Stage stage(MakeLabyrinth(rooms));
  const OpenTree tree = stage.MakeOpenTree();
  int hidden = 0;
  for (std::uint64_t seed = 1; seed <= 20; ++seed)
  {
    const Link link = LinkEvaluator(tree, stage.occluders, Rays, seed).Evaluate({ { 0, 0 } }).link;
    hidden += link.throughput == 0.0 && link.agreeingRays > 4 ? 1 : 0;
    EXPECT_GT(link.uncertainty, 0.05 * Pi * tree.Geometry(0).area) << "seed " << seed;
  }
  EXPECT_GT(hidden, 0);
}

TEST(LinkEvaluator, OfPartsOfACurvedSurfaceTheVariationIsKnown)
{
  const test::Stage stage(test::MakeBallOverFloor());
  OpenTree tree = stage.MakeOpenTree();
  test::OpenTo(tree, 0);
  const OpenId floor = test::PatchAt(tree, { 0.0, 0.0, -1.0 }, { 0.0, 0.0, 1.0 });
  const LinkEvaluator evaluator(tree, stage.occluders, Rays);
  int smooth = 0;
  for (OpenId id = 0; id < tree.Size(); ++id)
  {
    if (!tree[id].IsCluster())
    {
      continue;
    }
    const Node& cluster = tree.Geometry(id);
    const Link link = evaluator.Evaluate({ { id, floor } }).link;
    EXPECT_LT(link.variation, link.throughput + 1e-12);
    EXPECT_EQ(link.variation > 0.0, cluster.IsSmooth() && link.throughput > 0.0);
    smooth += link.variation > 0.0 ? 1 : 0;
    // The finer, the less; and the less of itself it can see.
    EXPECT_GE(cluster.Bend() + 0.5, link.variation / (link.throughput + 1e-12));
    const Link self = evaluator.Evaluate({ { id, id } }).link;
    const double most = Pi * cluster.area * cluster.Bend() * cluster.Bend() / 16.0;
    EXPECT_LE(self.uncertainty, (1.0 + 1e-12) * std::max(self.throughput, most));
  }
  EXPECT_GT(smooth, 200);
}

TEST(LinkEvaluator, AClusterNeverHasMoreThanAHemisphere)
{
  const test::Stage stage(test::MakeFurnishedRoom());
  OpenTree tree = stage.MakeOpenTree();
  test::OpenTo(tree, 0);
  const LinkEvaluator evaluator(tree, stage.occluders, Rays);
  for (OpenId a = 0; a < tree.Size(); ++a)
  {
    for (OpenId b = a; b < tree.Size(); ++b)
    {
      if (tree[a].IsCluster() || tree[b].IsCluster())
      {
        const EvaluatedLink made = evaluator.Evaluate({ { a, b } });
        const EvaluatedLink swapped = evaluator.Evaluate({ { b, a } });
        EXPECT_EQ(made.link.throughput, swapped.link.throughput);
        EXPECT_LE(
          made.link.throughput, Pi * std::min(tree.Geometry(a).area, tree.Geometry(b).area));
        EXPECT_GE(made.link.uncertainty, made.link.throughput);
        EXPECT_FALSE(made.isKnownHidden);
        EXPECT_GT(made.link.uncertainty, 0.0);
      }
    }
  }
}

} // namespace
} // namespace vantage
