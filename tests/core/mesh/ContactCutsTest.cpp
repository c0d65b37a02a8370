#include "core/mesh/ContactCuts.h"

#include "core/math/Sampling.h"
#include "support/TestScenes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace vantage
{
namespace
{

Facet MakeFacet(const Polygon& shape, std::uint32_t polygon)
{
  Facet facet;
  facet.shape = TriangleOrQuadrilateral(shape);
  facet.scenePolygon = polygon;
  facet.material = polygon + 10;
  return facet;
}

/// 4 x 2 on the ground, facing up.
Facet Floor()
{
  return MakeFacet({ Vec3(0, 0, 0), Vec3(4, 0, 0), Vec3(4, 2, 0), Vec3(0, 2, 0) }, 0);
}

/// Upright above y = from .. to at x, from a height on.
Facet Wall(double x, double from, double to, double bottom = 0.0)
{
  return MakeFacet(
    { Vec3(x, from, bottom), Vec3(x, to, bottom), Vec3(x, to, 1), Vec3(x, from, 1) }, 1);
}

FacetSet SetOf(const std::vector<Facet>& facets)
{
  FacetSet set;
  set.facets = facets;
  set.low = set.high = facets[0].shape[0];
  for (const Facet& facet : facets)
  {
    for (const Vec3& corner : facet.shape)
    {
      set.low = glm::min(set.low, corner);
      set.high = glm::max(set.high, corner);
    }
  }
  return set;
}

std::vector<Facet> PiecesOfFloor(std::vector<Facet> others)
{
  others.insert(others.begin(), Floor());
  std::vector<Facet> pieces = CutAtContacts(SetOf(others)).facets;
  pieces.erase(std::remove_if(pieces.begin(), pieces.end(),
                 [](const Facet& facet) { return facet.scenePolygon != 0; }),
    pieces.end());
  return pieces;
}

double AreaOf(const std::vector<Facet>& facets)
{
  double area = 0.0;
  for (const Facet& facet : facets)
  {
    area += Area(facet.shape);
  }
  return area;
}

TEST(ContactCuts, AWallCutsTheFloorBelowIt)
{
  const std::vector<Facet> pieces = PiecesOfFloor({ Wall(1.3, 0.0, 2.0) });
  ASSERT_EQ(pieces.size(), 2u);
  EXPECT_NEAR(AreaOf(pieces), 8.0, 1e-12);
  for (const Facet& piece : pieces)
  {
    EXPECT_EQ(piece.material, 10u);
    EXPECT_NEAR(UnitNormal(piece.shape).z, 1.0, 1e-12);
    const bool isLeft = Centroid(piece.shape).x < 1.3;
    for (const Vec3& corner : piece.shape)
    {
      EXPECT_TRUE(isLeft ? corner.x <= 1.3 + 1e-9 : corner.x >= 1.3 - 1e-9);
    }
  }
}

TEST(ContactCuts, SoDoesOneWithADoorOrOneThatPassesThrough)
{
  EXPECT_EQ(PiecesOfFloor({ Wall(2.5, 0.0, 0.9), Wall(2.5, 1.2, 2.0) }).size(), 2u);
  EXPECT_EQ(PiecesOfFloor({ Wall(2.5, -1.0, 3.0, -0.5) }).size(), 2u);
  // Two walls, and one across the piece between them, whose line goes on through the others.
  EXPECT_EQ(PiecesOfFloor({ Wall(1.0, 0.0, 2.0), Wall(3.0, 0.0, 2.0) }).size(), 3u);
  const Facet across =
    MakeFacet({ Vec3(1, 0.7, 0), Vec3(3, 0.7, 0), Vec3(3, 0.7, 1), Vec3(1, 0.7, 1) }, 1);
  EXPECT_EQ(PiecesOfFloor({ Wall(1.0, 0.0, 2.0), Wall(3.0, 0.0, 2.0), across }).size(), 6u);
}

TEST(ContactCuts, FurnitureBordersAndWhatHangsAboveDoNot)
{
  EXPECT_EQ(PiecesOfFloor({ Wall(1.3, 0.4, 1.4) }).size(), 1u);
  EXPECT_EQ(PiecesOfFloor({ Wall(0.0, 0.0, 2.0), Wall(4.0, 0.0, 2.0) }).size(), 1u);
  EXPECT_EQ(PiecesOfFloor({ Wall(1.3, 0.0, 2.0, 0.01) }).size(), 1u);
  Facet carpet = Floor();
  carpet.scenePolygon = 1;
  EXPECT_EQ(PiecesOfFloor({ carpet }).size(), 1u);
}

TEST(ContactCuts, PiecesKeepThePlaceOfAnyFacetInAnyPosition)
{
  for (std::uint64_t seed = 0; seed < 50; ++seed)
  {
    SCOPED_TRACE("seed " + std::to_string(seed));
    RandomStream random(seed);
    const Frame turn(glm::normalize(Vec3(random.Next(), random.Next(), 0.1 + random.Next())));
    const double scale = std::pow(10.0, 6.0 * random.Next() - 3.0);
    const double distance = scale * (seed % 2 == 0 ? 1e2 : 1e8);
    const Vec3 shift = distance * Vec3(random.Next(), random.Next(), random.Next());
    std::vector<Facet> facets{ Floor(), Wall(0.5 + random.Next(), 0.0, 2.0),
      Wall(2.0 + random.Next(), 0.0, 2.0) };
    for (Facet& facet : facets)
    {
      for (int i = 0; i < facet.shape.Size(); ++i)
      {
        facet.shape[i] = shift + scale * turn.ToWorld(facet.shape[i]);
      }
    }
    const std::vector<Facet> pieces = CutAtContacts(SetOf(facets)).facets;
    EXPECT_EQ(pieces.size(), 5u);
    // The corners are rounded where they are.
    EXPECT_NEAR(AreaOf(pieces) / AreaOf(facets), 1.0, 1e-9 + 1e-15 * distance / scale);
  }
}

TEST(ContactCuts, TheMeanAreaFollows)
{
  Scene scene;
  scene.materials = { test::MakeMaterial(Color(0.5)) };
  test::AddBox(scene, Vec3(0.0), Vec3(4.0, 2.0, 1.0), true, { 0, 0, 0, 0, 0, 0 });
  scene.AddPolygon({ Vec3(1.3, 0, 0), Vec3(1.3, 2, 0), Vec3(1.3, 2, 1), Vec3(1.3, 0, 1) }, 0);
  const FacetSet set = CutAtContacts(BuildFacets(scene));
  // Floor, ceiling and the two long walls are cut.
  ASSERT_EQ(set.facets.size(), 7u + 4u);
  EXPECT_NEAR(set.meanArea, AreaOf(set.facets) / 11.0, 1e-12);
}

} // namespace
} // namespace vantage
