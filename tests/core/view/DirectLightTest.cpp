#include "core/view/DirectLight.h"
#include "core/formfactor/FormFactor.h"
#include "core/formfactor/Shadows.h"
#include "core/math/Sampling.h"
#include "core/mesh/DarkSides.h"
#include "core/view/GatherStage.h"
#include "support/TestScenes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace vantage
{
namespace
{

using test::AddMaterial;
using test::GatherStage;
using test::Pixels;

const Color LampRadiance(9.0, 7.0, 5.0);

/// A floor of albedo (.6, .5, .4), a lamp above it, and what is given in between, black.
Scene MakeLampOverFloor(const std::vector<std::vector<Vec3>>& occluders,
  const std::vector<Vec3>& lampShape = {
    { -0.2, -0.3, 1 }, { -0.2, 0.3, 1 }, { 0.3, 0.3, 1.1 }, { 0.3, -0.3, 1.1 } })
{
  Scene scene;
  const std::uint32_t floor = AddMaterial(scene, { 0.6, 0.5, 0.4 });
  const std::uint32_t lamp = AddMaterial(scene, Color(0.0), LampRadiance);
  const std::uint32_t black = AddMaterial(scene, Color(0.0));
  scene.AddPolygon({ { -1, -1, 0 }, { 1, -1, 0 }, { 1, 1, 0 }, { -1, 1, 0 } }, floor);
  scene.AddPolygon(lampShape, lamp);
  for (const auto& points : occluders)
  {
    scene.AddPolygon(points, black);
  }
  return scene;
}

/// A wall that stands on the floor, a table of two panes close together, a slanted triangle and a
/// pane that hangs from the lamp.
const std::vector<std::vector<Vec3>> Occluders{
  { { -0.6, 0.35, 0.0 }, { 0.2, 0.45, 0.0 }, { 0.2, 0.45, 0.5 }, { -0.6, 0.35, 0.5 } },
  { { -0.4, -0.5, 0.4 }, { 0.1, -0.5, 0.4 }, { 0.1, 0.0, 0.4 }, { -0.4, 0.0, 0.4 } },
  { { -0.4, -0.5, 0.43 }, { 0.1, -0.5, 0.43 }, { 0.1, 0.0, 0.43 }, { -0.4, 0.0, 0.43 } },
  { { 0.2, 0.1, 0.2 }, { 0.6, -0.1, 0.5 }, { 0.3, 0.4, 0.8 } },
  { { 0.05, -0.3, 1.0 }, { 0.05, 0.1, 1.0 }, { 0.05, 0.1, 0.8 }, { 0.05, -0.3, 0.8 } },
};

Polygon Clipped(const Polygon& p, const Plane& a, const Plane& b)
{
  return ClipToFront(ClipToFront(p, a, 1e-10), b, 1e-10);
}

/// What a point of the floor gets from the lamp.
Color Expected(const GatherStage& stage, const Vec3& x)
{
  const Vec3 up(0.0, 0.0, 1.0);
  Polygon lamp;
  std::vector<Polygon> others;
  for (std::uint32_t f = 0; f < stage.facets.facets.size(); ++f)
  {
    const Facet& facet = stage.facets.facets[f];
    if (facet.material == 1)
    {
      lamp = facet.shape;
    }
    else if (facet.material == 2)
    {
      others.push_back(facet.shape);
    }
  }
  std::vector<Polygon> between;
  for (const Polygon& other : others)
  {
    const Polygon part = Clipped(other, Plane(), SupportingPlane(lamp));
    if (!part.Empty())
    {
      between.push_back(part);
    }
  }
  return PointToVisiblePolygon(x, up, lamp, between) * LampRadiance;
}

Camera FloorCamera()
{
  return test::CameraAt({ 0.9, -2.4, 2.2 }, { 0.0, 0.0, 0.0 }, 40.0);
}

/// The part of the floor that pixels see, and its light.
struct LitFloor
{
  std::vector<Color> expected;
  std::vector<Color> found;
  DirectCounters counters;

  LitFloor(const GatherStage& stage, int size, double tolerance)
  {
    std::vector<Vec3> points;
    PatchId floor = None;
    for (int i = 0; i < size * size; ++i)
    {
      const auto hit = stage.Centre(FloorCamera(), size, size, i % size, i / size);
      if (hit && stage.facets.facets[hit->facet].material == 0 && hit->side == Side::Front)
      {
        floor = hit->Patch();
        points.push_back(hit->point);
        this->expected.push_back(Expected(stage, hit->point));
      }
    }
    this->found =
      DirectLight(stage.occluders, stage.solution, tolerance).At(floor, points, this->counters);
  }
};

void ExpectExactFloor(const GatherStage& stage, bool expectShadow)
{
  constexpr int Size = 64;
  const LitFloor floor(stage, Size, 0.0);
  int dark = 0;
  for (std::size_t i = 0; i < floor.expected.size(); ++i)
  {
    ASSERT_LT(glm::length(floor.found[i] - floor.expected[i]), 1e-8) << i; // cut in other order
    dark += MaxChannel(floor.found[i]) == 0.0 ? 1 : 0;
  }
  EXPECT_GT(floor.expected.size(), Size * Size / 4u);
  EXPECT_EQ(dark > 20, expectShadow);
  EXPECT_EQ(floor.counters.cutEvaluations > 100, expectShadow);
  EXPECT_EQ(floor.counters.shadowRays, 0u);
}

TEST(DirectLight, IsLambertsFormulaWhereNothingIsInBetween)
{
  ExpectExactFloor(GatherStage(MakeLampOverFloor({}), [](PatchId) { return Color(0.0); }), false);
}

TEST(DirectLight, HasExactShadows)
{
  ExpectExactFloor(
    GatherStage(MakeLampOverFloor(Occluders), [](PatchId) { return Color(0.0); }), true);
}

PatchId UpperSideOfFloor(const GatherStage& stage)
{
  PatchId floor = None;
  for (PatchId p = 0; p < stage.tree.Patches().size(); ++p)
  {
    const bool isFloor = stage.facets.facets[p / 2].material == 0;
    floor = isFloor && stage.Normal(p).z > 0.5 ? p : floor;
  }
  return floor;
}

/// The middles of so many squares along each side.
std::vector<Vec3> PointsOfFloor(int count)
{
  std::vector<Vec3> points;
  const auto at = [count](int k) { return -1.0 + 2.0 * (k + 0.5) / count; };
  for (int i = 0; i < count * count; ++i)
  {
    points.emplace_back(at(i % count), at(i / count), 0.0);
  }
  return points;
}

/// A globe above a floor, past walls, a box, and a pane that passes through it. Oracle: each facet
/// of it as a lamp by itself, which solutions can name as well.
Scene MakeGlobeOverFloor()
{
  Scene scene = MakeLampOverFloor(
    { { { -0.6, 0.35, 0.0 }, { 0.2, 0.45, 0.0 }, { 0.2, 0.45, 0.5 }, { -0.6, 0.35, 0.5 } },
      { { -0.7, -0.1, 0.75 }, { 0.7, -0.1, 0.75 }, { 0.7, 0.1, 0.75 }, { -0.7, 0.1, 0.75 } },
      { { 0.25, -0.5, 0.5 }, { 0.25, 0.5, 0.5 }, { 0.25, 0.5, 1.1 }, { 0.25, -0.5, 1.1 } } },
    { { -0.2, -0.3, 3 }, { -0.2, -0.2, 3 }, { -0.1, -0.2, 3 }, { -0.1, -0.3, 3 } });
  test::AddBox(scene, { -0.6, -0.6, 0.0 }, { -0.3, -0.4, 0.4 }, false, { 2, 2, 2, 2, 2, 2 });
  test::AddBall(scene, { -0.05, 0.0, 0.9 }, 0.2, 8, 1);
  return scene;
}

struct GlobeLight
{
  std::vector<Color> light;
  DirectCounters counters;

  GlobeLight(bool facetByFacet, double tolerance)
  {
    GatherStage stage(MakeGlobeOverFloor(), [](PatchId) { return Color(0.0); });
    const PatchId floor = UpperSideOfFloor(stage);
    const std::vector<Vec3> points = PointsOfFloor(50);
    RadianceSolution::Element& element =
      stage.solution.elements[stage.solution.elementOfPatch[floor]];
    const std::uint32_t last = element.lastLamp;
    this->light.assign(points.size(), Color(0.0));
    for (std::uint32_t lamp = facetByFacet ? 0 : last - 1; lamp < last; ++lamp)
    {
      element.firstLamp = facetByFacet ? lamp : 0;
      element.lastLamp = lamp + 1;
      const std::vector<Color> found =
        DirectLight(stage.occluders, stage.solution, tolerance).At(floor, points, this->counters);
      std::transform(this->light.begin(), this->light.end(), found.begin(), this->light.begin(),
        [](const Color& a, const Color& b) { return a + b; });
    }
  }
};

TEST(DirectLight, AGlobeIsOneLampAndShinesAsItsFacets)
{
  const GlobeLight exact(true, 0.0);
  const GlobeLight whole(false, 0.0);
  const GlobeLight fitted(false, 0.01);
  double brightest = 0.0;
  double sum = 0.0;
  double error = 0.0;
  int dark = 0;
  for (std::size_t i = 0; i < exact.light.size(); ++i)
  {
    ASSERT_LT(glm::length(whole.light[i] - exact.light[i]), 1e-9) << i; // round-off
    brightest = std::max(brightest, exact.light[i].x);
    sum += exact.light[i].x;
    error += std::abs(fitted.light[i].x - exact.light[i].x);
    dark += exact.light[i].x < 0.1 * brightest ? 1 : 0;
  }
  EXPECT_GT(dark, 100);
  EXPECT_LT(error / sum, 0.005); // half of the tolerance in the mean
  EXPECT_LT(whole.counters.lampEvaluations, exact.counters.lampEvaluations / 30);
  EXPECT_LT(fitted.counters.lampEvaluations, whole.counters.lampEvaluations);
  EXPECT_LE(whole.counters.occluderQueries, 2u);
}

/// Of the floor, with a tolerance against what PointToVisiblePolygon() says.
struct FloorError
{
  double mean = 0.0;  ///< relative L1
  double worst = 0.0; ///< of a point, relative to the brightest one
  std::uint64_t cutEvaluations = 0;

  FloorError(const Scene& scene, int size, double tolerance)
  {
    const GatherStage stage(scene, [](PatchId) { return Color(0.0); });
    const LitFloor floor(stage, size, tolerance);
    this->cutEvaluations = floor.counters.cutEvaluations;
    double sum = 0.0;
    double brightest = 0.0;
    for (std::size_t i = 0; i < floor.expected.size(); ++i)
    {
      const double error = MaxChannel(glm::abs(floor.found[i] - floor.expected[i]));
      this->mean += error;
      this->worst = std::max(this->worst, error);
      sum += MaxChannel(floor.expected[i]);
      brightest = std::max(brightest, MaxChannel(floor.expected[i]));
    }
    this->mean /= sum;
    this->worst /= brightest;
  }
};

/// Whether the floor gets the same when nobody knows which bodies are closed, at points in and
/// around them. Returns how much work that knowledge has left.
DirectCounters ExpectSameAsOfOpenBodies(const Scene& scene)
{
  const GatherStage stage(scene, [](PatchId) { return Color(0.0); });
  const OccluderScene knowing(stage.facets, FindDarkSides(stage.facets, scene.materials));
  const PatchId floor = UpperSideOfFloor(stage);
  const std::vector<Vec3> points = PointsOfFloor(60);
  DirectCounters unaware, aware;
  const std::vector<Color> expected =
    DirectLight(stage.occluders, stage.solution).At(floor, points, unaware);
  const std::vector<Color> found = DirectLight(knowing, stage.solution).At(floor, points, aware);
  EXPECT_EQ(unaware.shadowRays, 0u);
  int dark = 0;
  for (std::size_t i = 0; i < points.size(); ++i)
  {
    EXPECT_LT(glm::length(found[i] - expected[i]), 1e-8) << i; // other cuts
    dark += MaxChannel(expected[i]) == 0.0 ? 1 : 0;
  }
  EXPECT_GT(dark, 200); // below the bodies at least
  EXPECT_GT(aware.cutEvaluations, 300u);
  EXPECT_LE(aware.cutEvaluations, unaware.cutEvaluations);
  return aware;
}

/// A globe and a panel above bodies of many facets, one of which meets the globe.
TEST(DirectLight, ClosedBodiesCastTheSameShadowsOfAGlobe)
{
  Scene scene = MakeLampOverFloor({});
  test::AddBall(scene, { -0.2, 0.3, 0.8 }, 0.12, 5, 1);
  test::AddBall(scene, { 0.1, -0.3, 0.45 }, 0.15, 4, 2);
  test::AddBall(scene, { 0.5, 0.5, 0.3 }, 0.3, 4, 2);
  test::AddBall(scene, { -0.2, 0.45, 0.8 }, 0.1, 3, 2);
  test::AddBox(scene, { -0.6, -0.5, 0.0 }, { -0.3, 0.1, 0.5 }, false, { 2, 2, 2, 2, 2, 2 });
  ExpectSameAsOfOpenBodies(scene);
}

/// Bodies beside, above and across each other, on the floor and through it.
TEST(DirectLight, ClosedBodiesCastTheSameShadows)
{
  Scene scene = MakeLampOverFloor({});
  const auto addBox = [&](const Vec3& low, const Vec3& high) {
    test::AddBox(scene, low, high, false, { 2, 2, 2, 2, 2, 2 });
  };
  addBox({ -0.6, -0.5, 0.0 }, { -0.3, 0.1, 0.5 });
  addBox({ -0.4, -0.1, 0.0 }, { 0.0, 0.3, 0.3 });
  addBox({ 0.3, -0.5, -0.2 }, { 0.5, 0.4, 0.2 });
  test::AddBall(scene, { 0.1, -0.3, 0.45 }, 0.15, 4, 2);
  ExpectSameAsOfOpenBodies(scene);
}

TEST(DirectLight, ErrsByLessThanItsToleranceAndTakesLess)
{
  const Scene scene = MakeLampOverFloor(Occluders);
  const FloorError exact(scene, 128, 0.0);
  const FloorError fine(scene, 128, 0.001);
  const FloorError coarse(scene, 128, 0.01);
  EXPECT_LT(exact.mean, 1e-9);
  EXPECT_LT(fine.mean, 0.3 * 0.001);
  EXPECT_LT(coarse.mean, 0.3 * 0.01);
  EXPECT_GT(coarse.mean, 2.0 * fine.mean);
  EXPECT_LT(fine.worst, 2.0 * 0.001); // kinks of the light lie between the places of a fit
  EXPECT_LT(coarse.worst, 2.0 * 0.01);
  EXPECT_LT(coarse.cutEvaluations, 0.7 * exact.cutEvaluations);
}

TEST(DirectLight, IsExactWhereNothingIsInBetweenWhateverTheTolerance)
{
  EXPECT_LT(FloorError(MakeLampOverFloor({}), 128, 0.1).worst, 1e-12);
}

/// All light comes through a slot that shows a fortieth of the lamp: that is what errors count
/// against, not what would come with nothing in the way.
TEST(DirectLight, ErrsByItsToleranceOfWhatASlotLetsThrough)
{
  const Scene scene = MakeLampOverFloor(
    { { { -3.0, -3.0, 0.9 }, { -0.006, -3.0, 0.9 }, { -0.006, 3.0, 0.9 }, { -3.0, 3.0, 0.9 } },
      { { 0.006, -3.0, 0.9 }, { 3.0, -3.0, 0.9 }, { 3.0, 3.0, 0.9 }, { 0.006, 3.0, 0.9 } } });
  const FloorError error(scene, 128, 0.01);
  EXPECT_LT(error.mean, 0.3 * 0.01);
  EXPECT_LT(error.worst, 2.0 * 0.01);
}

/// Wires below a small lamp: each shadow is a few pixels wide, and lies between the places of fits.
TEST(DirectLight, ThinShadowsAreNotLost)
{
  std::vector<std::vector<Vec3>> wires;
  for (int i = 0; i < 4; ++i)
  {
    const double x = -0.5 + 0.29 * i;
    wires.push_back({ { x, -0.7, 0.2 }, { x + 0.012, -0.7, 0.2 }, { x + 0.312, 0.7, 0.25 },
      { x + 0.3, 0.7, 0.25 } });
  }
  const Scene scene = MakeLampOverFloor(
    wires, { { -0.02, -0.02, 1 }, { -0.02, 0.02, 1 }, { 0.02, 0.02, 1 }, { 0.02, -0.02, 1 } });
  for (const double tolerance : { 0.001, 0.01 })
  {
    const FloorError error(scene, 160, tolerance);
    EXPECT_LT(error.mean, 0.3 * tolerance);
    EXPECT_LT(error.worst, 4.0 * tolerance);
  }
}

/// One point asked for alone gets what it gets among thousands.
TEST(DirectLight, IsTheSameForOnePointAndForMany)
{
  const GatherStage stage(MakeLampOverFloor(Occluders), [](PatchId) { return Color(0.0); });
  const DirectLight light(stage.occluders, stage.solution);
  PatchId floor = None;
  for (PatchId p = 0; p < stage.tree.Patches().size(); p += 2)
  {
    floor = stage.facets.facets[p / 2].material == 0 ? p : floor;
  }
  RandomStream random(23);
  std::vector<Vec3> points;
  for (int i = 0; i < 3000; ++i)
  {
    points.push_back({ 2.0 * random.Next() - 1.0, 2.0 * random.Next() - 1.0, 0.0 });
  }
  DirectCounters counters;
  const std::vector<Color> all = light.At(floor, points, counters);
  for (int i = 0; i < 3000; i += 10)
  {
    const Color one = light.At(floor, { points[i] }, counters)[0];
    ASSERT_LT(glm::length(one - all[i]), 1e-10) << i;
    ASSERT_LT(glm::length(one - Expected(stage, points[i])), 1e-9) << i;
  }
  // Below the floor is its other side.
  for (const Color& below : light.At(floor + 1, points, counters))
  {
    ASSERT_EQ(below, Color(0.0));
  }
}

/// Narrow blades side by side below the lamp, half as wide as they lie apart.
void AddBlades(int count, double height, bool across, std::vector<std::vector<Vec3>>& blades)
{
  for (int i = 0; i < count; ++i)
  {
    const double low = -0.39 + 0.8 * i / count;
    const double high = low + 0.4 / count;
    blades.push_back(across ? std::vector<Vec3>{ { -1.0, low, height }, { 1.0, low, height },
                                { 1.0, high, height }, { -1.0, high, height } }
                            : std::vector<Vec3>{ { low, -1.0, height }, { high, -1.0, height },
                                { high, 1.0, height }, { low, 1.0, height } });
  }
}

/// Of the radiance of the floor under the blades: the worst relative error of a pixel, and that of
/// all of them together.
struct FloorErrors
{
  double worst = 0.0;
  double mean = 0.0;
  std::uint64_t shadowRays = 0;
};

FloorErrors GatherBelow(const std::vector<std::vector<Vec3>>& blades)
{
  const GatherStage stage(MakeLampOverFloor(blades), [](PatchId) { return Color(0.0); });
  const GatheredView view = stage.Gather(FloorCamera(), Pixels(24, 24, true));
  FloorErrors errors;
  errors.shadowRays = view.report.shadowRays;
  double sum = 0.0;
  double expected = 0.0;
  for (int y = 0; y < 24; ++y)
  {
    for (int x = 0; x < 24; ++x)
    {
      const auto hit = stage.Centre(FloorCamera(), 24, 24, x, y);
      if (hit && stage.facets.facets[hit->facet].material == 0 && hit->side == Side::Front)
      {
        const double exact = Mean(Color(0.6, 0.5, 0.4) / Pi * Expected(stage, hit->point));
        const double found = Mean(view.radiance.At(x, y));
        errors.worst = std::max(errors.worst, std::abs(found - exact) / (exact + 1e-11));
        sum += found;
        expected += exact;
      }
    }
  }
  errors.mean = sum / expected - 1.0;
  return errors;
}

TEST(DirectLight, ShadowsOfManyBladesAreCut)
{
  std::vector<std::vector<Vec3>> blades;
  AddBlades(40, 0.5, false, blades);
  const FloorErrors errors = GatherBelow(blades);
  EXPECT_EQ(errors.shadowRays, 0u);
  EXPECT_LT(errors.worst, 1e-6); // pictures are in single precision
}

/// More parts of the lamp than are cut: a thicket that leaves little squares.
TEST(DirectLight, RaysDecideBehindAThicket)
{
  std::vector<std::vector<Vec3>> blades;
  AddBlades(60, 0.5, false, blades);
  AddBlades(60, 0.45, true, blades);
  const FloorErrors errors = GatherBelow(blades);
  EXPECT_GT(errors.shadowRays, 1000u);
  EXPECT_LT(
    errors.worst, 0.32); // three deviations of 256 independent rays, of which a quarter pass
  EXPECT_NEAR(errors.mean, 0.0, 0.005);
}

TEST(DirectLight, UnnamedLampsCountAsTheirElementSays)
{
  GatherStage stage(MakeLampOverFloor({}), [](PatchId) { return Color(0.0); });
  for (RadianceSolution::Element& element : stage.solution.elements)
  {
    element.firstLamp = element.lastLamp;
    element.unnamedDirect = Color(0.3, 0.2, 0.1);
  }
  const GatheredView view = stage.Gather(FloorCamera(), Pixels(9, 9, true));
  const Color expected = Color(0.6, 0.5, 0.4) / Pi * Color(0.3, 0.2, 0.1);
  EXPECT_LT(glm::length(view.radiance.At(4, 4) - expected), 1e-15);
  EXPECT_EQ(view.report.lampEvaluations, 0u);
}

/// The lamp's own plane, its two sides, and a lamp that cuts through the floor.
TEST(DirectLight, LampsInOddPlacesShineWhereTheyShould)
{
  Scene scene;
  const std::uint32_t white = AddMaterial(scene, Color(0.5));
  const std::uint32_t lamp = AddMaterial(scene, Color(0.5), Color(4.0));
  scene.AddPolygon({ { -1, -1, 0 }, { 1, -1, 0 }, { 1, 1, 0 }, { -1, 1, 0 } }, white);
  // In the plane of the floor's continuation, facing up.
  scene.AddPolygon({ { 1, -1, 0 }, { 2, -1, 0 }, { 2, 1, 0 }, { 1, 1, 0 } }, lamp);
  // Upright, half below the floor, facing -x; it reflects nothing.
  scene.AddPolygon({ { 3, -1, -1 }, { 3, -1, 1 }, { 3, 1, 1 }, { 3, 1, -1 } },
    AddMaterial(scene, Color(0.0), Color(4.0)));
  const GatherStage stage(scene, [](PatchId) { return Color(0.0); });
  const Camera camera = test::CameraAt({ 0.0, -0.1, 2.0 }, { 0.0, 0.0, 0.0 }, 10.0);
  const Color pixel = stage.Gather(camera, Pixels(1, 1, true)).radiance.At(0, 0);
  const Polygon upright{ { 3, -1, -1 }, { 3, -1, 1 }, { 3, 1, 1 }, { 3, 1, -1 } };
  const double factor = PointToPolygon(Vec3(0.0), { 0.0, 0.0, 1.0 }, upright);
  ASSERT_GT(factor, 0.01);
  EXPECT_NEAR(pixel.x, 0.5 / Pi * 4.0 * factor, 1e-9);
  // The lamp itself: emission, and no light from itself.
  const Camera onLamp = test::CameraAt({ 1.5, -0.1, 2.0 }, { 1.5, 0.0, 0.0 }, 10.0);
  const double seen = PointToPolygon({ 1.5, 0.0, 0.0 }, { 0.0, 0.0, 1.0 }, upright);
  EXPECT_NEAR(stage.Gather(onLamp, Pixels(1, 1, true)).radiance.At(0, 0).x,
    4.0 + 0.5 / Pi * 4.0 * seen, 1e-9);
}

} // namespace
} // namespace vantage
