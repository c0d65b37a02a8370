#include "core/mesh/Facets.h"

#include "core/Error.h"
#include "core/mesh/MeshScenes.h"

#include <gtest/gtest.h>

namespace vantage
{
namespace
{

using test::AddQuad;
using test::AddRoom;
using test::Named;

Scene Empty()
{
  Scene scene;
  scene.materials = { Named("a"), Named("b"), Named("c", false) };
  return scene;
}

FacetSet FacetsOf(const std::vector<Vec3>& polygon)
{
  Scene scene = Empty();
  scene.AddPolygon(polygon, 0);
  return BuildFacets(scene);
}

double TotalArea(const FacetSet& facets)
{
  double area = 0.0;
  for (const Facet& facet : facets.facets)
  {
    area += Area(facet.shape);
  }
  return area;
}

Vec3 AreaNormalOf(const std::vector<Vec3>& polygon)
{
  Vec3 sum(0.0);
  for (std::size_t i = 2; i < polygon.size(); ++i)
  {
    sum += 0.5 * glm::cross(polygon[i - 1] - polygon[0], polygon[i] - polygon[0]);
  }
  return sum;
}

std::vector<Vec3> Corners(const Polygon& shape)
{
  return { shape.begin(), shape.end() };
}

TEST(Facets, KeepTrianglesAndConvexQuadrilateralsAsTheyAre)
{
  const std::vector<Vec3> triangle{ { 3, 0, 1 }, { 0, 2, 0 }, { 0, 0, 0 } };
  const std::vector<Vec3> kite{ { 0, 0, 0 }, { 2, -0.5, 0 }, { 3, 0, 0 }, { 2, 0.5, 0 } };
  for (const std::vector<Vec3>& polygon : { triangle, kite })
  {
    const FacetSet facets = FacetsOf(polygon);
    ASSERT_EQ(facets.facets.size(), 1u);
    EXPECT_EQ(Corners(facets.facets[0].shape), polygon);
    EXPECT_EQ(facets.facets[0].backPolygon, None);
  }
}

TEST(Facets, ReportBoundingBoxAndMeanArea)
{
  Scene scene = Empty();
  AddRoom(scene, { 1, 2, 3 }, { 4, 3, 2 });
  scene.vertices.emplace_back(100, 100, 100); // not used, so it must not count
  const FacetSet facets = BuildFacets(scene);
  EXPECT_EQ(facets.low, Vec3(1, 2, 3));
  EXPECT_EQ(facets.high, Vec3(5, 5, 5));
  EXPECT_DOUBLE_EQ(facets.meanArea, 2.0 * (12.0 + 6.0 + 8.0) / 6.0);
}

TEST(Facets, ConcaveShapeKeepsItsAreaAndFront)
{
  const FacetSet facets =
    FacetsOf({ { 0, 0, 1 }, { 2, 0, 1 }, { 2, 1, 1 }, { 1, 1, 1 }, { 1, 2, 1 }, { 0, 2, 1 } });
  EXPECT_EQ(facets.report.concavePolygons, 1u);
  EXPECT_EQ(facets.facets.size(), 4u);
  EXPECT_DOUBLE_EQ(TotalArea(facets), 3.0);
  for (const Facet& facet : facets.facets)
  {
    EXPECT_EQ(UnitNormal(facet.shape), Vec3(0, 0, 1));
  }
}

TEST(Facets, RandomPolygonsKeepTheirAreaAndFront)
{
  for (std::uint64_t seed = 0; seed < 300; ++seed)
  {
    SCOPED_TRACE(seed);
    RandomStream random(seed);
    const int n = 3 + static_cast<int>(20 * random.Next());
    const double leastRadius = seed % 2 == 0 ? 0.3 : 1.0; // concave, convex
    const std::vector<Vec3> polygon = test::RandomStar(random, n, leastRadius);
    const Vec3 areaNormal = AreaNormalOf(polygon);
    const FacetSet facets = FacetsOf(polygon);
    // Round-off of coordinates of size 10 against a polygon of size 1.
    EXPECT_NEAR(TotalArea(facets), glm::length(areaNormal), 1e-12);
    for (const Facet& facet : facets.facets)
    {
      EXPECT_GT(glm::dot(UnitNormal(facet.shape), glm::normalize(areaNormal)), 1.0 - 1e-6);
      for (const Vec3& corner : facet.shape)
      {
        EXPECT_NE(std::find(polygon.begin(), polygon.end(), corner), polygon.end());
      }
    }
    const FacetReport& report = facets.report;
    EXPECT_EQ(report.nonPlanarPolygons + report.degeneratePolygons, 0u);
    EXPECT_TRUE(leastRadius < 1.0 || report.largePolygons == (n > 4 ? 1u : 0u));
    EXPECT_EQ(
      facets.facets.size(), report.concavePolygons + report.largePolygons > 0 ? n - 2u : 1u);
  }
}

TEST(Facets, NonPlanarQuadrilateralBecomesTwoTriangles)
{
  const FacetSet facets = FacetsOf({ { 0, 0, 0 }, { 1, 0, 0 }, { 1, 1, 0.1 }, { 0, 1, 0 } });
  EXPECT_EQ(facets.report.nonPlanarPolygons, 1u);
  EXPECT_EQ(facets.facets.size(), 2u);
}

TEST(Facets, SinglePrecisionStaysFlat)
{
  for (std::uint64_t seed = 0; seed < 100; ++seed)
  {
    SCOPED_TRACE(seed);
    RandomStream random(seed);
    std::vector<Vec3> square = test::RandomStar(random, 4, 1.0);
    square.insert(square.begin() + 2, 0.25 * square[1] + 0.75 * square[2]); // a T-vertex
    for (Vec3& corner : square)
    {
      for (int k = 0; k < 3; ++k)
      {
        corner[k] = static_cast<float>(corner[k]);
      }
    }
    const FacetSet facets = FacetsOf(square);
    ASSERT_EQ(facets.facets.size(), 1u);
    EXPECT_EQ(facets.facets[0].shape.Size(), 4);
  }
}

TEST(Facets, RepeatedCollinearAndFoldedBackCornersAreRemoved)
{
  const std::vector<Vec3> square{ { 0, 0, 0 }, { 2, 0, 0 }, { 2, 2, 0 }, { 0, 2, 0 } };
  const std::vector<std::vector<Vec3>> variants{
    { { 0, 0, 0 }, { 0, 0, 0 }, { 2, 0, 0 }, { 2, 2, 0 }, { 0, 2, 0 }, { 0, 0, 0 } },
    { { 0, 0, 0 }, { 1, 0, 0 }, { 1.5, 0, 0 }, { 2, 0, 0 }, { 2, 2, 0 }, { 0, 2, 0 }, { 0, 1, 0 } },
    { { 0, 0, 0 }, { 2, 0, 0 }, { 2, 3, 0 }, { 2, 2, 0 }, { 0, 2, 0 } },
    { { 0, 0, 0 }, { 2, 0, 0 }, { 2, 2, 0 }, { 5, 5, 0 }, { 2, 2, 0 }, { 0, 2, 0 } },
  };
  for (const std::vector<Vec3>& variant : variants)
  {
    const FacetSet facets = FacetsOf(variant);
    ASSERT_EQ(facets.facets.size(), 1u);
    EXPECT_EQ(Corners(facets.facets[0].shape), square);
    EXPECT_EQ(facets.report.largePolygons, 0u);
  }
}

TEST(Facets, NearlyTriangularQuadrilateralLosesItsFlatCorner)
{
  EXPECT_EQ(
    FacetsOf({ { 0, 0, 0 }, { 1, -1e-7, 0 }, { 2, 0, 0 }, { 0, 2, 0 } }).facets[0].shape.Size(), 3);
  EXPECT_EQ(
    FacetsOf({ { 0, 0, 0 }, { 1, -1e-4, 0 }, { 2, 0, 0 }, { 0, 2, 0 } }).facets[0].shape.Size(), 4);
}

TEST(Facets, WhatHasNoAreaIsDroppedAndCounted)
{
  Scene scene = Empty();
  AddQuad(scene, { 0, 0, 0 }, { 1, 0, 0 }, { 0, 1, 0 });
  scene.AddPolygon({ { 0, 0, 0 }, { 1, 0, 0 }, { 1, 0, 0 } }, 0);                    // two corners
  scene.AddPolygon({ { 0, 0, 0 }, { 1, 0, 0 }, { 3, 0, 0 } }, 0);                    // a line
  scene.AddPolygon({ { 0, 0, 1 }, { 1, 0, 1 }, { 1, 1e-9, 1 } }, 0);                 // a sliver
  scene.AddPolygon({ { 0, 0, 1 }, { 1, 0, 1 }, { 1, 1e-8, 1 }, { 0, 1e-8, 1 } }, 0); // a strip
  scene.AddPolygon({ { 0, 0, 0 }, { 1, 1, 0 }, { 1, 0, 0 }, { 0, 1, 0 } }, 0);       // a bow tie
  const FacetSet facets = BuildFacets(scene);
  EXPECT_EQ(facets.facets.size(), 1u);
  EXPECT_EQ(facets.report.degeneratePolygons, 5u);
  EXPECT_DOUBLE_EQ(facets.meanArea, 1.0);
}

TEST(Facets, ThinStripsStay)
{
  const FacetSet facets = FacetsOf({ { 0, 0, 0 }, { 10, 0, 0 }, { 10, 1e-4, 0 }, { 0, 1e-4, 0 } });
  EXPECT_EQ(facets.facets[0].shape.Size(), 4);
}

TEST(Facets, SceneWithoutAreaIsAnError)
{
  EXPECT_THROW(FacetsOf({ { 0, 0, 0 }, { 1, 0, 0 }, { 2, 0, 0 } }), InputError);
  EXPECT_THROW(BuildFacets(Empty()), InputError);
}

TEST(Facets, ScenesWithoutMeasurableAreasAreAnError)
{
  for (const double size : { 5e-324, 1e-160, 1e-71, 1e76, 1e160, 1e308 })
  {
    EXPECT_THROW(FacetsOf({ { 0, 0, 0 }, { size, 0, 0 }, { size, size, 0 } }), InputError) << size;
  }
  for (const double size : { 1e-69, 1e74 })
  {
    const FacetSet set = FacetsOf({ { 0, 0, 0 }, { size, 0, 0 }, { size, size, 0 } });
    EXPECT_NEAR(set.meanArea / (0.5 * size * size), 1.0, 1e-15) << size; // round-off
  }
}

TEST(Facets, WeldToleranceOutOfRangeIsAnError)
{
  const Scene scene = test::OneRoom();
  for (const double tolerance : { -1e-9, 0.2, std::nan("") })
  {
    EXPECT_THROW(BuildFacets(scene, tolerance), InputError) << tolerance;
  }
  EXPECT_EQ(BuildFacets(scene, 0.0).facets.size(), 6u);
}

TEST(Facets, WeldingIsRelativeToTheScene)
{
  for (const double scale : { 1e-3, 1.0, 1e6 })
  {
    SCOPED_TRACE(scale);
    Scene scene = Empty();
    AddQuad(scene, { 0, 0, 0 }, { 1, 0, 0 }, { 0, 1, 0 });
    AddQuad(scene, { 1.0 + 1e-10, 0, 0 }, { 1, 0, 0 }, { 0, 1, 0 });
    for (Vec3& vertex : scene.vertices)
    {
      vertex *= scale;
    }
    const FacetSet facets = BuildFacets(scene);
    EXPECT_EQ(facets.report.weldedVertices, 2u);
    ASSERT_EQ(facets.facets.size(), 2u);
    const bool isFirst = facets.facets[0].scenePolygon == 0;
    const Polygon& left = facets.facets[isFirst ? 0 : 1].shape;
    const Polygon& right = facets.facets[isFirst ? 1 : 0].shape;
    EXPECT_EQ(left[1], right[0]);
    EXPECT_EQ(left[2], right[3]);
  }
}

TEST(Facets, RepeatedPolygonLeavesTheLowestMaterial)
{
  Scene scene = Empty();
  scene.AddPolygon({ { 0, 0, 0 }, { 1, 0, 0 }, { 1, 1, 0 }, { 0, 1, 0 } }, 1);
  scene.AddPolygon({ { 1, 1, 0 }, { 0, 1, 0 }, { 0, 0, 0 }, { 1, 0, 0 } }, 0);
  const FacetSet facets = BuildFacets(scene);
  ASSERT_EQ(facets.facets.size(), 1u);
  EXPECT_EQ(facets.report.duplicateFacets, 1u);
  EXPECT_EQ(facets.facets[0].material, 0u);
  EXPECT_EQ(facets.facets[0].scenePolygon, 1u);
}

TEST(Facets, PolygonsBackToBackBecomeOneWithTwoFronts)
{
  for (const bool isSwapped : { false, true })
  {
    const std::vector<Vec3> up{ { 0, 0, 0 }, { 1, 0, 0 }, { 1, 1, 0 }, { 0, 1, 0 } };
    const std::vector<Vec3> down{ { 1, 1, 0 }, { 1, 0, 0 }, { 0, 0, 0 }, { 0, 1, 0 } };
    Scene scene = Empty();
    scene.AddPolygon(isSwapped ? down : up, isSwapped ? 2 : 1);
    scene.AddPolygon(isSwapped ? up : down, isSwapped ? 1 : 2);
    const FacetSet facets = BuildFacets(scene);
    ASSERT_EQ(facets.facets.size(), 1u);
    EXPECT_EQ(facets.report.mergedFacets, 1u);
    const Facet& facet = facets.facets[0];
    const Side upper = UnitNormal(facet.shape).z > 0.0 ? Side::Front : Side::Back;
    const Side lower = upper == Side::Front ? Side::Back : Side::Front;
    EXPECT_EQ(facet.MaterialOf(upper), 1u);
    EXPECT_EQ(facet.MaterialOf(lower), 2u);
    EXPECT_EQ(facet.ScenePolygonOf(upper), isSwapped ? 1u : 0u);
    EXPECT_EQ(facet.ScenePolygonOf(lower), isSwapped ? 0u : 1u);
    EXPECT_TRUE(facet.IsPolygonFront(Side::Front) && facet.IsPolygonFront(Side::Back));
  }
}

TEST(Facets, NegativeZeroIsZero)
{
  Scene scene = Empty();
  scene.AddPolygon({ { -0.0, 0.0, -0.0 }, { 1, -0.0, 0 }, { 0, 1, 0 } }, 0);
  scene.AddPolygon({ { 0.0, -0.0, 0.0 }, { -1, 0.0, 0 }, { -0.0, -1, 0 } }, 0);
  const FacetSet facets = BuildFacets(scene);
  for (const Facet& facet : facets.facets)
  {
    for (const Vec3& corner : facet.shape)
    {
      for (int k = 0; k < 3; ++k)
      {
        EXPECT_FALSE(corner[k] == 0.0 && std::signbit(corner[k]));
      }
    }
  }
  EXPECT_FALSE(std::signbit(facets.low.z) || std::signbit(facets.high.z));
}

/// A polygon and its back, started at another corner: all facets are merged.
void ExpectAllMerged(std::vector<Vec3> polygon, int start)
{
  Scene scene = Empty();
  scene.AddPolygon(polygon, 0);
  std::reverse(polygon.begin(), polygon.end());
  std::rotate(polygon.begin(), polygon.begin() + start, polygon.end());
  scene.AddPolygon(polygon, 1);
  const FacetSet facets = BuildFacets(scene);
  EXPECT_EQ(facets.facets.size(), polygon.size() - 2);
  EXPECT_EQ(facets.report.mergedFacets, polygon.size() - 2);
}

TEST(Facets, TriangulatedWallsBackToBackLeaveNoCoincidentFacets)
{
  for (std::uint64_t seed = 0; seed < 50; ++seed)
  {
    SCOPED_TRACE(seed);
    RandomStream random(seed);
    ExpectAllMerged(test::RandomStar(random, 12, 0.3), 5);
  }
  // Symmetric shapes, where several ears are equally good.
  const std::vector<Vec3> cross{ { 1, 0, 0 }, { 2, 0, 0 }, { 2, 1, 0 }, { 3, 1, 0 }, { 3, 2, 0 },
    { 2, 2, 0 }, { 2, 3, 0 }, { 1, 3, 0 }, { 1, 2, 0 }, { 0, 2, 0 }, { 0, 1, 0 }, { 1, 1, 0 } };
  const std::vector<Vec3> hexagon{ { 2, 0, 0 }, { 3, 0, 0 }, { 4, 2, 0 }, { 3, 4, 0 }, { 2, 4, 0 },
    { 1, 2, 0 } };
  for (int start = 0; start < 6; ++start)
  {
    SCOPED_TRACE(start);
    ExpectAllMerged(cross, start);
    ExpectAllMerged(hexagon, start);
  }
}

/// Rooms that share walls, random polygons, T-vertices, repeated polygons, walls back to back.
Scene MixedScene(RandomStream& random)
{
  Scene scene = test::RoomGrid(3, 2);
  scene.materials = Empty().materials;
  AddQuad(scene, { 1, 1, 1 }, { -1, 0, 0 }, { 0, -1, 0 }, 1);
  AddQuad(scene, { 0, 0, 0 }, { 1, 0, 0 }, { 0, 1, 0 }, 2);
  scene.AddPolygon({ { 2, 0, 0 }, { 2, 0, 1 }, { 2, 0.5, 1 }, { 2, 1, 1 }, { 2, 1, 0 } }, 1);
  for (int i = 0; i < 30; ++i)
  {
    scene.AddPolygon(test::RandomStar(random, 3 + i % 10, 0.3), i % 3);
  }
  for (Vec3& vertex : scene.vertices)
  {
    vertex += 1e-9 * Vec3(random.Next(), random.Next(), random.Next());
  }
  return scene;
}

TEST(Facets, ShuffledScenesGiveTheSameFacetsToTheBit)
{
  for (std::uint64_t seed = 0; seed < 20; ++seed)
  {
    SCOPED_TRACE(seed);
    RandomStream random(seed);
    const Scene scene = MixedScene(random);
    const FacetSet expected = BuildFacets(scene);
    EXPECT_GT(expected.report.weldedVertices, 0u);
    EXPECT_GT(expected.report.mergedFacets, 0u);
    EXPECT_GT(expected.report.duplicateFacets, 0u);
    const Scene shuffledScene = test::Shuffled(scene, random);
    const FacetSet shuffled = BuildFacets(shuffledScene);
    EXPECT_EQ(shuffled.low, expected.low);
    EXPECT_EQ(shuffled.high, expected.high);
    EXPECT_EQ(shuffled.meanArea, expected.meanArea);
    EXPECT_EQ(shuffled.report.weldedVertices, expected.report.weldedVertices);
    ASSERT_EQ(shuffled.facets.size(), expected.facets.size());
    for (std::size_t f = 0; f < expected.facets.size(); ++f)
    {
      const Facet& a = expected.facets[f];
      const Facet& b = shuffled.facets[f];
      ASSERT_EQ(Corners(a.shape), Corners(b.shape)) << f;
      ASSERT_EQ(a.material, b.material);
      ASSERT_EQ(a.backMaterial, b.backMaterial);
      ASSERT_EQ(shuffledScene.materialOfPolygon[b.scenePolygon], b.material);
    }
  }
}

} // namespace
} // namespace vantage
