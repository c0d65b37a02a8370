#include "core/view/SurfaceGather.h"
#include "core/view/GatherStage.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace vantage
{
namespace
{

using test::AddMaterial;
using test::GatherStage;

/// One floor below two rooms, parted by a wall at x = 1. Only in the first one is there a lamp, and
/// light.
Scene MakePartedRooms()
{
  Scene scene;
  const std::uint32_t white = AddMaterial(scene, Color(0.5));
  const std::uint32_t lamp = AddMaterial(scene, Color(0.5), Color(6.0), false);
  scene.AddPolygon({ { 0, 0, 0 }, { 2, 0, 0 }, { 2, 1, 0 }, { 0, 1, 0 } }, white);
  for (const double x : { 0.0, 1.0, 2.0 })
  {
    scene.AddPolygon({ { x, 0, 0 }, { x, 1, 0 }, { x, 1, 1 }, { x, 0, 1 } }, white);
  }
  for (const double x : { 0.0, 1.0 })
  {
    scene.AddPolygon({ { x, 0, 1 }, { x, 1, 1 }, { x + 1, 1, 1 }, { x + 1, 0, 1 } }, white);
    for (const double y : { 0.0, 1.0 })
    {
      scene.AddPolygon({ { x, y, 0 }, { x + 1, y, 0 }, { x + 1, y, 1 }, { x, y, 1 } }, white);
    }
  }
  scene.AddPolygon(
    { { 0.4, 0.4, 0.9 }, { 0.4, 0.6, 0.9 }, { 0.6, 0.6, 0.9 }, { 0.6, 0.4, 0.9 } }, lamp);
  return scene;
}

PatchId FloorOf(const GatherStage& stage)
{
  for (PatchId p = 0; p < stage.tree.Patches().size(); ++p)
  {
    const Vec3 centre = Centroid(stage.facets.facets[p / 2].shape);
    if (centre.z == 0.0 && stage.Normal(p).z > 0.5)
    {
      return p;
    }
  }
  return None;
}

/// Light in the first room comes from the wall at x = 0 only: one patch, seen from there alone.
GatherStage MakeStage()
{
  GatherStage stage(MakePartedRooms(), [](PatchId) { return Color(0.0); });
  for (PatchId p = 0; p < stage.tree.Patches().size(); ++p)
  {
    const Vec3 centre = Centroid(stage.facets.facets[p / 2].shape);
    if (stage.solution.IsActive(p) && centre.x == 0.0 && stage.Normal(p).x > 0.5)
    {
      stage.solution.elements[stage.solution.elementOfPatch[p]].indirect = Color(2.0);
    }
  }
  return stage;
}

std::vector<GatherPoint> Grid(PatchId floor, int columns, int rows)
{
  std::vector<GatherPoint> points;
  for (int y = 0; y <= rows; ++y)
  {
    for (int x = 0; x <= columns; ++x)
    {
      points.push_back({ floor, { 2.0 * x / columns, 1.0 * y / rows, 0.0 } });
    }
  }
  return points;
}

/// Points on the borders and in the corners of the floor included.
TEST(SurfaceGather, LightDoesNotLeakThroughWalls)
{
  const GatherStage stage = MakeStage();
  const PatchId floor = FloorOf(stage);
  ASSERT_NE(floor, None);
  // No point lies in the parting wall itself: which room it belongs to cannot be told.
  const std::vector<GatherPoint> points = Grid(floor, 41, 20);
  const SurfaceGather gather(stage.occluders, stage.solution);
  const SurfaceGather::Result result = gather.Radiance(points, {});
  ASSERT_EQ(result.radiance.size(), points.size());
  double most = 0.0;
  for (std::size_t i = 0; i < points.size(); ++i)
  {
    if (points[i].point.x > 1.0)
    {
      ASSERT_EQ(result.radiance[i], Color(0.0)) << i;
    }
    else
    {
      ASSERT_GT(MaxChannel(result.radiance[i]), 0.0) << i;
    }
    most = std::max(most, MaxChannel(result.radiance[i]));
  }
  EXPECT_GT(most, 0.05); // straight from the lamp: 0.5 / pi 6 0.04 / 0.81 = 0.047
  EXPECT_LT(result.counts.gatherPoints, points.size());
}

TEST(SurfaceGather, PointsBeyondTheBorderAreThoseOnIt)
{
  const GatherStage stage = MakeStage();
  const SurfaceGather gather(stage.occluders, stage.solution);
  GatherCounts counts;
  const PatchId floor = FloorOf(stage);
  const std::vector<Color> direct = gather.Direct(
    { { floor, { 0.3, -1e-9, 0.0 } }, { floor, { 0.3, 0.0, 0.0 } }, { floor, { 0.3, 1e-4, 0.0 } } },
    0.0, counts);
  EXPECT_GT(direct[1].x, 0.1);
  EXPECT_NEAR(direct[0].x, direct[1].x, 1e-6);
  EXPECT_NEAR(direct[2].x, direct[1].x, 1e-3);
}

TEST(SurfaceGather, AddsWhatLampsGiveToWhatSurfacesReflect)
{
  const GatherStage stage = MakeStage();
  const PatchId floor = FloorOf(stage);
  const SurfaceGather gather(stage.occluders, stage.solution);
  const std::vector<GatherPoint> points{ { floor, { 0.5, 0.4, 0.0 } }, { floor, { 0.2, 0.2, 0.0 } },
    { floor + 1, { 0.5, 0.5, 0.0 } } };
  GatherCounts counts;
  const std::vector<Color> direct = gather.Direct(points, 0.0, counts);
  const SurfaceGather::Result result = gather.Radiance(points, {});
  // What is given to one point and taken from the other changes nothing else.
  std::vector<Color> moved = direct;
  moved[0] += 0.1;
  moved[1] -= 0.1;
  const SurfaceGather::Result other = gather.Radiance(points, moved, {});
  for (int i = 0; i < 2; ++i)
  {
    EXPECT_GT(result.radiance[i].x, 0.5 / Pi * direct[i].x + 0.01) << i;
    EXPECT_NEAR(
      other.radiance[i].x - result.radiance[i].x, (i == 0 ? 0.1 : -0.1) * 0.5 / Pi, 1e-12);
  }
  EXPECT_EQ(result.radiance[2], Color(0.0)); // the under side sees nothing
}

TEST(SurfaceGather, NoPointsGiveNoLight)
{
  const GatherStage stage = MakeStage();
  const SurfaceGather gather(stage.occluders, stage.solution);
  const SurfaceGather::Result result = gather.Radiance({}, {});
  EXPECT_TRUE(result.radiance.empty());
  EXPECT_EQ(result.error, 0.0);
}

} // namespace
} // namespace vantage
