#include "core/formfactor/FormFactor.h"
#include "core/formfactor/Shapes.h"
#include "core/formfactor/SlowThroughput.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace vantage
{
namespace
{

enum class Kind
{
  General, ///< any distance, partly behind each other
  SharedVertex,
  SharedEdge,
  NearlyCoincident, ///< 1e-4 apart, at an angle of up to 0.01, so that some cut each other
  Sliver,           ///< 1 : 1000
  TouchingSliver
};

struct Pair
{
  Polygon a, b;
};

Polygon Shifted(Polygon p, const Vec3& by)
{
  for (int i = 0; i < p.Size(); ++i)
  {
    p[i] += by;
  }
  return p;
}

Pair MakePair(Kind kind, std::uint64_t seed)
{
  RandomStream random(seed, static_cast<int>(kind));
  const Vec3 normalA = RandomDirection(random);
  const Vec3 normalB = RandomDirection(random);
  const bool isSliver = kind == Kind::Sliver || kind == Kind::TouchingSliver;
  const double aspect = isSliver ? 1e-3 : 0.2 + 0.8 * random.Next();
  const Polygon a = RandomPolygon(random, Vec3(0.0), normalA, aspect);
  switch (kind)
  {
    case Kind::SharedVertex:
    case Kind::TouchingSliver:
    {
      const Polygon b = RandomPolygon(random, Vec3(0.0), normalB, 0.7);
      return { a, Shifted(b, a[1] - b[0]) };
    }
    case Kind::SharedEdge:
    {
      const Vec3 edge = a[1] - a[0];
      const Vec3 up = normalA + 0.7 * RandomDirection(random);
      const double t = random.Next();
      // A triangle on part of the edge, seen from the inside.
      const Vec3 from = a[0] + 0.5 * t * edge;
      Polygon b{ from, a[1], from + t * edge + up };
      const bool inwards = glm::dot(AreaNormal(b), Centroid(a) - a[0]) > 0.0;
      return { a, inwards ? b : Reversed(b) };
    }
    case Kind::NearlyCoincident:
    {
      const double tilt = std::pow(10.0, -2.0 - 3.0 * random.Next());
      const Polygon b = RandomPolygon(
        random, Vec3(0.0), glm::normalize(-normalA + tilt * RandomDirection(random)), 0.8);
      const Vec3 aside = 0.5 * glm::cross(normalA, RandomDirection(random));
      return { a, Shifted(b, 1e-4 * normalA + aside) };
    }
    default:
    {
      const double distance = 0.3 + 3.0 * random.Next();
      return { a,
        RandomPolygon(random, distance * RandomDirection(random), normalB, random.Next() + 0.1) };
    }
  }
}

const char* NameOf(Kind kind)
{
  constexpr const char* names[] = { "General", "SharedVertex", "SharedEdge", "NearlyCoincident",
    "Sliver", "TouchingSliver" };
  return names[static_cast<int>(kind)];
}

class RandomPairs : public testing::TestWithParam<Kind>
{
protected:
  static constexpr std::uint64_t Count = 200;
};

TEST_P(RandomPairs, AgreeWithTheSlowTwin)
{
  int seen = 0;
  for (std::uint64_t seed = 0; seen < 8 && seed < Count; ++seed)
  {
    SCOPED_TRACE(testing::Message() << NameOf(this->GetParam()) << ", seed " << seed);
    const Pair pair = MakePair(this->GetParam(), seed);
    const double fine = Throughput(pair.a, pair.b, Accuracy::Reference);
    const double coarse = Throughput(pair.a, pair.b, Accuracy::Default);
    const double slow = SlowThroughput(pair.a, pair.b, 1e-10 * std::clamp(fine, 1e-6, 1.0));
    seen += slow > 0.0 ? 1 : 0;
    // Cancellation around the contours: 1e-16 of the product of the perimeters, a few times.
    const double rest = 1e-14;
    EXPECT_NEAR(fine, slow, 1e-8 * slow + rest);
    EXPECT_NEAR(coarse, slow, 1e-5 * slow + rest);
  }
  EXPECT_EQ(seen, 8);
}

TEST_P(RandomPairs, AreSoundAndSymmetric)
{
  for (std::uint64_t seed = 0; seed < Count; ++seed)
  {
    SCOPED_TRACE(testing::Message() << NameOf(this->GetParam()) << ", seed " << seed);
    const Pair pair = MakePair(this->GetParam(), seed);
    for (const Accuracy accuracy : { Accuracy::Default, Accuracy::Reference })
    {
      const double g = Throughput(pair.a, pair.b, accuracy);
      EXPECT_EQ(g, Throughput(pair.b, pair.a, accuracy));
      EXPECT_GE(g, 0.0);
      EXPECT_LE(g, Pi * std::min(Area(pair.a), Area(pair.b)) * (1.0 + 1e-15));
    }
  }
}

TEST_P(RandomPairs, DoNotChangeUnderMotionAndScale)
{
  for (std::uint64_t seed = 0; seed < Count; ++seed)
  {
    SCOPED_TRACE(testing::Message() << NameOf(this->GetParam()) << ", seed " << seed);
    const Pair pair = MakePair(this->GetParam(), seed);
    RandomStream random(seed, 77);
    Motion motion;
    motion.frame = Frame(RandomDirection(random));
    motion.scale = std::pow(10.0, 6.0 * random.Next() - 3.0);
    motion.shift = motion.scale * 3.0 * RandomDirection(random);
    const double still = Throughput(pair.a, pair.b, Accuracy::Reference);
    const double moved = Throughput(motion(pair.a), motion(pair.b), Accuracy::Reference) /
                         (motion.scale * motion.scale);
    // Rounding of the vertices; near a surface the throughput has a slope of 1 / distance.
    EXPECT_NEAR(moved, still, 2e-10 * still + 1e-13);
  }
}

TEST_P(RandomPairs, AddUpOverTheParts)
{
  for (std::uint64_t seed = 0; seed < Count; ++seed)
  {
    SCOPED_TRACE(testing::Message() << NameOf(this->GetParam()) << ", seed " << seed);
    const Pair pair = MakePair(this->GetParam(), seed);
    const Vec3 c = Centroid(pair.b);
    for (const Accuracy accuracy : { Accuracy::Default, Accuracy::Reference })
    {
      double sum = 0.0;
      for (int i = 0; i < pair.b.Size(); ++i)
      {
        sum += Throughput(pair.a, { c, pair.b[i], pair.b[(i + 1) % pair.b.Size()] }, accuracy);
      }
      // Twice what is promised for each.
      const double tolerance = accuracy == Accuracy::Default ? 2e-5 : 2e-8;
      EXPECT_NEAR(sum, Throughput(pair.a, pair.b, accuracy), tolerance * sum + 1e-13);
    }
  }
}

INSTANTIATE_TEST_SUITE_P(All, RandomPairs,
  testing::Values(Kind::General, Kind::SharedVertex, Kind::SharedEdge, Kind::NearlyCoincident,
    Kind::Sliver, Kind::TouchingSliver),
  [](const testing::TestParamInfo<Kind>& info) { return NameOf(info.param); });

// The ladder has rungs of its own for each distance; the finest rung checks them all.
TEST(Ladder, AllDistancesMeetTheDefaultAccuracy)
{
  for (std::uint64_t seed = 0; seed < 5000; ++seed)
  {
    SCOPED_TRACE(testing::Message() << "seed " << seed);
    RandomStream random(seed, 5);
    const double distance = std::pow(10.0, 3.0 * random.Next() - 0.5);
    const Polygon a = RandomPolygon(random, Vec3(0.0), RandomDirection(random), random.Next());
    const Polygon b = RandomPolygon(
      random, distance * RandomDirection(random), RandomDirection(random), random.Next());
    const double fine = Throughput(a, b, Accuracy::Reference);
    EXPECT_NEAR(Throughput(a, b), fine, 1e-5 * fine + 1e-14);
  }
}

} // namespace
} // namespace vantage
