#include "core/view/ViewImportance.h"

#include "core/formfactor/FormFactor.h"
#include "core/math/Sampling.h"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <cmath>

namespace vantage
{
namespace
{

constexpr std::uint32_t Rays = 65536;

/// A scene of polygons of one material, ready to be looked at.
struct Stage
{
  Scene scene;
  FacetSet facets;
  OccluderScene occluders;
  ElementTree tree;

  explicit Stage(const std::vector<std::vector<Vec3>>& polygons, bool twoSided = true)
    : scene(SceneOf(polygons, twoSided))
    , facets(BuildFacets(this->scene))
    , occluders(this->facets)
    , tree(this->facets, this->scene.materials)
  {
  }

  static Scene SceneOf(const std::vector<std::vector<Vec3>>& polygons, bool twoSided)
  {
    Scene scene;
    scene.materials.emplace_back();
    scene.materials[0].twoSided = twoSided;
    for (const auto& polygon : polygons)
    {
      scene.AddPolygon(polygon, 0);
    }
    return scene;
  }
};

double Sum(const std::vector<ViewSample>& samples)
{
  double sum = 0.0;
  for (const ViewSample& sample : samples)
  {
    sum += sample.weight;
  }
  return sum;
}

/// The polygon as the frustum leaves it.
Polygon ClipToFrustum(Polygon p, const ImagePlane& plane)
{
  for (const double sign : { 1.0, -1.0 })
  {
    for (const auto& [half, other] :
      { std::pair(plane.right, plane.up), std::pair(plane.up, plane.right) })
    {
      Vec3 inwards = glm::normalize(glm::cross(plane.forward + sign * half, other));
      inwards *= glm::dot(inwards, plane.forward) < 0.0 ? -1.0 : 1.0;
      p = ClipToFront(p, { inwards, glm::dot(inwards, plane.eye) });
    }
  }
  return p;
}

/// What the eye sees of a polygon in closed form: integral of cos_eye d omega.
double ExactWeight(const Polygon& seenSide, const ImagePlane& plane)
{
  return PointToPolygon(plane.eye, plane.forward, ClipToFrustum(seenSide, plane));
}

/// A grid of n cells errs only in the cells on the border of the patch, fewer than 8 sqrt(n), each
/// by less than half of its weight with a random sign: eight of these deviations.
double StratifiedError(double frustumWeight)
{
  const double n = Rays;
  return 8.0 * frustumWeight / n * 0.5 * std::sqrt(8.0 * std::sqrt(n));
}

Camera LookingDown()
{
  Camera camera;
  camera.eye = { 0.2, 0.1, 3.0 };
  camera.lookAt = { 0.3, 0.2, 0.0 };
  camera.up = { 0, 1, 0 };
  camera.fieldOfView = 50.0;
  camera.aspect = 1.5;
  return camera;
}

class ViewOfOnePatch : public ::testing::TestWithParam<std::vector<Vec3>>
{
};

TEST_P(ViewOfOnePatch, WeighsWhatPointToPolygonSays)
{
  const Stage stage({ GetParam() });
  const ImagePlane plane(LookingDown());
  const auto samples = SampleView(stage.occluders, stage.tree, LookingDown(), Rays, 1);
  double exact = 0.0;
  const Polygon shape = stage.facets.facets[0].shape;
  exact = ExactWeight(shape, plane) + ExactWeight(Reversed(shape), plane);
  EXPECT_NEAR(Sum(samples), exact, StratifiedError(plane.Area()));
  ASSERT_FALSE(samples.empty());
  const Side side = SupportingPlane(shape).Distance(plane.eye) > 0.0 ? Side::Front : Side::Back;
  for (const ViewSample& sample : samples)
  {
    ASSERT_EQ(sample.patch, PatchOf(0, side));
  }
}

INSTANTIATE_TEST_SUITE_P(Shapes, ViewOfOnePatch,
  ::testing::Values(std::vector<Vec3>{ { 0, 0, 0 }, { 1, 0, 0 }, { 1, 1, 0 }, { 0, 1, 0 } },
    std::vector<Vec3>{ { 0, 0, 0 }, { 0, 1, 0 }, { 1, 1, 0 }, { 1, 0, 0 } }, // seen from its back
    std::vector<Vec3>{ { 0, 0, 0 }, { 1, 0, 1 }, { 0.5, 1, 0.5 } },
    std::vector<Vec3>{ { 0, 0, 0 }, { 9, 0, 0 }, { 9, 9, 0 }, { 0, 9, 0 } }, // cut by the frustum
    std::vector<Vec3>{ { -9, 0, -9 }, { 9, 0, -9 }, { 9, 0, 9 }, { -9, 0, 9 } })); // and by the eye

TEST(ViewImportance, AFullImageWeighsWhatTheFrustumHolds)
{
  const Stage stage({ { { -50, -50, -1 }, { 50, -50, -1 }, { 50, 50, -1 }, { -50, 50, -1 } } });
  const ImagePlane plane(LookingDown());
  const Polygon image{ plane.eye + plane.Direction(-1, -1), plane.eye + plane.Direction(-1, 1),
    plane.eye + plane.Direction(1, 1), plane.eye + plane.Direction(1, -1) };
  const double exact = PointToPolygon(plane.eye, plane.forward, Reversed(image));
  const auto samples = SampleView(stage.occluders, stage.tree, LookingDown(), Rays, 1);
  // No border: one jittered sample in each cell of a smooth function errs by h / sqrt(n) in
  // relative terms, h = 1 / 209 the size of a cell. Four times that.
  EXPECT_NEAR(Sum(samples) / exact, 1.0, 4.0 / 209.0 / std::sqrt(Rays));
}

TEST(ViewImportance, WhatIsHiddenWeighsNothing)
{
  const std::vector<Vec3> floor{ { 0, 0, 0 }, { 1, 0, 0 }, { 1, 1, 0 }, { 0, 1, 0 } };
  const std::vector<Vec3> cover{ { -1, -1, 1 }, { 2, -1, 1 }, { 2, 2, 1 }, { -1, 2, 1 } };
  const Stage stage({ floor, cover });
  const std::uint32_t upper = stage.facets.facets[0].shape[0].z == 1.0 ? 0 : 1;
  for (const ViewSample& s : SampleView(stage.occluders, stage.tree, LookingDown(), Rays, 1))
  {
    ASSERT_EQ(s.patch, PatchOf(upper, Side::Front));
  }
}

TEST(ViewImportance, BacksOfOneSidedFacetsGiveNoSamplesButHide)
{
  const std::vector<Vec3> floor{ { 0, 0, 0 }, { 1, 0, 0 }, { 1, 1, 0 }, { 0, 1, 0 } };
  const std::vector<Vec3> cover{ { -1, -1, 1 }, { -1, 2, 1 }, { 2, 2, 1 }, { 2, -1, 1 } };
  EXPECT_TRUE(SampleView(Stage({ floor, cover }, false).occluders,
    Stage({ floor, cover }, false).tree, LookingDown(), Rays, 1)
                .empty());
}

TEST(ViewImportance, SamplesLieInTheFrustumAndOnTheirPatch)
{
  const Stage stage({ { { -9, -9, 0 }, { 9, -9, 0 }, { 9, 9, 0 }, { -9, 9, 0 } } });
  const ImagePlane plane(LookingDown());
  const auto samples = SampleView(stage.occluders, stage.tree, LookingDown(), 1000, 1);
  EXPECT_NEAR(static_cast<double>(samples.size()), 1000.0, 40.0);
  for (const ViewSample& sample : samples)
  {
    const Vec3 direction = sample.point - plane.eye;
    const Vec3 onPlane = direction / glm::dot(direction, plane.forward) - plane.forward;
    ASSERT_LE(std::abs(glm::dot(onPlane, plane.right)), glm::dot(plane.right, plane.right));
    ASSERT_LE(std::abs(glm::dot(onPlane, plane.up)), glm::dot(plane.up, plane.up));
    ASSERT_NEAR(sample.point.z, 0.0, 1e-14);
  }
}

TEST(ViewImportance, AnyNumberOfRaysAndAnyAspect)
{
  const Stage stage({ { { -50, -50, 0 }, { 50, -50, 0 }, { 50, 50, 0 }, { -50, 50, 0 } } });
  for (const double aspect : { 0.1, 1.0, 7.0 })
  {
    Camera camera = LookingDown();
    camera.fieldOfView = 20.0;
    camera.aspect = aspect;
    for (const std::uint32_t rays : { 1u, 2u, 3u, 10u, 1000u })
    {
      const auto count = SampleView(stage.occluders, stage.tree, camera, rays, 1).size();
      EXPECT_GE(count, 1u);
      EXPECT_LE(count, rays);
      EXPECT_GE(count, rays / 2);
    }
  }
}

TEST(ViewImportance, IsTheSameForAnyNumberOfThreadsAndDiffersBySeed)
{
  const Stage stage({ { { -1, -1, 0 }, { 1, -1, 0 }, { 1, 1, 0 }, { -1, 1, 0 } } });
  const auto sample = [&](int threads, std::uint64_t seed)
  {
    const tbb::global_control control(tbb::global_control::max_allowed_parallelism, threads);
    std::vector<double> flat;
    for (const ViewSample& s : SampleView(stage.occluders, stage.tree, LookingDown(), 5000, seed))
    {
      flat.insert(flat.end(), { s.point.x, s.point.y, s.weight });
    }
    return flat;
  };
  EXPECT_EQ(sample(1, 3), sample(4, 3));
  EXPECT_NE(sample(1, 3), sample(1, 4));
}

} // namespace
} // namespace vantage
