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

} // namespace
} // namespace vantage
