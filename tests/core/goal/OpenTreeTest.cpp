#include "core/goal/OpenTree.h"

#include "core/formfactor/FormFactor.h"
#include "core/goal/GoalScenes.h"
#include "core/scene/Labyrinth.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>

namespace vantage
{
namespace
{

constexpr double SideFactor = 0.200043776075403;     ///< of squares that share an edge
constexpr double OppositeFactor = 0.199824895698387; ///< of opposite faces of a cube

/// The view of every node by walking down with each sample.
std::vector<double> DirectViews(const OpenTree& tree, const std::vector<ViewSample>& samples)
{
  std::map<PatchId, OpenId> openOf;
  for (OpenId id = 0; id < tree.Size(); ++id)
  {
    if (!tree[id].IsCluster() && tree[id].level == 0)
    {
      openOf[tree[id].patch] = id;
    }
  }
  std::vector<double> views(tree.Size(), 0.0);
  for (const ViewSample& sample : samples)
  {
    for (OpenId id = test::LeafAt(tree, openOf.at(sample.patch), sample.point); id != None;
         id = tree[id].parent)
    {
      views[id] += sample.weight;
    }
  }
  return views;
}

void ExpectViews(const OpenTree& tree, const std::vector<ViewSample>& samples)
{
  const std::vector<double> expected = DirectViews(tree, samples);
  ASSERT_GT(expected[0], 0.0);
  for (OpenId id = 0; id < tree.Size(); ++id)
  {
    ASSERT_NEAR(tree[id].view, expected[id], 1e-12) << "node " << id;
    double ofChildren = 0.0;
    for (OpenId c = tree[id].firstChild;
         !tree[id].IsLeaf() && c < tree[id].firstChild + tree[id].childCount; ++c)
    {
      ofChildren += tree[c].view;
    }
    if (!tree[id].IsLeaf())
    {
      ASSERT_NEAR(ofChildren, tree[id].view, 1e-12);
    }
  }
}

TEST(OpenTree, StartsAtTheRootAndOpensOnce)
{
  const test::Stage stage(test::MakeFurnishedRoom());
  OpenTree tree = stage.MakeOpenTree();
  EXPECT_EQ(tree.Size(), 1u);
  EXPECT_TRUE(tree[0].IsLeaf() && tree[0].IsCluster());
  tree.Open(0);
  tree.Open(0);
  EXPECT_EQ(tree.Size(), 3u);
  test::OpenTo(tree, 1);
  double area = 0.0;
  for (OpenId id = 0; id < tree.Size(); ++id)
  {
    const OpenNode& node = tree[id];
    EXPECT_TRUE(id == 0 || node.parent < id);
    EXPECT_EQ(node.patch, tree.Geometry(id).patch);
    area += node.IsLeaf() ? tree.Geometry(id).area : 0.0;
    for (OpenId c = node.firstChild; !node.IsLeaf() && c < node.firstChild + node.childCount; ++c)
    {
      EXPECT_EQ(tree[c].parent, id);
      EXPECT_EQ(tree.Geometry(c).parent, node.node);
    }
  }
  EXPECT_NEAR(area, tree.Geometry(0).area, 1e-12);
}

void ExpectViewsAreHandedDown(const Scene& scene)
{
  const test::Stage stage(scene);
  const std::vector<ViewSample> samples = stage.View();
  OpenTree before = stage.MakeOpenTree();
  before.SetView(samples);
  double all = 0.0;
  for (const ViewSample& sample : samples)
  {
    all += sample.weight;
  }
  EXPECT_NEAR(before[0].view, all, 1e-12);
  test::OpenTo(before, 2);
  ExpectViews(before, samples);

  // The other way round: a view for a tree that is open.
  OpenTree after = stage.MakeOpenTree();
  test::OpenTo(after, 2);
  after.SetView(samples);
  ExpectViews(after, samples);

  // Another view leaves nothing of the first one behind.
  std::vector<ViewSample> few(samples.begin(), samples.begin() + 40);
  before.SetView(few);
  ExpectViews(before, few);
}

TEST(OpenTree, OpeningHandsTheViewDown)
{
  ExpectViewsAreHandedDown(test::MakeFurnishedRoom());
  ExpectViewsAreHandedDown(test::CutIntoPieces(test::MakeFurnishedRoom(), 4));
}

TEST(OpenTree, AFlatClusterIsASurface)
{
  const test::Stage stage(test::CutIntoPieces(test::MakeLitBox(), 4));
  OpenTree tree = stage.MakeOpenTree();
  test::OpenTo(tree, 0);
  int flat = 0;
  for (OpenId id = 0; id < tree.Size(); ++id)
  {
    const Node& node = tree.Geometry(id);
    ASSERT_EQ(tree[id].IsCluster(), !node.HasShape());
    if (node.IsCluster() && node.HasShape())
    {
      ++flat;
      EXPECT_TRUE(tree.RangeOf(id).first <= tree.Patches().PlaceOf(tree[id].patch) &&
                  tree.Patches().PlaceOf(tree[id].patch) < tree.RangeOf(id).last);
      EXPECT_EQ(tree[id].albedo, tree.Optics()[tree[id].patch].albedo);
      EXPECT_NEAR(glm::length(tree.PatchOf(id).normal - UnitNormal(tree.Shape(id))), 0.0, 1e-12);
    }
  }
  EXPECT_GT(flat, 10);
}

TEST(OpenTree, NodesKnowHowUnevenlyViewAndEmissionLieInThem)
{
  LabyrinthSettings size;
  size.rows = 1;
  size.columns = 2;
  const test::Stage stage(MakeLabyrinth(size));
  const std::vector<ViewSample> samples = stage.View();
  OpenTree tree = stage.MakeOpenTree();
  tree.SetView(samples);
  test::OpenTo(tree, 0);
  for (OpenId id = 0; id < tree.Size(); ++id)
  {
    if (!tree[id].IsCluster())
    {
      // Between an even view and one that lies in one of sixteen parts.
      const double mean = tree[id].view / tree[id].area;
      EXPECT_GE(tree[id].viewRms, mean * (1.0 - 1e-12));
      EXPECT_LE(tree[id].viewRms, 4.0 * mean * (1.0 + 1e-12));
      EXPECT_EQ(tree[id].emissionRms, 0.0);
      continue;
    }
    double views = 0.0;
    double emissions = 0.0;
    for (OpenId p = 0; p < tree.Size(); ++p)
    {
      if (!tree[p].IsCluster() && test::IsBelow(tree, p, id))
      {
        const double area = tree.Geometry(p).area;
        views += tree[p].view * tree[p].view / area;
        emissions += area * Mean(tree[p].emission) * Mean(tree[p].emission);
      }
    }
    const double area = tree.Geometry(id).area;
    EXPECT_NEAR(tree[id].viewRms, std::sqrt(views / area), 1e-9);
    EXPECT_NEAR(tree[id].emissionRms, std::sqrt(emissions / area), 1e-5);
  }
}

/// A room with two crates: one covers a quarter of a quarter of the floor, another one half as
/// much.
Scene MakeCoveredFloor()
{
  Scene scene = test::MakeRoom();
  test::AddCrate(scene, Vec2(0.25, 0.25), Vec2(0.5, 0.5), 0.3, 0);
  test::AddCrate(scene, Vec2(0.5, 0.75), Vec2(0.625, 1.0), 0.2, 0);
  return scene;
}

TEST(OpenTree, WhatFurnitureStandsOnIsNotExposed)
{
  const test::Stage stage(MakeCoveredFloor());
  OpenTree tree = stage.MakeOpenTree();
  test::OpenTo(tree, 3);
  const Vec3 up(0.0, 0.0, 1.0);
  const OpenId floor = test::PatchAt(tree, Vec3(0.1, 0.1, 0.0), up);
  ASSERT_NE(floor, None);
  const auto exposed = [&](double x, double y, int level)
  {
    OpenId id = test::LeafAt(tree, floor, Vec3(x, y, 0.0));
    while (tree[id].level > level)
    {
      id = tree[id].parent;
    }
    return tree[id].area / tree.Geometry(id).area;
  };
  // Floor elements of level 2 are a quarter of a side long.
  EXPECT_EQ(exposed(0.3, 0.3, 2), 0.0);
  EXPECT_EQ(exposed(0.3, 0.3, 3), 0.0);
  EXPECT_EQ(exposed(0.1, 0.3, 2), 1.0);
  EXPECT_EQ(exposed(0.3, 0.6, 2), 1.0);
  EXPECT_NEAR(exposed(0.6, 0.8, 2), 0.5, 1.0 / 16.0);
  EXPECT_EQ(exposed(0.55, 0.8, 3), 0.0);
  EXPECT_EQ(exposed(0.7, 0.8, 3), 1.0);
  // 64 points of the floor, 16 of a quarter.
  EXPECT_NEAR(exposed(0.1, 0.1, 0), 29.0 / 32.0, 2.0 / 64.0);
  EXPECT_NEAR(exposed(0.1, 0.1, 1), 0.75, 1.0 / 16.0);

  tree.SumAreas();
  EXPECT_NEAR(exposed(0.1, 0.1, 0), 29.0 / 32.0, 1e-12);
  EXPECT_NEAR(exposed(0.1, 0.1, 1), 0.75, 1e-12);
  EXPECT_NEAR(exposed(0.6, 0.8, 2), 0.5, 1e-12);
}

TEST(OpenTree, AreasOfInnerNodesAreThoseOfTheirChildren)
{
  const test::Stage stage(MakeCoveredFloor());
  OpenTree tree = stage.MakeOpenTree();
  test::OpenTo(tree, 2);
  tree.SumAreas();
  double leaves = 0.0;
  for (OpenId id = 0; id < tree.Size(); ++id)
  {
    leaves += tree[id].IsLeaf() ? tree[id].area : 0.0;
    double sum = 0.0;
    for (OpenId c = tree[id].firstChild;
         !tree[id].IsLeaf() && c < tree[id].firstChild + tree[id].childCount; ++c)
    {
      sum += tree[c].area;
    }
    if (!tree[id].IsLeaf() && sum > 0.0)
    {
      EXPECT_NEAR(tree[id].area, sum, 1e-12) << "node " << id;
    }
  }
  EXPECT_NEAR(tree[0].area, leaves, 1e-12);
}

TEST(OpenTree, NothingEscapesFromAClosedBoxAndFewRaysTellSo)
{
  const test::Stage stage(test::MakeRoom());
  OpenTree tree = stage.MakeOpenTree();
  test::OpenTo(tree, 3);
  for (OpenId id = 0; id < tree.Size(); ++id)
  {
    EXPECT_EQ(tree[id].escaped, 0.0);
    EXPECT_EQ(tree[id].escapeError, 0.0);
    EXPECT_EQ(tree[id].area, tree.Geometry(id).area);
  }
  // 64 rays a patch and a cluster; elements inherit what is the same everywhere.
  EXPECT_EQ(tree.ProbeRays(), (6u + 5u) * 64u);
}

TEST(OpenTree, NothingIsKnownOfClustersOfAnOpenBoxAfterFewRays)
{
  const test::Stage stage(test::MakeOpenBox());
  OpenTree tree = stage.MakeOpenTree();
  EXPECT_TRUE(tree[0].IsUnprobed());
  EXPECT_LT(tree.ProbeRays(), 64u);
  for (OpenId id = 0; id < tree.Size(); ++id)
  {
    if (tree[id].IsCluster())
    {
      EXPECT_TRUE(tree[id].IsUnprobed()) << "node " << id;
      tree.Open(id);
    }
  }
}

TEST(OpenTree, WhatEscapesFromAnOpenBoxIsTheFormFactorOfTheLid)
{
  const test::Stage stage(test::MakeOpenBox());
  OpenTree tree = stage.MakeOpenTree();
  test::OpenTo(tree, 4);
  for (const Vec3& normal :
    { Vec3(0, 0, 1), Vec3(1, 0, 0), Vec3(-1, 0, 0), Vec3(0, 1, 0), Vec3(0, -1, 0) })
  {
    const Vec3 point = 0.5 - 0.5 * normal + (normal.z > 0.0 ? Vec3(0.0) : Vec3(0.0, 0.0, -0.2));
    const OpenId patch = test::PatchAt(tree, point, normal);
    ASSERT_NE(patch, None);
    const double exact = normal.z > 0.0 ? OppositeFactor : SideFactor;
    // The error is said to be two standard deviations.
    EXPECT_NEAR(tree[patch].escaped, exact, 1.5 * tree[patch].escapeError);
    EXPECT_LT(tree[patch].escapeError, 0.15);
    double mean = 0.0;
    double within = 0.0;
    double leaves = 0.0;
    for (const OpenId leaf : test::LeavesOf(tree))
    {
      if (test::IsBelow(tree, leaf, patch))
      {
        mean += tree[leaf].area * tree[leaf].escaped;
        const double factor = PointToPolygon(Centroid(tree.Shape(leaf)), normal,
                                { Vec3(0, 0, 1), Vec3(0, 1, 1), Vec3(1, 1, 1), Vec3(1, 0, 1) }) /
                              Pi;
        within += std::abs(tree[leaf].escaped - factor) <= tree[leaf].escapeError ? 1.0 : 0.0;
        leaves += 1.0;
      }
    }
    // 4096 rays.
    EXPECT_NEAR(mean, exact, 0.025) << normal.x << " " << normal.y << " " << normal.z;
    EXPECT_GT(within / leaves, 0.9);
  }
}

/// Half of what a ball in the open sees is the ground, but for the border of that.
TEST(OpenTree, WhatEscapesFromACurvedSurfaceIsProbedAsOfOthers)
{
  Scene scene;
  scene.materials = { test::MakeMaterial(Color(0.5), Color(0.0), false) };
  scene.AddPolygon({ { -90, -90, 0 }, { 90, -90, 0 }, { 90, 90, 0 }, { -90, 90, 0 } }, 0);
  test::AddBall(scene, { 0.0, 0.0, 1.0 }, 0.5, 8, 0);
  const test::Stage stage(scene);
  OpenTree tree = stage.MakeOpenTree();
  EXPECT_TRUE(tree[0].IsUnprobed());
  OpenId ball = 0;
  for (; !tree.Geometry(ball).IsSmooth() || !tree[ball].IsCluster(); ++ball)
  {
    tree.Open(ball);
  }
  EXPECT_NEAR(tree[ball].escaped, 0.5, 1.5 * tree[ball].escapeError); // two standard deviations
  EXPECT_LT(tree[ball].escapeError, 0.15);
  EXPECT_EQ(tree[ball].area, tree.Geometry(ball).area);
}

TEST(OpenTree, OtherMaterialsChangeOpticsOnly)
{
  const test::Stage stage(MakeCoveredFloor());
  OpenTree tree = stage.MakeOpenTree();
  test::OpenTo(tree, 2);
  tree.SetView(stage.View());
  std::vector<OpenNode> before;
  for (OpenId id = 0; id < tree.Size(); ++id)
  {
    before.push_back(tree[id]);
  }
  std::vector<PatchOptics> optics = stage.optics;
  for (PatchOptics& patch : optics)
  {
    patch = { Color(0.25, 0.5, 0.75), Color(3.0, 2.0, 1.0) };
  }
  tree.SetOptics(optics);
  ASSERT_EQ(tree.Size(), before.size());
  for (OpenId id = 0; id < tree.Size(); ++id)
  {
    EXPECT_NEAR(glm::length(tree[id].albedo - Color(0.25, 0.5, 0.75)), 0.0, 1e-12);
    EXPECT_NEAR(glm::length(tree[id].emission - Color(3.0, 2.0, 1.0)), 0.0, 1e-12);
    EXPECT_EQ(tree[id].area, before[id].area);
    EXPECT_EQ(tree[id].view, before[id].view);
  }
}

} // namespace
} // namespace vantage
