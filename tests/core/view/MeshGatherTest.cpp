#include "core/view/MeshGather.h"

#include "core/Error.h"
#include "core/view/ElementImage.h"
#include "core/view/GatherStage.h"
#include "core/view/ViewImportance.h"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <cmath>
#include <set>

namespace vantage
{
namespace
{

using test::AddMaterial;
using test::GatherStage;

constexpr std::uint32_t ViewRays = 65536;

/// A floor of 2 x 2 under a lamp, with a square between them that throws a shadow.
GatherStage MakeShadowStage()
{
  Scene scene;
  const std::uint32_t grey = AddMaterial(scene, Color(0.5, 0.6, 0.7));
  const std::uint32_t lamp = AddMaterial(scene, Color(0.5), Color(200.0), false);
  scene.AddPolygon({ { -1, -1, 0 }, { 1, -1, 0 }, { 1, 1, 0 }, { -1, 1, 0 } }, grey);
  scene.AddPolygon({ { -.3, -.3, .5 }, { .3, -.3, .5 }, { .3, .3, .5 }, { -.3, .3, .5 } }, grey);
  scene.AddPolygon(
    { { -.05, -.05, 2 }, { -.05, .05, 2 }, { .05, .05, 2 }, { .05, -.05, 2 } }, lamp);
  return GatherStage(scene, [](PatchId) { return Color(0.1); });
}

/// Sees all of the floor from the side, past the square.
Camera ShadowCamera()
{
  return test::CameraAt({ 0.0, -2.5, 2.5 }, { 0.0, 0.0, 0.0 }, 45.0);
}

MeshGatherSettings Errors(double error)
{
  MeshGatherSettings settings;
  settings.interpolationError = error;
  settings.gatherError = error;
  return settings;
}

GatheredMesh GatherFor(const GatherStage& stage, const Camera& camera, double error)
{
  return GatherMesh(stage.occluders, stage.solution, stage.facets, stage.tree,
    SampleView(stage.occluders, stage.tree, camera, ViewRays, 1), Errors(error));
}

Image Drawn(const GatherStage& stage, const GatheredMesh& mesh, const Camera& camera)
{
  ElementImageSettings settings;
  settings.width = settings.height = 128;
  settings.pixelCentres = true;
  return RenderElements(
    stage.occluders, mesh.tree, mesh.surface, mesh.pointRadiance, camera, settings);
}

TEST(MeshGather, ThePictureIsAsGoodAsAskedAndTheErrorIsKnown)
{
  const GatherStage stage = MakeShadowStage();
  const Camera camera = ShadowCamera();
  const Image exact = stage.Gather(camera, test::Pixels(128, 128, true, 0.0005)).radiance;
  std::size_t last = 0;
  for (const double error : { 0.01, 0.004, 0.002 })
  {
    SCOPED_TRACE("error " + std::to_string(error));
    const GatheredMesh mesh = GatherFor(stage, camera, error);
    const double found = Compare(Drawn(stage, mesh, camera), exact).relativeL1;
    EXPECT_LE(found, std::hypot(error, error));
    EXPECT_LE(mesh.interpolationError, error);
    // 4096 judges, a few per cent of which lie where interpolation errs: 3 sigma are about 20 %.
    const double estimate = std::hypot(mesh.interpolationError, mesh.gatherError);
    EXPECT_GT(found, 0.4 * estimate);
    EXPECT_LT(found, 1.5 * estimate);
    EXPECT_GT(mesh.surface.PolygonCount(), last);
    last = mesh.surface.PolygonCount();
  }
}

TEST(MeshGather, SmallElementsFollowTheEdgeOfTheShadow)
{
  const GatherStage stage = MakeShadowStage();
  const GatheredMesh mesh = GatherFor(stage, ShadowCamera(), 0.0007);
  // The lamp is nearly a point: the shadow of the square of half a height reaches to 0.4, and its
  // penumbra is 0.033 wide.
  double area[2] = {};
  int count[2] = {};
  for (const NodeId element : mesh.surface.elements)
  {
    const Node& node = mesh.tree[element];
    const Vec3& c = node.centre;
    if (c.z == 0.0 && mesh.tree.PatchOfNode(element).normal.z > 0.0)
    {
      const double fromEdge = std::abs(std::max(std::abs(c.x), std::abs(c.y)) - 0.4);
      const int isNear = fromEdge < 0.03 ? 1 : 0;
      area[isNear] += node.area;
      ++count[isNear];
    }
  }
  EXPECT_LT(8.0 * area[1] / count[1], area[0] / count[0]);
}

TEST(MeshGather, NeighboursDifferByOneLevel)
{
  const GatherStage stage = MakeShadowStage();
  const GatheredMesh mesh = GatherFor(stage, ShadowCamera(), 0.002);
  int steps = 0;
  for (const NodeId element : mesh.surface.elements)
  {
    const Node& node = mesh.tree[element];
    const NodeId root = mesh.tree.PatchOfNode(element).node;
    for (int i = 0; i < node.cornerCount; ++i)
    {
      const Vec3 middle = Midpoint(node.corners[i], node.corners[(i + 1) % node.cornerCount]);
      const NodeId next = mesh.tree.LeafContaining(root, middle + 1e-3 * (middle - node.centre));
      EXPECT_LE(node.level, mesh.tree[next].level + 1);
      steps += node.level != mesh.tree[next].level ? 1 : 0;
    }
  }
  EXPECT_GT(steps, 0);
}

/// One value for each place, whichever elements meet there: no cracks in the light.
TEST(MeshGather, APlaceOnAPatchHasOneRadiance)
{
  const GatherStage stage = MakeShadowStage();
  const GatheredMesh mesh = GatherFor(stage, ShadowCamera(), 0.02);
  std::set<std::tuple<PatchId, double, double, double>> places;
  std::set<std::uint32_t> points;
  for (std::size_t p = 0; p < mesh.surface.PolygonCount(); ++p)
  {
    const PatchId patch = mesh.tree[mesh.surface.elements[p]].patch;
    for (std::uint32_t i = mesh.surface.offsets[p]; i < mesh.surface.offsets[p + 1]; ++i)
    {
      const std::uint32_t point = mesh.surface.indices[i];
      const Vec3& x = mesh.surface.points[point];
      points.insert(point);
      places.insert({ patch, x.x, x.y, x.z });
    }
  }
  EXPECT_EQ(points.size(), places.size());
  EXPECT_EQ(points.size(), mesh.pointRadiance.size());
}

TEST(MeshGather, WhatTheViewDoesNotSeeStaysAsItIs)
{
  const GatherStage stage = MakeShadowStage();
  const GatheredMesh mesh = GatherFor(stage, ShadowCamera(), 0.02);
  for (std::size_t p = 0; p < mesh.surface.PolygonCount(); ++p)
  {
    const NodeId element = mesh.surface.elements[p];
    const bool isUnder =
      mesh.tree[element].centre.z == 0.0 && mesh.tree.PatchOfNode(element).normal.z < 0.0;
    EXPECT_TRUE(!isUnder || mesh.tree[element].level == 0);
  }
  const Camera away = test::CameraAt({ 0, 0, 9 }, { 0, 0.1, 20 }, 45.0);
  const GatheredMesh unseen = GatherFor(stage, away, 0.02);
  EXPECT_EQ(unseen.surface.PolygonCount(), PatchMesh(stage.tree, stage.facets).FaceCount());
  EXPECT_EQ(unseen.interpolationError, 0.0);
  EXPECT_EQ(unseen.counts.gatherRays, 0u);
}

TEST(MeshGather, AViewOfFewSamplesIsNotTakenForOneOfFewPoints)
{
  const GatherStage stage = MakeShadowStage();
  const std::vector<ViewSample> view =
    SampleView(stage.occluders, stage.tree, ShadowCamera(), 64, 1);
  ASSERT_LT(view.size(), 64u);
  const GatheredMesh mesh =
    GatherMesh(stage.occluders, stage.solution, stage.facets, stage.tree, view, Errors(0.5));
  EXPECT_LT(mesh.surface.PolygonCount(), 100u);
}

TEST(MeshGather, RadianceOfPointsComesFromTheirIrradiance)
{
  const GatherStage stage = MakeShadowStage();
  const GatheredMesh mesh = GatherFor(stage, ShadowCamera(), 0.02);
  ASSERT_EQ(mesh.irradiance.size(), mesh.gathered.size());
  ASSERT_FALSE(mesh.gathered.empty());
  std::vector<PatchId> patchOf(mesh.pointRadiance.size(), None);
  for (std::size_t p = 0; p < mesh.surface.PolygonCount(); ++p)
  {
    for (std::uint32_t i = mesh.surface.offsets[p]; i < mesh.surface.offsets[p + 1]; ++i)
    {
      patchOf[mesh.surface.indices[i]] = mesh.tree[mesh.surface.elements[p]].patch;
    }
  }
  for (std::size_t k = 0; k < mesh.gathered.size(); ++k)
  {
    const PatchId patch = patchOf[mesh.gathered[k]];
    const Color expected =
      stage.solution.emission[patch] + stage.solution.albedo[patch] / Pi * mesh.irradiance[k];
    const Color& found = mesh.pointRadiance[mesh.gathered[k]];
    EXPECT_LT(MaxChannel(glm::abs(found - expected)), 1e-12 * (1.0 + MaxChannel(expected)));
  }
}

TEST(MeshGather, TheNumberOfThreadsChangesNothing)
{
  const GatherStage stage = MakeShadowStage();
  const auto gather = [&](int threads)
  {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
    return GatherFor(stage, ShadowCamera(), 0.02);
  };
  const GatheredMesh expected = gather(1);
  for (const int threads : { 2, 4 })
  {
    const GatheredMesh found = gather(threads);
    EXPECT_EQ(found.pointRadiance, expected.pointRadiance);
    EXPECT_EQ(found.surface.indices, expected.surface.indices);
    EXPECT_EQ(found.interpolationError, expected.interpolationError);
  }
}

TEST(MeshGather, RefusesErrorsOutOfRange)
{
  const GatherStage stage = MakeShadowStage();
  for (const double error : { 0.0, 1e-4, 1.5, std::nan("") })
  {
    EXPECT_THROW(GatherFor(stage, ShadowCamera(), error), InputError) << error;
  }
}

} // namespace
} // namespace vantage
