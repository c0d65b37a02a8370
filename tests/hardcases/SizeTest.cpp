#include "core/scene/Labyrinth.h"
#include "hardcases/HardCase.h"
#include "support/TestScenes.h"

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

Scene MakeBalls(int rings, bool twoSided)
{
  Scene scene = test::MakeLitBox();
  scene.materials.push_back(test::MakeMaterial(Color(0.6), Color(0.0), twoSided));
  test::AddBall(scene, Vec3(0.3, 0.7, 0.2), 0.15, rings, 5);
  test::AddBall(scene, Vec3(0.7, 0.25, 0.15), 0.12, rings, 5);
  return scene;
}

/// Two balls of 3,900 triangles each, as black inside as any closed body. Oracles: as many
/// interactions as when a modeller has declared them one-sided, to the bit; not many more than with
/// 860 triangles; path tracing.
TEST(HardCase, CurvedBodiesOfThousandsOfTriangles)
{
  const Scene fine = MakeBalls(32, true);
  const std::size_t interactions = test::SolvedCase(fine, 0.02).Interactions().size();
  EXPECT_EQ(interactions, test::SolvedCase(MakeBalls(32, false), 0.02).Interactions().size());
  EXPECT_LT(interactions, 1.5 * test::SolvedCase(MakeBalls(15, true), 0.02).Interactions().size());
  EXPECT_NEAR(test::RelativeToTraced(fine, 0.02, 1024), 1.0, 0.02);
}

/// Surfaces that were cut into 2,900 and 5,800 pieces, lamp included. Oracle: as they were, both in
/// the picture, within twice its error, and in the interactions that it takes.
TEST(HardCase, SurfacesCutIntoThousandsOfPieces)
{
  const Scene whole = test::MakeLitBox();
  const Image expected = test::CasePicture(whole, 0.02);
  const std::size_t interactions = test::SolvedCase(whole, 0.02).Interactions().size();
  for (const bool triangles : { false, true })
  {
    const Scene cut = test::CutIntoPieces(whole, 15, triangles);
    EXPECT_LT(Compare(test::CasePicture(cut, 0.02), expected).relativeL1, 0.04);
    EXPECT_LT(test::SolvedCase(cut, 0.02).Interactions().size(), 2 * interactions);
  }
}

} // namespace
} // namespace vantage
