#include "core/mesh/Shells.h"

#include "core/mesh/MeshScenes.h"

#include <gtest/gtest.h>

namespace vantage
{
namespace
{

/// How many sides each shell has, ascending.
std::vector<int> SizesOfShells(const Scene& scene)
{
  const FacetSet facets = BuildFacets(scene);
  return test::SizesOf(ShellsOf(facets, EdgesOf(facets.facets)));
}

using Sizes = std::vector<int>;

TEST(Shells, ARoomHasAnInsideAndAnOutside)
{
  EXPECT_EQ(SizesOfShells(test::OneRoom()), Sizes({ 6, 6 }));
}

TEST(Shells, TheWayLeadsAroundABorder)
{
  Scene sheet;
  sheet.materials = { test::Named("m") };
  test::AddQuad(sheet, { 0, 0, 0 }, { 1, 0, 0 }, { 0, 1, 0 });
  EXPECT_EQ(SizesOfShells(sheet), Sizes({ 2 }));
  Scene open = test::OneRoom();
  open.offsets.pop_back(); // the last wall
  open.materialOfPolygon.pop_back();
  open.indices.resize(open.offsets.back());
  EXPECT_EQ(SizesOfShells(open), Sizes({ 10 }));
}

/// Up to four facets meet in an edge: who comes from a wall goes on to the next facet of his room.
TEST(Shells, RoomsThatShareWallsAreToldApart)
{
  EXPECT_EQ(SizesOfShells(test::RoomGrid(2, 1)), Sizes({ 6, 6, 10 }));
  EXPECT_EQ(SizesOfShells(test::RoomGrid(2, 2)), Sizes({ 6, 6, 6, 6, 16 }));
}

/// A wall that stands free in a room is part of its inside, with both its sides.
TEST(Shells, AFinBelongsToWhatItStandsIn)
{
  Scene scene;
  scene.materials = { test::Named("m") };
  for (const double x : { 0.0, 1.0 })
  {
    test::AddQuad(scene, { x, 0, 0 }, { 1, 0, 0 }, { 0, 1, 0 });
    test::AddQuad(scene, { x, 0, 1 }, { 0, 1, 0 }, { 1, 0, 0 });
    test::AddQuad(scene, { x, 0, 0 }, { 0, 0, 1 }, { 1, 0, 0 });
    test::AddQuad(scene, { x, 1, 0 }, { 1, 0, 0 }, { 0, 0, 1 });
    test::AddQuad(scene, { 2 * x, 0, 0 }, { 0, 1, 0 }, { 0, 0, 1 });
  }
  test::AddQuad(scene, { 1, 0.5, 0 }, { 0, 0.5, 0 }, { 0, 0, 1 });
  EXPECT_EQ(SizesOfShells(scene), Sizes({ 10, 12 }));
  // Two of these part the room, but for where they stand on the floor: no edge of it is there.
  test::AddQuad(scene, { 1, 0, 0 }, { 0, 0.5, 0 }, { 0, 0, 1 });
  EXPECT_EQ(SizesOfShells(scene), Sizes({ 10, 14 }));
}

TEST(Shells, HoldForAnyOrderAndOrientation)
{
  RandomStream random(5);
  Scene grid = test::RoomGrid(3, 2);
  for (int round = 0; round < 10; ++round)
  {
    Scene scene = test::Shuffled(grid, random);
    for (std::size_t p = 0; p < scene.PolygonCount(); ++p)
    {
      if (random.Next() < 0.5)
      {
        std::reverse(
          scene.indices.begin() + scene.offsets[p], scene.indices.begin() + scene.offsets[p + 1]);
      }
    }
    EXPECT_EQ(SizesOfShells(scene), Sizes({ 6, 6, 6, 6, 6, 6, 22 }));
  }
}

} // namespace
} // namespace vantage
