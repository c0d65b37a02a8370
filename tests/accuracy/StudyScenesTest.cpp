#include "support/StudyScenes.h"

#include "core/Error.h"
#include "core/mesh/ElementTree.h"
#include "core/visibility/OccluderScene.h"

#include <gtest/gtest.h>

#include <string>

namespace vantage
{
namespace
{

constexpr std::uint64_t RandomRooms = 200;

/// A scene as a careful person makes it: nothing to mend, something that shines, and a camera that
/// stands in the air and has sides that reflect in a third of its picture at least.
void ExpectUsable(const test::StudyScene& study)
{
  SCOPED_TRACE(study.name);
  ASSERT_NO_THROW(study.scene.Validate());
  const FacetSet facets = BuildFacets(study.scene);
  EXPECT_EQ(facets.report.weldedVertices, 0u);
  EXPECT_EQ(facets.report.degeneratePolygons, 0u);
  EXPECT_EQ(facets.report.nonPlanarPolygons, 0u);
  EXPECT_EQ(facets.report.concavePolygons, 0u);
  EXPECT_EQ(facets.report.largePolygons, 0u);
  EXPECT_EQ(facets.report.duplicateFacets, 0u);
  const ElementTree tree(facets, study.scene.materials);
  const OccluderScene occluders(facets);
  const ImagePlane plane(study.View());
  constexpr int Size = 16;
  int seen = 0;
  for (int y = 0; y < Size; ++y)
  {
    for (int x = 0; x < Size; ++x)
    {
      const auto hit = occluders.Intersect(
        plane.eye, plane.Direction((2 * x + 1.0) / Size - 1.0, (2 * y + 1.0) / Size - 1.0));
      seen += hit && tree.Patches()[hit->Patch()].IsActive() ? 1 : 0;
    }
  }
  EXPECT_GE(seen, Size * Size / 3);
}

TEST(StudyScenes, AreClean)
{
  for (const std::string& name : test::StudySceneNames())
  {
    ExpectUsable(test::MakeStudyScene(name));
  }
}

TEST(StudyScenes, RandomRoomsAreClean)
{
  for (std::uint64_t seed = 1; seed <= RandomRooms; ++seed)
  {
    ExpectUsable(test::MakeStudyScene("room-" + std::to_string(seed)));
  }
}

TEST(StudyScenes, UnknownNamesAreErrors)
{
  EXPECT_THROW(test::MakeStudyScene("room"), UnknownNameError);
  EXPECT_THROW(test::MakeStudyScene("room-"), UnknownNameError);
  EXPECT_THROW(test::MakeStudyScene("room-1x"), UnknownNameError);
}

} // namespace
} // namespace vantage
