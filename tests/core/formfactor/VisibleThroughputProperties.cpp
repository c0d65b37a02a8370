#include "core/formfactor/FormFactor.h"
#include "core/formfactor/Shapes.h"
#include "core/formfactor/SlowThroughput.h"

#include <gtest/gtest.h>

namespace vantage
{
namespace
{

struct OccludedPair
{
  Polygon a, b;
  std::vector<Polygon> occluders;
};

OccludedPair MakeOccludedPair(std::uint64_t seed)
{
  RandomStream random(seed, 9);
  const Vec3 direction = RandomDirection(random);
  const Vec3 normalA = glm::normalize(direction + 0.8 * RandomDirection(random));
  const Vec3 normalB = glm::normalize(-direction + 0.8 * RandomDirection(random));
  OccludedPair pair;
  pair.a = RandomPolygon(random, Vec3(0.0), normalA, 0.6);
  pair.b = RandomPolygon(random, 3.0 * direction, normalB, 0.6);
  const int count = 1 + static_cast<int>(3.0 * random.Next());
  for (int i = 0; i < count; ++i)
  {
    const Vec3 c = 3.0 * random.Next() * direction + 0.7 * RandomDirection(random);
    pair.occluders.push_back(RandomPolygon(random, c, RandomDirection(random), 0.5));
    for (int k = 0; k < pair.occluders.back().Size(); ++k)
    {
      Vec3& v = pair.occluders.back()[k];
      v = c + 0.6 * (v - c);
    }
  }
  return pair;
}

TEST(OccludedPairs, AgreeWithRays)
{
  for (std::uint64_t seed = 0; seed < 12; ++seed)
  {
    SCOPED_TRACE(testing::Message() << "seed " << seed);
    const OccludedPair pair = MakeOccludedPair(seed);
    const double open = Throughput(pair.a, pair.b);
    // A quadrilateral with coincident corners is a triangle; the grid needs four.
    const auto quad = [](Polygon p)
    {
      if (p.Size() == 3)
      {
        p.Add(p[2]);
      }
      return p;
    };
    const double rays = SlowVisibleThroughput(quad(pair.a), quad(pair.b), pair.occluders, 32);
    // 32^4 rays; the shadow borders are known to a part of a cell.
    EXPECT_NEAR(VisibleThroughput(pair.a, pair.b, pair.occluders), rays, 4e-3 * open);
  }
}

TEST(OccludedPairs, AreReciprocalUnderMotion)
{
  for (std::uint64_t seed = 0; seed < 40; ++seed)
  {
    SCOPED_TRACE(testing::Message() << "seed " << seed);
    const OccludedPair pair = MakeOccludedPair(seed);
    const double there = VisibleThroughput(pair.a, pair.b, pair.occluders);
    EXPECT_EQ(VisibleThroughput(pair.b, pair.a, pair.occluders), there);
    // Turned around, the other polygon is the one that is integrated over.
    Motion motion;
    motion.frame = Frame(glm::normalize(Vec3(-1.0, 0.2, -0.4)));
    motion.scale = 30.0;
    OccludedPair moved{ motion(pair.a), motion(pair.b), {} };
    for (const Polygon& occluder : pair.occluders)
    {
      moved.occluders.push_back(motion(occluder));
    }
    const double back = VisibleThroughput(moved.b, moved.a, moved.occluders) / (30.0 * 30.0);
    EXPECT_NEAR(back, there, 2e-4 * there + 1e-12); // the accuracy of both
    EXPECT_GE(there, 0.0);
    EXPECT_LE(there, Throughput(pair.a, pair.b) * (1.0 + 1e-4));
  }
}

TEST(OccludedPairs, DefaultAgreesWithReference)
{
  for (std::uint64_t seed = 0; seed < 20; ++seed)
  {
    SCOPED_TRACE(testing::Message() << "seed " << seed);
    const OccludedPair pair = MakeOccludedPair(seed);
    const double fine = VisibleThroughput(pair.a, pair.b, pair.occluders, Accuracy::Reference);
    EXPECT_NEAR(VisibleThroughput(pair.a, pair.b, pair.occluders), fine, 1e-4 * fine + 1e-12);
  }
}

TEST(OccludedPairs, AddUpOverTheParts)
{
  for (std::uint64_t seed = 0; seed < 20; ++seed)
  {
    SCOPED_TRACE(testing::Message() << "seed " << seed);
    const OccludedPair pair = MakeOccludedPair(seed);
    const Vec3 c = Centroid(pair.b);
    double sum = 0.0;
    for (int i = 0; i < pair.b.Size(); ++i)
    {
      const Polygon part{ c, pair.b[i], pair.b[(i + 1) % pair.b.Size()] };
      sum += VisibleThroughput(pair.a, part, pair.occluders);
    }
    const double whole = VisibleThroughput(pair.a, pair.b, pair.occluders);
    EXPECT_NEAR(sum, whole, 2e-4 * whole + 1e-12); // the accuracy of both
  }
}

/// What the light through a point with normal n brings from a to b: the part of b that the point
/// sees straight behind it when looking at a.
double BehindPoint(const Vec3& x, const Vec3& n, const Polygon& a, const Polygon& b)
{
  Polygon rest = b;
  for (int i = 0; i < a.Size(); ++i)
  {
    const Vec3 across = glm::normalize(glm::cross(a[(i + 1) % a.Size()] - a[i], a[i] - x));
    const double side = glm::dot(across, Centroid(a) - x) > 0.0 ? -1.0 : 1.0;
    rest = ClipToFront(rest, { side * across, side * glm::dot(across, x) });
  }
  return PointToPolygon(x, n, rest);
}

/// The same for all points of a polygon, on a grid that is fine where halving it changes the sum.
double Through(const Polygon& quad, const Vec3& n, const Polygon& a, const Polygon& b,
  double tolerance, int level)
{
  const auto rule = [&](const Polygon& q)
  {
    // Gauss, three points a side: exact to the fifth degree.
    const double nodes[] = { 0.5 - std::sqrt(0.15), 0.5, 0.5 + std::sqrt(0.15) };
    const double weights[] = { 5.0 / 18.0, 8.0 / 18.0, 5.0 / 18.0 };
    double sum = 0.0;
    for (int i = 0; i < 9; ++i)
    {
      const Vec2 uv(nodes[i / 3], nodes[i % 3]);
      sum += weights[i / 3] * weights[i % 3] * AreaElementAt(q, uv) *
             BehindPoint(PointAt(q, uv), n, a, b);
    }
    return sum;
  };
  const std::vector<Polygon> quarters = Quartered(quad);
  double sum = 0.0;
  for (const Polygon& quarter : quarters)
  {
    sum += rule(quarter);
  }
  if ((level >= 3 && std::abs(sum - rule(quad)) < tolerance) || level >= 12)
  {
    return sum;
  }
  sum = 0.0;
  for (const Polygon& quarter : quarters)
  {
    sum += Through(quarter, n, a, b, 0.5 * tolerance, level + 1);
  }
  return sum;
}

void ExpectTheRest(const Polygon& occluder, double hidden)
{
  const double expected = Throughput(Floor(), Ceiling(1), Accuracy::Reference) - hidden;
  EXPECT_NEAR(VisibleThroughput(Floor(), Ceiling(1), { occluder }) / expected, 1.0, 1e-4);
  const double fine = VisibleThroughput(Floor(), Ceiling(1), { occluder }, Accuracy::Reference);
  EXPECT_NEAR(fine / expected, 1.0, 1e-6);
}

const Frame Level(Vec3(0, 0, 1));

// Close above a floor that reaches farther than its shadows, an occluder takes away exactly what it
// would itself receive from the ceiling.
TEST(SmallOccluders, TakeAwayWhatTheyReceive)
{
  for (std::uint64_t seed = 0; seed < 200; ++seed)
  {
    SCOPED_TRACE(testing::Message() << "seed " << seed);
    RandomStream random(seed, 3);
    const double x = 0.2 + 0.6 * random.Next();
    const double y = 0.2 + 0.6 * random.Next();
    const double radius = 0.03 + 0.05 * random.Next();
    const Polygon small = Regular(Vec3(x, y, 0.05), Level, radius, 5, random.Next());
    ExpectTheRest(small, Throughput(small, Ceiling(1), Accuracy::Reference));
  }
}

// Anywhere between floor and ceiling, and across their borders, an occluder takes away the light
// that would pass through it.
TEST(SmallOccluders, TakeAwayWhatPassesThroughThem)
{
  for (std::uint64_t seed = 0; seed < 100; ++seed)
  {
    SCOPED_TRACE(testing::Message() << "seed " << seed);
    RandomStream random(seed, 11);
    const double x = random.Next();
    const double y = random.Next();
    const double z = 0.1 + 0.8 * random.Next();
    const double radius = 0.02 + 0.06 * random.Next();
    const Frame frame(RandomDirection(random));
    const Polygon small = Regular(Vec3(x, y, z), frame, radius, 4, random.Next());
    const double hidden = Through(small, frame.z, Floor(), Ceiling(1), 1e-9, 0) +
                          Through(small, -frame.z, Floor(), Ceiling(1), 1e-9, 0);
    ExpectTheRest(small, hidden);
  }
}

// Close under the ceiling, an occluder leaves rims of light beside shadows that are complete.
TEST(LargeOccluders, LeaveWhatPassesBesideThem)
{
  for (std::uint64_t seed = 0; seed < 30; ++seed)
  {
    SCOPED_TRACE(testing::Message() << "seed " << seed);
    RandomStream random(seed, 13);
    const Vec3 centre(random.Next(), random.Next(), 0.93 + 0.05 * random.Next());
    const double radius = 0.2 + 0.3 * random.Next();
    const Polygon large = Regular(centre, Level, radius, 4, random.Next());
    const double hidden = Through(large, Level.z, Floor(), Ceiling(1), 1e-9, 0) +
                          Through(large, -Level.z, Floor(), Ceiling(1), 1e-9, 0);
    const double expected = Throughput(Floor(), Ceiling(1), Accuracy::Reference) - hidden;
    EXPECT_NEAR(VisibleThroughput(Floor(), Ceiling(1), { large }) / expected, 1.0, 1e-4);
  }
}

} // namespace
} // namespace vantage
