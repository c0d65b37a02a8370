#include "core/view/ElementImage.h"

#include "core/Error.h"
#include "core/math/Sampling.h"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <cmath>

namespace vantage
{
namespace
{

/// A unit square and an equal one-sided triangle beside it, the square unevenly split.
struct Stage
{
  Scene scene;
  FacetSet facets;
  OccluderScene occluders;
  ElementTree tree;
  ElementSurface surface;

  Stage()
    : scene(TwoShapes())
    , facets(BuildFacets(this->scene))
    , occluders(this->facets)
    , tree(MakeTree(this->facets, this->scene))
    , surface(PatchMesh(this->tree, this->facets).Surface())
  {
  }

  static Scene TwoShapes()
  {
    Scene scene;
    scene.materials.resize(2);
    scene.materials[1].twoSided = false;
    scene.AddPolygon({ { 0, 0, 0 }, { 1, 0, 0 }, { 1, 1, 0 }, { 0, 1, 0 } }, 0);
    scene.AddPolygon({ { 2, 0, 0 }, { 3, 0, 0 }, { 2, 1, 0 } }, 1);
    return scene;
  }
  static ElementTree MakeTree(const FacetSet& facets, const Scene& scene)
  {
    ElementTree tree(facets, scene.materials);
    for (const Patch& patch : std::vector<Patch>(tree.Patches()))
    {
      if (patch.IsActive())
      {
        const NodeId first = tree.Split(patch.node);
        tree.Split(tree.Split(first + 1));
      }
    }
    return tree;
  }

  /// The patch that is seen at a point from above.
  PatchId Above(const Vec3& x) const
  {
    return this->occluders.Intersect(x + Vec3(0, 0, 1), { 0, 0, -1 })->Patch();
  }
};

TEST(ElementImageSettings, BadValuesAreNamed)
{
  ElementImageSettings settings;
  settings.height = 0;
  try
  {
    settings.Validate();
    FAIL();
  }
  catch (const InputError& error)
  {
    EXPECT_STREQ(error.what(), "image height is 0; give a number of at least 1");
  }
}

TEST(SurfaceInterpolator, GivesAConstantBackEverywhere)
{
  const Stage stage;
  const std::vector<Color> values(stage.surface.points.size(), Color(0.25, 0.5, 2.0));
  const SurfaceInterpolator interpolator(stage.tree, stage.surface);
  for (int i = 0; i <= 64; ++i)
  {
    for (int k = 0; k <= 64; ++k)
    {
      const Vec3 x(i / 64.0, k / 64.0, 0.0);
      const Color c = interpolator.At(values, stage.Above(x), x);
      // Round-off only; corners and edges of the elements are among the points.
      ASSERT_NEAR(glm::length(c - values[0]), 0.0, 1e-13) << i << " " << k;
    }
  }
}

TEST(SurfaceInterpolator, IsContinuousAcrossElementsOfDifferentLevels)
{
  const Stage stage;
  std::vector<Color> values;
  for (std::size_t i = 0; i < stage.surface.points.size(); ++i)
  {
    values.push_back(Color(ToUnit(Hash(i)), ToUnit(Hash(i + 100)), 1.0));
  }
  const SurfaceInterpolator interpolator(stage.tree, stage.surface);
  const double step = 1e-7;
  for (int i = 1; i < 1000; ++i)
  {
    // Across the lines where elements of level 1 meet those of level 2 and 3.
    for (const Vec3& x : { Vec3(0.5, i / 1000.0, 0), Vec3(i / 1000.0, 0.5, 0),
           Vec3(0.75, i / 1000.0, 0), Vec3(i / 1000.0, 0.25, 0) })
    {
      const PatchId patch = stage.Above(x);
      const Vec3 across = Vec3(1, 1, 0) * step;
      const Color jump =
        interpolator.At(values, patch, x + across) - interpolator.At(values, patch, x - across);
      // The gradient is at most about 1 / (size of an element, 1/8) times a few.
      ASSERT_LT(glm::length(jump), 100.0 * step) << x.x << " " << x.y;
    }
  }
}

TEST(SurfaceInterpolator, KnowsThePolygonOfAnElement)
{
  const Stage stage;
  const SurfaceInterpolator interpolator(stage.tree, stage.surface);
  for (std::uint32_t p = 0; p < stage.surface.PolygonCount(); ++p)
  {
    const Node& element = stage.tree[stage.surface.elements[p]];
    EXPECT_EQ(interpolator.PolygonAt(element.patch, element.centre), p);
  }
  PatchId inactive = 0;
  while (stage.tree.Patches()[inactive].IsActive())
  {
    ++inactive;
  }
  EXPECT_EQ(interpolator.PolygonAt(inactive, Vec3(2.2, 0.2, 0.0)), None);
}

Camera FacingTheSquare()
{
  Camera camera;
  camera.eye = { 0.5, 0.5, 1.0 };
  camera.lookAt = { 0.5, 0.5, 0.0 };
  camera.up = { 0, 1, 0 };
  camera.fieldOfView = 2.0 * std::atan(1.0) * 180.0 / Pi; // sees [-0.5, 1.5]^2
  return camera;
}

TEST(RenderElements, PutsThePictureTheRightWayRound)
{
  const Stage stage;
  std::vector<Color> values;
  for (const NodeId element : stage.surface.elements)
  {
    const Vec3 c = stage.tree[element].centre;
    values.push_back(stage.tree.PatchOfNode(element).normal.z > 0 ? Color(c.x, c.y, 1) : Color(9));
  }
  ElementImageSettings settings;
  settings.width = settings.height = 8;
  settings.pixelCentres = true;
  settings.flat = true;
  const Image image =
    RenderElements(stage.occluders, stage.tree, stage.surface, values, FacingTheSquare(), settings);
  // Pixel (x, y) looks at (x / 4 - 0.375, y / 4 - 0.375): elements of the quarter x < 1/2, y > 1/2.
  EXPECT_EQ(image.At(0, 0), Color(0.0));
  EXPECT_EQ(image.At(3, 4), Color(0.25, 0.75, 1.0));
  EXPECT_EQ(image.At(5, 5), Color(0.75, 0.75, 1.0));
  EXPECT_EQ(image.At(7, 3), Color(0.0));
}

TEST(RenderElements, AntialiasingGivesTheCoveredFraction)
{
  const Stage stage;
  const std::vector<Color> values(stage.surface.points.size(), Color(1.0));
  ElementImageSettings settings;
  settings.width = settings.height = 1;
  settings.samplesPerPixel = 4096;
  const Image image =
    RenderElements(stage.occluders, stage.tree, stage.surface, values, FacingTheSquare(), settings);
  // A quarter of the pixel is covered; 64 x 64 strata, aligned with the square, leave round-off.
  EXPECT_NEAR(image.At(0, 0).x, 0.25, 1e-12);
}

TEST(RenderElements, BacksOfOneSidedFacetsAreBlack)
{
  const Stage stage;
  const std::vector<Color> values(stage.surface.points.size(), Color(1.0));
  ElementImageSettings settings;
  settings.width = settings.height = 1;
  settings.pixelCentres = true;
  Camera camera;
  camera.up = { 0, 1, 0 };
  const auto look = [&](const Vec3& target, double height)
  {
    camera.eye = target + Vec3(0, 0, height);
    camera.lookAt = target;
    return RenderElements(stage.occluders, stage.tree, stage.surface, values, camera, settings)
      .At(0, 0);
  };
  EXPECT_NEAR(look({ 2.2, 0.2, 0 }, 1.0).x, 1.0, 1e-13);
  EXPECT_EQ(look({ 2.2, 0.2, 0 }, -1.0), Color(0.0));
  EXPECT_NEAR(look({ 0.5, 0.5, 0 }, -1.0).x, 1.0, 1e-13);
}

TEST(RenderElements, IsTheSameForAnyNumberOfThreads)
{
  const Stage stage;
  std::vector<Color> values;
  for (std::size_t i = 0; i < stage.surface.points.size(); ++i)
  {
    values.push_back(Color(ToUnit(Hash(i))));
  }
  ElementImageSettings settings;
  settings.width = 33;
  settings.height = 17;
  const auto render = [&](int threads)
  {
    const tbb::global_control control(tbb::global_control::max_allowed_parallelism, threads);
    return RenderElements(
      stage.occluders, stage.tree, stage.surface, values, FacingTheSquare(), settings)
      .pixels;
  };
  EXPECT_EQ(render(1), render(4));
}

} // namespace
} // namespace vantage
