#include "core/mesh/CurvedSurfaces.h"

#include "core/mesh/MeshScenes.h"
#include "support/TestScenes.h"

#include <gtest/gtest.h>

#include <map>

namespace vantage
{
namespace
{

/// How many patches each surface has, ascending.
std::vector<int> SizesOfSurfaces(const Scene& scene)
{
  const FacetSet facets = BuildFacets(scene);
  const ElementTree tree(facets, scene.materials);
  return test::SizesOf(CurvedSurfacesOf(facets, EdgesOf(facets.facets), tree.Patches()));
}

using Sizes = std::vector<int>;

Scene OneBall(int rings)
{
  Scene scene;
  scene.materials = { test::Named("ball"), test::Named("other") };
  test::AddBall(scene, { 1.0, 2.0, 3.0 }, 0.5, rings, 0);
  return scene;
}

TEST(CurvedSurfaces, ABallHasTwo)
{
  EXPECT_EQ(SizesOfSurfaces(OneBall(16)), Sizes({ 960, 960 }));
}

/// Of six rings, neighbours turn by 30 degrees, of four by 45.
TEST(CurvedSurfaces, EdgesPartThem)
{
  EXPECT_EQ(SizesOfSurfaces(OneBall(6)).size(), 2u);
  EXPECT_EQ(SizesOfSurfaces(OneBall(4)).size(), 2 * (2 * 8 + 2u)); // the poles are smooth
  EXPECT_EQ(SizesOfSurfaces(test::OneRoom()), Sizes({ 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1 }));
}

TEST(CurvedSurfaces, ACutPlaneIsOne)
{
  Scene scene = test::CutIntoPieces(test::OneRoom(), 3);
  EXPECT_EQ(SizesOfSurfaces(scene), Sizes({ 9, 9, 9, 9, 9, 9, 9, 9, 9, 9, 9, 9 }));
}

TEST(CurvedSurfaces, MaterialsPartThem)
{
  Scene scene = OneBall(16);
  std::fill(scene.materialOfPolygon.begin(), scene.materialOfPolygon.begin() + 480, 1u);
  EXPECT_EQ(SizesOfSurfaces(scene), Sizes({ 480, 480, 480, 480 }));
}

TEST(CurvedSurfaces, FacetsMayBeTurnedOver)
{
  RandomStream random(9);
  Scene scene = OneBall(16);
  for (std::size_t p = 0; p < scene.PolygonCount(); ++p)
  {
    if (random.Next() < 0.5)
    {
      std::reverse(
        scene.indices.begin() + scene.offsets[p], scene.indices.begin() + scene.offsets[p + 1]);
    }
  }
  EXPECT_EQ(SizesOfSurfaces(scene), Sizes({ 960, 960 }));
}

/// A wall that stands on a floor parts what is left and right of it.
TEST(CurvedSurfaces, AThirdFacetAtTheEdgePartsThem)
{
  Scene scene;
  scene.materials = { test::Named("m") };
  test::AddQuad(scene, { 0, 0, 0 }, { 1, 0, 0 }, { 0, 1, 0 });
  test::AddQuad(scene, { 1, 0, 0 }, { 1, 0, 0 }, { 0, 1, 0 });
  EXPECT_EQ(SizesOfSurfaces(scene), Sizes({ 2, 2 }));
  test::AddQuad(scene, { 1, 0, 0 }, { 0, 1, 0 }, { 0, 0, 1 });
  EXPECT_EQ(SizesOfSurfaces(scene), Sizes({ 1, 1, 1, 1, 1, 1 }));
}

/// Of each cluster, from its patches. Two balls and the room around them are told apart, and of
/// each ball both sides, before anything else is.
TEST(CurvedSurfaces, ClustersKnowTheirBend)
{
  Scene scene = OneBall(16);
  test::AddBall(scene, { 1.2, 2.9, 3.0 }, 0.4, 16, 1);
  test::AddRoom(scene, { 0, 0, 2 }, { 4, 4, 3 });
  const FacetSet facets = BuildFacets(scene);
  const ElementTree tree(facets, scene.materials);
  const std::vector<PatchId> surfaceOf =
    CurvedSurfacesOf(facets, EdgesOf(facets.facets), tree.Patches());
  struct Below
  {
    Vec3 areaNormal{ 0.0 };
    std::map<PatchId, int> patches; ///< of each surface
  };
  std::vector<Below> below(tree.Size());
  int wholeBalls = 0;
  for (NodeId id = tree.Size(); id-- > 0;)
  {
    const Node& node = tree[id];
    if (!node.IsCluster())
    {
      below[id] = { node.area * tree.Patches()[node.patch].normal,
        { { surfaceOf[node.patch], 1 } } };
      EXPECT_EQ(node.Bend(), 0.0);
      continue;
    }
    for (NodeId child = node.firstChild; child < node.firstChild + 2; ++child)
    {
      below[id].areaNormal += below[child].areaNormal;
      for (const auto& [surface, count] : below[child].patches)
      {
        below[id].patches[surface] += count;
      }
    }
    const bool isOne = below[id].patches.size() == 1;
    const double mean = glm::length(below[id].areaNormal) / node.area;
    const double sine = std::sqrt(std::max(0.0, 1.0 - mean * mean));
    const double bend = isOne ? std::min(sine, 254.0 / 255.0) : 1.0;
    ASSERT_EQ(node.IsSmooth(), isOne) << id;
    ASSERT_GE(node.Bend(), bend - 2e-6) << id; // round-off of the sum
    ASSERT_LT(node.Bend(), bend + 1.0 / 255.0) << id;
    wholeBalls += isOne && below[id].patches.begin()->second == 960 ? 1 : 0;
  }
  EXPECT_EQ(wholeBalls, 4);
}

} // namespace
} // namespace vantage
