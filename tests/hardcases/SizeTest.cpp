#include "core/scene/Labyrinth.h"
#include "hardcases/HardCase.h"

namespace vantage
{
namespace
{

Solver SolvedLabyrinth(int rooms)
{
  Scene scene = MakeLabyrinth({ rooms, rooms });
  scene.cameras = { scene.FindCamera("view1") };
  return test::SolvedCase(scene, 0.05);
}

/// Of 47,000 polygons a camera sees one room. Oracle: a tenth of them, which cost about as much.
TEST(HardCase, TensOfThousandsOfPolygonsThatNobodySees)
{
  const Solver many = SolvedLabyrinth(50);
  const Solver few = SolvedLabyrinth(16);
  EXPECT_GT(many.GetScene().PolygonCount(), 45000u);
  EXPECT_LT(many.Interactions().size(), 3 * few.Interactions().size());
  EXPECT_LT(many.MemoryBytes() / many.GetScene().PolygonCount(), 2000u);
}

} // namespace
} // namespace vantage
