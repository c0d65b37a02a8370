#include "core/mesh/CutSurfaces.h"

#include "core/mesh/MeshScenes.h"
#include "support/TestScenes.h"

#include <gtest/gtest.h>

#include <set>

namespace vantage
{
namespace
{

using test::AddQuad;
using test::Named;

std::size_t SurfaceCount(const Scene& scene)
{
  const FacetSet facets = BuildFacets(scene);
  const std::vector<std::uint32_t> surfaces =
    SurfacesOf(facets, EdgesOf(facets.facets), ElementTree(facets, scene.materials).Patches());
  return std::set<std::uint32_t>(surfaces.begin(), surfaces.end()).size();
}

/// A room of which all walls are cut into n x n pieces.
Scene CutRoom(int n, bool triangles)
{
  return test::CutIntoPieces(test::OneRoom(), n, triangles);
}

Scene Turned(Scene scene)
{
  const Frame frame(glm::normalize(Vec3(0.3, -0.5, 0.8)));
  for (Vec3& vertex : scene.vertices)
  {
    vertex = frame.ToWorld(vertex) + Vec3(7.0, -3.0, 11.0);
  }
  return scene;
}

/// Clusters whose patches are all in one plane, on one side, and of one material.
struct FlatCount
{
  int flat = 0;   ///< that have a shape
  int others = 0; ///< that have none
};

FlatCount CountWithinSurfaces(const ElementTree& tree)
{
  FlatCount count;
  std::vector<Vec3> normals(tree.Size(), Vec3(0.0));
  std::vector<double> offsets(tree.Size(), 0.0);
  for (NodeId id = tree.Size(); id-- > 0;)
  {
    const Node& node = tree[id];
    if (!node.IsCluster())
    {
      normals[id] = tree.PatchOfNode(id).normal;
      offsets[id] = glm::dot(normals[id], node.centre);
      continue;
    }
    const NodeId a = node.firstChild;
    const bool isOnePlane = glm::length(normals[a]) > 0.5 && glm::length(normals[a + 1]) > 0.5 &&
                            glm::length(normals[a] - normals[a + 1]) < 1e-6 &&
                            std::abs(offsets[a] - offsets[a + 1]) < 1e-6;
    if (isOnePlane)
    {
      normals[id] = normals[a];
      offsets[id] = offsets[a];
      ++(node.HasShape() ? count.flat : count.others);
    }
    else
    {
      EXPECT_FALSE(node.HasShape());
    }
  }
  return count;
}

TEST(CutSurfaces, FacetsThatContinueEachOtherAreOneSurface)
{
  for (const int n : { 1, 2, 5 })
  {
    EXPECT_EQ(SurfaceCount(CutRoom(n, false)), 6u) << n;
    EXPECT_EQ(SurfaceCount(CutRoom(n, true)), 6u) << n;
    EXPECT_EQ(SurfaceCount(Turned(CutRoom(n, true))), 6u) << n;
  }
}

TEST(CutSurfaces, EdgeCreaseMaterialAndFrontPartThem)
{
  Scene scene;
  scene.materials = { Named("a"), Named("b") };
  AddQuad(scene, { 0, 0, 0 }, { 1, 0, 0 }, { 0, 1, 0 }, 0);
  AddQuad(scene, { 1, 0, 0 }, { 1, 0, 0 }, { 0, 1, 0 }, 0); // continues it
  EXPECT_EQ(SurfaceCount(scene), 1u);
  AddQuad(scene, { 0, 1, 0 }, { 1, 0, 0 }, { 0, 1, 0 }, 1); // looks different
  EXPECT_EQ(SurfaceCount(scene), 2u);
  AddQuad(scene, { 2, 0, 0 }, { 0, 1, 0 }, { 1, 0, 0 }, 0); // shows its back
  EXPECT_EQ(SurfaceCount(scene), 3u);
  AddQuad(scene, { 0, 0, 0 }, { 0, -1, 1e-3 }, { 1, 0, 0 }, 0); // is bent
  EXPECT_EQ(SurfaceCount(scene), 4u);
  AddQuad(scene, { 2, 1, 0 }, { 1, 0, 0 }, { 0, 1, 0 }, 0); // meets the others at corners only
  EXPECT_EQ(SurfaceCount(scene), 5u);
}

TEST(CutSurfaces, EveryClusterOfAWallThatWasCutIsARectangleAgain)
{
  for (const int n : { 4, 5, 7, 16, 25 })
  {
    for (const bool triangles : { false, true })
    {
      for (const Scene& scene : { CutRoom(n, triangles), Turned(CutRoom(n, triangles)) })
      {
        SCOPED_TRACE(testing::Message() << n << (triangles ? " triangles" : " quadrilaterals"));
        const ElementTree tree(BuildFacets(scene), scene.materials);
        const FlatCount count = CountWithinSurfaces(tree);
        // Both sides of six walls: a tree of n n (or 2 n n) patches has one cluster less.
        EXPECT_EQ(count.flat, 12 * ((triangles ? 2 : 1) * n * n - 1));
        EXPECT_EQ(count.others, 0);
      }
    }
  }
}

TEST(CutSurfaces, AShapeHasTheAreaAndTheFrontOfItsPatches)
{
  const Scene scene = Turned(CutRoom(6, true));
  const ElementTree tree(BuildFacets(scene), scene.materials);
  int shapes = 0;
  for (NodeId id = 0; id < tree.Size(); ++id)
  {
    const Node& node = tree[id];
    if (node.IsCluster() && node.HasShape())
    {
      ++shapes;
      const double below = tree[node.firstChild].area + tree[node.firstChild + 1].area;
      EXPECT_NEAR(node.area, below, 1e-12 * below); // round-off
      NodeId leaf = id;
      while (tree[leaf].IsCluster())
      {
        leaf = tree[leaf].firstChild;
      }
      EXPECT_NEAR(glm::dot(UnitNormal(node.Shape()), tree.PatchOfNode(leaf).normal), 1.0, 1e-12);
    }
  }
  EXPECT_GT(shapes, 0);
}

TEST(CutSurfaces, AHoleOrAnLLeavesClustersAboveTheirRectangles)
{
  Scene scene;
  scene.materials = { Named("floor") };
  for (int i = 0; i < 8 * 8; ++i)
  {
    const int x = i % 8;
    const int y = i / 8;
    const bool isHole = x >= 5 && y >= 5;
    if (!isHole)
    {
      AddQuad(scene, { x, y, 0 }, { 1, 0, 0 }, { 0, 1, 0 });
    }
  }
  const ElementTree tree(BuildFacets(scene), scene.materials, Sides::FrontOnly);
  EXPECT_FALSE(tree[tree.Root()].HasShape());
  const FlatCount count = CountWithinSurfaces(tree);
  EXPECT_GT(count.flat, 40); // of 54 clusters
  EXPECT_LT(count.others, 14);
}

TEST(CutSurfaces, PolygonsThatNobodyCutStayAsTheyAre)
{
  const Scene scene = test::RoomGrid(6, 6);
  const ElementTree tree(BuildFacets(scene), scene.materials);
  // Neighbouring floors lie in one plane, but a wall stands between them.
  for (NodeId id = 0; id < tree.Size(); ++id)
  {
    EXPECT_EQ(tree[id].HasShape(), !tree[id].IsCluster());
  }
}

} // namespace
} // namespace vantage
