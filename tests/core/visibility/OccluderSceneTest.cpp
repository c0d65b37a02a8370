#include "core/visibility/OccluderScene.h"

#include "core/mesh/DarkSides.h"
#include "core/visibility/TestScenes.h"
#include "support/TestScenes.h"

#include <gtest/gtest.h>
#include <tbb/global_control.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>

namespace vantage
{
namespace
{

using namespace testing;

/// Millimetres to kilometres, at the origin and far from it.
const std::vector<Placement> Placements{ { 1.0, Vec3(0.0) }, { 1e-3, Vec3(0.0) },
  { 1e3, Vec3(0.0) }, { 1e6, Vec3(0.0) }, { 1.0, Vec3(1e7, -1e7, 1e7) },
  { 1000.0, Vec3(-1e7, 1e7, 3.0) } };

std::string Print(const Placement& place)
{
  return "scale " + std::to_string(place.scale) + ", offset " + std::to_string(place.offset.x);
}

/// A floor in two halves that meet under a wall without thickness, and a ceiling.
std::vector<std::vector<Vec3>> RoomWithWall()
{
  return { { { 0, 0, 0 }, { 0.5, 0, 0 }, { 0.5, 1, 0 }, { 0, 1, 0 } },
    { { 0.5, 0, 0 }, { 1, 0, 0 }, { 1, 1, 0 }, { 0.5, 1, 0 } },
    { { 0.5, 0, 0 }, { 0.5, 1, 0 }, { 0.5, 1, 1 }, { 0.5, 0, 1 } },
    { { 0, 0, 1 }, { 0, 1, 1 }, { 1, 1, 1 }, { 1, 0, 1 } } };
}

/// The slow twin: every facet in turn, as two triangles or one, by the signs of volumes.
bool IsOccludedSlowly(const FacetSet& set, const SurfacePoint& p, const SurfacePoint& q)
{
  const auto volume = [](const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d)
  { return glm::dot(glm::cross(b - a, c - a), d - a); };
  for (std::uint32_t f = 0; f < set.facets.size(); ++f)
  {
    const Polygon& s = set.facets[f].shape;
    for (int i = 2; i < s.Size() && f != p.facet && f != q.facet; ++i)
    {
      const double side = volume(s[0], s[i - 1], s[i], p.position);
      const double a = volume(p.position, q.position, s[0], s[i - 1]);
      const double b = volume(p.position, q.position, s[i - 1], s[i]);
      const double c = volume(p.position, q.position, s[i], s[0]);
      if (side * volume(s[0], s[i - 1], s[i], q.position) < 0.0 &&
          ((a > 0 && b > 0 && c > 0) || (a < 0 && b < 0 && c < 0)))
      {
        return true;
      }
    }
  }
  return false;
}

TEST(OccluderScene, AgreesWithTheSlowTwinOnSoup)
{
  const FacetSet set = FacetsOf(TriangleSoup(300, 0.4, 7));
  const OccluderScene occluders(set);
  int occluded = 0;
  for (std::uint64_t i = 0; i < 20000; ++i)
  {
    SCOPED_TRACE("pair " + std::to_string(i));
    RandomStream random(11, i);
    const auto f = static_cast<std::uint32_t>(random.Next() * set.facets.size());
    const auto g = static_cast<std::uint32_t>(random.Next() * set.facets.size());
    const SurfacePoint p{ PointAt(set.facets[f].shape, random.Next2()), f };
    const SurfacePoint q{ PointAt(set.facets[g].shape, random.Next2()), g };
    const bool expected = f != g && IsOccludedSlowly(set, p, q);
    occluded += expected ? 1 : 0;
    ASSERT_EQ(f != g && occluders.IsOccluded(p, q), expected);
    ASSERT_EQ(f != g && occluders.IsOccluded(q, p), expected);
    ASSERT_EQ(f != g && occluders.FirstOccluder(p, q).has_value(), expected);
  }
  EXPECT_GT(occluded, 2000);
  EXPECT_LT(occluded, 18000);
}

TEST(OccluderScene, WallOnFloorLetsNothingThroughAndHidesNothingOnItsOwnSide)
{
  for (const Placement& place : Placements)
  {
    SCOPED_TRACE(Print(place));
    const FacetSet set = FacetsOf(RoomWithWall(), place);
    const OccluderScene occluders(set);
    const std::uint32_t left = FacetAt(set, place({ 0.25, 0.5, 0 }));
    const std::uint32_t right = FacetAt(set, place({ 0.75, 0.5, 0 }));
    const std::uint32_t ceiling = FacetAt(set, place({ 0.25, 0.5, 1 }));
    const std::uint32_t wall = FacetAt(set, place({ 0.5, 0.5, 0.5 }));
    for (std::uint64_t i = 0; i < 5000; ++i)
    {
      SCOPED_TRACE("position " + std::to_string(i));
      RandomStream random(3, i);
      // Distances from the wall between 1e-5 and 0.1, evenly on a logarithmic scale.
      const double near = 1e-5 * std::pow(1e4, random.Next());
      const double y = random.Next();
      const double x = 0.5 * random.Next();
      const double far = i % 2 == 0 ? x : 0.5 - near;
      const SurfacePoint foot{ place({ 0.5 + near, y, 0 }), right };
      const SurfacePoint here{ place({ 1.0 - far, random.Next(), 1 }), ceiling };
      const SurfacePoint there{ place({ far, random.Next(), 1 }), ceiling };
      const SurfacePoint otherFloor{ place({ 0.5 - near, y, 0 }), left };
      const SurfacePoint onWall{ place({ 0.5, random.Next(), near }), wall };
      ASSERT_FALSE(occluders.IsOccluded(foot, here));
      ASSERT_FALSE(occluders.IsOccluded(here, foot));
      ASSERT_TRUE(occluders.IsOccluded(foot, there));
      ASSERT_TRUE(occluders.IsOccluded(there, foot));
      ASSERT_TRUE(occluders.IsOccluded(otherFloor, here));
      ASSERT_FALSE(occluders.IsOccluded(foot, onWall));
      ASSERT_FALSE(occluders.IsOccluded(onWall, otherFloor));
      ASSERT_FALSE(occluders.IsOccluded(onWall, here));
    }
  }
}

TEST(OccluderScene, GrazingRaysNearTheFootOfTheWallDoNotLeak)
{
  for (const Placement& place : Placements)
  {
    SCOPED_TRACE(Print(place));
    const FacetSet set = FacetsOf(RoomWithWall(), place);
    const OccluderScene occluders(set);
    const std::uint32_t right = FacetAt(set, place({ 0.75, 0.5, 0 }));
    const std::uint32_t wall = FacetAt(set, place({ 0.5, 0.5, 0.5 }));
    for (int i = 0; i < 1000; ++i)
    {
      SCOPED_TRACE(i);
      const double elevation = 1e-3 * (1 + i % 10);
      const double y = 0.0005 + 0.999 * i / 1000;
      const auto hit =
        occluders.Intersect(place({ 0.50001, y, 0 }), { -1.0, 0.0, elevation }, right);
      ASSERT_TRUE(hit);
      ASSERT_EQ(hit->facet, wall);
    }
  }
}

/// The faces of a turned box of quadrilaterals, subdivided so that many edges are shared.
std::vector<std::vector<Vec3>> TurnedBox(int n)
{
  const Frame frame(glm::normalize(Vec3(1, 2, 3)));
  std::vector<std::vector<Vec3>> faces;
  for (const auto& face : BoxFaces({ 0, 0, 0 }, { 1, 1, 1 }))
  {
    for (int i = 0; i < n * n; ++i)
    {
      const auto corner = [&](int u, int v)
      {
        const double s = static_cast<double>(u) / n;
        const double t = static_cast<double>(v) / n;
        return frame.ToWorld(face[0] + s * (face[1] - face[0]) + t * (face[3] - face[0]));
      };
      const int u = i % n;
      const int v = i / n;
      faces.push_back({ corner(u, v), corner(u + 1, v), corner(u + 1, v + 1), corner(u, v + 1) });
    }
  }
  return faces;
}

TEST(OccluderScene, NothingEscapesFromAClosedBox)
{
  for (const Placement& place : Placements)
  {
    SCOPED_TRACE(Print(place));
    const FacetSet set = FacetsOf(TurnedBox(4), place);
    const OccluderScene occluders(set);
    for (std::uint64_t i = 0; i < 20000; ++i)
    {
      SCOPED_TRACE("ray " + std::to_string(i));
      RandomStream random(5, i);
      const auto f = static_cast<std::uint32_t>(random.Next() * set.facets.size());
      const Polygon& shape = set.facets[f].shape;
      const Vec3 origin = PointAt(shape, random.Next2());
      Vec3 direction = Frame(UnitNormal(shape)).ToWorld(CosineHemisphere(random.Next2()));
      if (i % 4 == 0)
      {
        // Straight at a corner of another facet, where edges meet.
        direction = set.facets[(f + 29) % set.facets.size()].shape[0] - origin;
        if (glm::dot(direction, UnitNormal(shape)) < 1e-3 * place.scale)
        {
          continue;
        }
      }
      const auto hit = occluders.Intersect(origin, direction, f);
      ASSERT_TRUE(hit);
      ASSERT_EQ(hit->side, Side::Front);
      // The hit lies on the facet's plane and on the ray: round-off of the coordinates.
      const Plane plane = SupportingPlane(set.facets[hit->facet].shape);
      const double roundOff = 2.0 * occluders.Tolerance();
      ASSERT_NEAR(plane.Distance(hit->point), 0.0, roundOff);
      ASSERT_NEAR(glm::length(hit->point - origin - hit->distance * direction), 0.0, roundOff);
    }
  }
}

TEST(OccluderScene, FacetsThatAreNotQuiteFlatMeetWithoutGaps)
{
  // Corners moved by what single precision leaves; triangles share every edge exactly.
  auto faces = TurnedBox(4);
  for (auto& face : faces)
  {
    for (Vec3& v : face)
    {
      v = Vec3(glm::vec3(v * 0.9));
    }
  }
  const FacetSet set = FacetsOf(faces);
  const OccluderScene occluders(set);
  const Vec3 middle = 0.5 * (set.low + set.high);
  for (std::size_t f = 0; f < set.facets.size(); ++f)
  {
    const Polygon& shape = set.facets[f].shape;
    for (int i = 0; i <= 100; ++i)
    {
      const Vec3 target = shape[0] + 0.01 * i * (shape[1] - shape[0]);
      ASSERT_TRUE(occluders.Intersect(middle, target - middle)) << f << " " << i;
    }
  }
}

TEST(OccluderScene, RaysThatSinglePrecisionWouldMissHitToo)
{
  // Aimed 4e-9 inside the edges of panes whose edges are those of their bounding boxes: a tenth of
  // what single precision tells apart.
  std::vector<std::vector<Vec3>> panes;
  RandomStream places(13);
  for (int i = 0; i < 200; ++i)
  {
    const Vec3 a = RandomPoint(places);
    const Vec2 size = 0.05 * (places.Next2() + 0.1);
    panes.push_back({ a, a + Vec3(size.x, 0, 0), a + Vec3(size, 0), a + Vec3(0, size.y, 0) });
  }
  const FacetSet set = FacetsOf(panes);
  const OccluderScene occluders(set);
  for (std::uint64_t i = 0; i < 20000; ++i)
  {
    SCOPED_TRACE("ray " + std::to_string(i));
    RandomStream random(41, i);
    const auto f = static_cast<std::uint32_t>(random.Next() * set.facets.size());
    const Polygon& shape = set.facets[f].shape;
    const int k = static_cast<int>(i % 4);
    const Vec3 onEdge = shape[k] + (0.1 + 0.8 * random.Next()) * (shape[(k + 1) % 4] - shape[k]);
    const Vec3 target = onEdge + 4e-9 * glm::normalize(Centroid(shape) - onEdge);
    const Vec3 eye = 3.0 * RandomPoint(random) - 1.0;
    const auto hit = occluders.Intersect(eye, target - eye);
    ASSERT_TRUE(hit);
    ASSERT_LE(hit->distance, 1.0 + 1e-12);
  }
}

TEST(OccluderScene, SidesAndDistancesAreThoseOfTheGeometry)
{
  const FacetSet set = FacetsOf({ { { 0, 0, 0 }, { 1, 0, 0 }, { 1, 1, 0 }, { 0, 1, 0 } },
    { { 0, 0, -2 }, { 1, 0, -2 }, { 1, 1, -2 }, { 0, 1, -2 } } });
  const OccluderScene occluders(set);
  const std::uint32_t upper = FacetAt(set, { 0.5, 0.5, 0 });
  const auto above = occluders.Intersect({ 0.25, 0.5, 3 }, { 0, 0, -2 });
  ASSERT_TRUE(above);
  EXPECT_EQ(above->facet, upper);
  EXPECT_EQ(above->side, Side::Front);
  EXPECT_DOUBLE_EQ(above->distance, 1.5);
  EXPECT_NEAR(glm::length(above->point - Vec3(0.25, 0.5, 0)), 0.0, 1e-15);
  const auto below = occluders.Intersect({ 0.25, 0.5, -1 }, { 0, 0, 1 });
  ASSERT_TRUE(below);
  EXPECT_EQ(below->facet, upper);
  EXPECT_EQ(below->side, Side::Back);
  EXPECT_EQ(below->Patch(), PatchOf(upper, Side::Back));
  EXPECT_FALSE(occluders.Intersect({ 2, 2, 2 }, { 1, 0, 0 }));
  EXPECT_FALSE(occluders.Intersect({ 0.5, 0.5, 1 }, { 0, 0, 0 }));
  EXPECT_NE(occluders.Intersect({ 0.5, 0.5, 1 }, { 0, 0, -1 }, upper)->facet, upper);
}

TEST(OccluderScene, AnEyeFarOutsideHitsAsPreciselyAsANearOne)
{
  const FacetSet set = FacetsOf(BoxFaces({ -1, -1, -1 }, { 1, 1, 1 }));
  const OccluderScene occluders(set);
  for (const double distance : { 10.0, 1e4, 1e7 })
  {
    for (int i = 0; i < 100; ++i)
    {
      const Vec3 target(-0.99 + 0.02 * i, 0.3, 1.0);
      const Vec3 eye(0.0, 0.0, distance);
      const auto hit = occluders.Intersect(eye, (target - eye) / distance);
      ASSERT_TRUE(hit);
      // Round-off of the eye's coordinates, a few times over.
      EXPECT_NEAR(glm::length(hit->point - target), 0.0, 4e-16 * distance + 1e-15);
    }
  }
}

TEST(OccluderScene, BoxesFindTheFacetsThatReachIntoThem)
{
  const FacetSet set = FacetsOf(TurnedBox(3));
  const OccluderScene occluders(set);
  RandomStream random(9);
  for (int i = 0; i < 200; ++i)
  {
    const Vec3 centre = set.low + RandomPoint(random) * (set.high - set.low);
    const Vec3 half = 0.3 * RandomPoint(random);
    const auto found = occluders.FacetsInBox(centre - half, centre + half);
    for (std::uint32_t f = 0; f < set.facets.size(); ++f)
    {
      // Slow twin: does a dense set of points of the facet meet the box? Between the points nothing
      // is known, so the twin only bounds the answer from below.
      bool meets = false;
      for (int k = 0; k < 400 && !meets; ++k)
      {
        const Vec3 x = PointAt(set.facets[f].shape, { (k % 20) / 19.0, (k / 20) / 19.0 });
        meets = glm::all(glm::lessThanEqual(glm::abs(x - centre), half));
      }
      const bool isFound = std::binary_search(found.begin(), found.end(), f);
      ASSERT_TRUE(!meets || isFound);
      const bool boxesMeet =
        glm::all(glm::lessThanEqual(glm::abs(Centroid(set.facets[f].shape) - centre),
          half + RadiusAround(set.facets[f].shape, Centroid(set.facets[f].shape))));
      ASSERT_TRUE(!isFound || boxesMeet);
    }
  }
  EXPECT_EQ(occluders.FacetsInBox(set.low, set.high).size(), set.facets.size());
  EXPECT_TRUE(occluders.FacetsInBox(set.high + 1.0, set.high + 2.0).empty());
}

TEST(OccluderScene, AnswersDoNotDependOnTheNumberOfThreads)
{
  const FacetSet set = FacetsOf(TriangleSoup(500, 0.3, 21));
  const OccluderScene occluders(set);
  const auto trace = [&](int threads)
  {
    const tbb::global_control control(tbb::global_control::max_allowed_parallelism, threads);
    std::vector<double> distances(20000, -1.0);
    tbb::parallel_for(0, 20000,
      [&](int i)
      {
        RandomStream random(1, i);
        const Vec3 origin = RandomPoint(random);
        if (const auto hit = occluders.Intersect(origin, RandomPoint(random) - 0.5))
        {
          distances[i] = hit->distance + hit->facet;
        }
      });
    return distances;
  };
  EXPECT_EQ(trace(1), trace(4));
}

TEST(OccluderScene, TracingLeavesTheCallersArithmeticAlone)
{
  const OccluderScene occluders(FacetsOf(BoxFaces({ 0, 0, 0 }, { 1, 1, 1 })));
  occluders.Intersect({ 0.5, 0.5, 0.5 }, { 1, 0, 0 });
  volatile double tiny = 1e-300;
  EXPECT_GT(tiny * 1e-10, 0.0);
}

TEST(OccluderScene, KnowsTheInsideOfAClosedBody)
{
  const Scene scene = test::MakeLitBox(); // with a block in it
  const FacetSet facets = BuildFacets(scene);
  const OccluderScene unaware(facets);
  const OccluderScene aware(facets, FindDarkSides(facets, scene.materials));
  int insides = 0;
  for (std::uint32_t f = 0; f < aware.FacetCount(); ++f)
  {
    EXPECT_FALSE(unaware.InsideOf(f));
    const auto inside = aware.InsideOf(f);
    EXPECT_EQ(inside.has_value(), facets.facets[f].material == 4);
    if (inside)
    {
      EXPECT_EQ(inside->side, Side::Back);
      EXPECT_EQ(inside->body.Low(), Vec3(0.55, 0.5, 0.0));
      EXPECT_EQ(inside->body.High(), Vec3(0.85, 0.8, 0.4));
      ++insides;
    }
  }
  EXPECT_EQ(insides, 6);
}

} // namespace
} // namespace vantage
