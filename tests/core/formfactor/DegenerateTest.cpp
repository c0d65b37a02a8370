#include "core/formfactor/FormFactor.h"
#include "core/formfactor/Shapes.h"

#include <gtest/gtest.h>

namespace vantage
{
namespace
{

void ExpectSound(const Polygon& a, const Polygon& b)
{
  for (const Accuracy accuracy : { Accuracy::Default, Accuracy::Reference })
  {
    const double g = Throughput(a, b, accuracy);
    EXPECT_TRUE(std::isfinite(g));
    EXPECT_GE(g, 0.0);
    EXPECT_LE(g, Pi * std::min(Area(a), Area(b)) * (1.0 + 1e-15)); // rounding of the area
    EXPECT_EQ(g, Throughput(b, a, accuracy));
  }
}

TEST(Degenerate, PolygonsThatDoNotSeeEachOther)
{
  const Polygon line{ { 0, 0, 1 }, { 1, 0, 1 }, { 2, 0, 1 } };
  const Polygon point{ { 1, 1, 1 }, { 1, 1, 1 }, { 1, 1, 1 } };
  const Polygon beside{ { 1, 0, 0 }, { 2, 0, 0 }, { 2, 1, 0 }, { 1, 1, 0 } };
  for (const Polygon& other : { line, point, Polygon{}, beside, Reversed(beside), Floor(),
         Reversed(Floor()), Floor(1, 1, 1), Ceiling(-1) })
  {
    EXPECT_EQ(Throughput(Floor(), other), 0.0);
    ExpectSound(Floor(), other);
  }
}

TEST(Degenerate, TouchingPolygonsAtAllAngles)
{
  for (int degrees = 1; degrees < 180; ++degrees)
  {
    SCOPED_TRACE(degrees);
    const double t = degrees * Pi / 180.0;
    const Vec3 along(std::cos(t), 0, std::sin(t));
    ExpectSound(Floor(), { Vec3(0), Vec3(0, 1, 0), Vec3(0, 1, 0) + along, along });
    // A shorter edge on the shared one, one across it and one that only touches a vertex.
    const Vec3 low(0, 0.25, 0), high(0, 1.5, 0), skew(0, 0.3, 0);
    ExpectSound(Floor(), { low, high, high + along, low + along });
    ExpectSound(Floor(), { low, high, high + along + skew, low + along + skew });
    ExpectSound(Floor(), { low, high + along, low + along + skew });
  }
}

TEST(Degenerate, CoincidentInTheLimitFromTheFrontAndFromBehind)
{
  const Frame turned(glm::normalize(Vec3(1, 2, 3)));
  const Polygon p = Regular(Vec3(0.3), turned, 1.0, 5, 0.1);
  for (const double d : { 1e-4, 1e-7, 1e-9 })
  {
    Polygon near = Reversed(p);
    Polygon behind = Reversed(p);
    for (int i = 0; i < p.Size(); ++i)
    {
      near[i] += d * turned.z;
      behind[i] -= d * turned.z;
    }
    ExpectSound(p, near);
    // The light that leaves through the slit at the border: about 2 d times the perimeter.
    EXPECT_NEAR(Throughput(p, near) / (Pi * Area(p)), 1.0, 10.0 * d);
    EXPECT_EQ(Throughput(p, behind), 0.0);
  }
  EXPECT_EQ(Throughput(p, Reversed(p)), 0.0);
}

// The parts in front of each other end on one line, which rounding puts in two slightly different
// places: nearly parallel, nearly touching edges.
TEST(Degenerate, PolygonsThatCrossAtASmallAngle)
{
  Motion motion;
  motion.frame = Frame(glm::normalize(Vec3(2, -1, 3)));
  for (const double tilt : { 1e-2, 1e-4, 1e-6, 1e-8 })
  {
    SCOPED_TRACE(tilt);
    // The second one is turned in its plane, too, and then about the line x = 0.5 of the first.
    Polygon crossing = Reversed(Regular(Vec3(0.5, 0.5, 0.0), Frame(Vec3(0, 0, 1)), 0.4, 6, 0.1));
    const double front = Area(ClipToFront(crossing, { Vec3(1, 0, 0), 0.5 }));
    for (int i = 0; i < crossing.Size(); ++i)
    {
      crossing[i].z = tilt * (crossing[i].x - 0.5);
    }
    const Polygon a = motion(Floor());
    const Polygon b = motion(crossing);
    ExpectSound(a, b);
    // All that leaves b, but for what escapes through the wedge: of the order of the tilt. The
    // line is known to 1e-16 over the tilt.
    EXPECT_NEAR(Throughput(a, b) / (Pi * front), 1.0, 2.0 * tilt + 1e-15 / tilt + 1e-6);
    EXPECT_NEAR(Throughput(a, b, Accuracy::Reference) / Throughput(a, b), 1.0, 1e-5);
  }
}

TEST(Degenerate, Slivers)
{
  for (const double width : { 1e-3, 1e-4 })
  {
    const Polygon sliver = Floor(1.0, width);
    ExpectSound(sliver, Ceiling(0.1));
    ExpectSound(sliver, Ceiling(1e-4));
    ExpectSound(sliver, Ceiling(0.3, width, 1.0));
    ExpectSound(sliver, { { 0, 0, 0 }, { 0, width, 0 }, { 0, width, 1 }, { 0, 0, 1 } });
    // Cut into slivers, a floor sees as much as in one piece.
    double sum = 0.0;
    const int pieces = static_cast<int>(std::lround(1.0 / width));
    for (int i = 0; i < pieces; ++i)
    {
      Polygon piece = sliver;
      for (int k = 0; k < 4; ++k)
      {
        piece[k].y += i * width;
      }
      sum += Throughput(piece, Ceiling(0.1), Accuracy::Reference);
    }
    // Each sliver loses up to 1 / width of the digits of the whole: 1e-16 * 1e4 * few.
    EXPECT_NEAR(sum / (Pi * 0.826994522397257), 1.0, 1e-11);
  }
}

TEST(Degenerate, SizesAMillionToOne)
{
  const double small = 1e-6;
  for (const double height : { 1e-6, 1e-3, 1.0 })
  {
    Polygon speck = Floor(small, small);
    for (int k = 0; k < 4; ++k)
    {
      speck[k] += Vec3(0.3, 0.4, 0.0);
    }
    const Polygon big = Ceiling(height);
    ExpectSound(speck, big);
    const Vec3 centre(0.3 + 0.5 * small, 0.4 + 0.5 * small, 0.0);
    // Across the speck the cosine sum varies by (small / distance to the border)^2; 1e-16 of the
    // product of the perimeters is 1e-10 of the speck's area.
    EXPECT_NEAR(Throughput(speck, big) / (Area(speck) * PointToPolygon(centre, Vec3(0, 0, 1), big)),
      1.0, 2e-9);
  }
}

// A speck of the floor at the foot of a wall sees of the wall what is near it and, less and less,
// what is far: as much as of all its parts, where nothing of the wall's size can cancel.
TEST(Degenerate, ASpeckAtTheFootOfAWall)
{
  const double small = 1e-6;
  const Frame turned(glm::normalize(Vec3(1, 3, -2)));
  const auto wall = [&](double y0, double y1, double z0, double z1)
  {
    return Polygon{ turned.ToWorld({ 0, y0, z0 }), turned.ToWorld({ 0, y1, z0 }),
      turned.ToWorld({ 0, y1, z1 }), turned.ToWorld({ 0, y0, z1 }) };
  };
  const Polygon speck{ turned.ToWorld({ 0, 0, 0 }), turned.ToWorld({ small, 0, 0 }),
    turned.ToWorld({ small, small, 0 }), turned.ToWorld({ 0, small, 0 }) };
  double sum = Throughput(speck, wall(0, small, 0, small), Accuracy::Reference);
  for (double size = small; size < 1.0; size *= 2.0)
  {
    const double twice = std::min(2.0 * size, 1.0);
    sum += Throughput(speck, wall(size, twice, 0, size), Accuracy::Reference) +
           Throughput(speck, wall(0, twice, size, twice), Accuracy::Reference);
  }
  // The corners of the parts are rounded to 1e-16, which is 1e-10 of the speck.
  EXPECT_NEAR(Throughput(speck, wall(0, 1, 0, 1), Accuracy::Reference) / sum, 1.0, 1e-8);
  EXPECT_NEAR(Throughput(speck, wall(0, 1, 0, 1)) / sum, 1.0, 1e-5);
}

// A sliver whose tip the plane of the other polygon cuts off: an edge of 1e-9 is left, next to
// edges of length 1. The reference is the contour integral with 30 digits.
TEST(Degenerate, AnEdgeThatClippingLeftTiny)
{
  const Polygon large{ { -0.18917218527336288, 0.34912397144548468, 1.1696523449106964 },
    { 1.1076861443796551, -0.54282596835956387, -0.06427787098133475 },
    { 0.18917218527336288, -0.34912397144548468, -1.1696523449106964 },
    { -1.1076861443796551, 0.54282596835956387, 0.06427787098133475 } };
  const Polygon narrow{ { -0.18917171337811503, 0.34912288315290618, 1.1696508701406345 },
    { -0.54448348815078873, 0.49629128514782722, 0.98796912045696028 },
    { -0.54445135820577395, 0.49625706346748344, 0.98787856376744687 },
    { -0.18913958343310017, 0.3490886614725624, 1.169560313451121 } };
  const Polygon sliver{ Centroid(narrow), narrow[0], narrow[1] };
  // The plane of a sliver of 1 : 20,000 is known to 1e-12; its grazing light to 1e-7 or so.
  const double expected = 5.66108063700754e-8;
  EXPECT_NEAR(Throughput(large, sliver, Accuracy::Reference) / expected, 1.0, 1e-6);
  EXPECT_NEAR(Throughput(large, sliver) / expected, 1.0, 1e-5);
}

// Rounding must not open a slit between the two sides of a wall, nor between parts of one plane.
TEST(Degenerate, TheSidesOfAWallDoNotSeeEachOther)
{
  for (std::uint64_t seed = 0; seed < 2000; ++seed)
  {
    SCOPED_TRACE(testing::Message() << "seed " << seed);
    RandomStream random(seed, 4);
    Motion motion;
    motion.frame = Frame(RandomDirection(random));
    motion.shift = std::pow(10.0, 4.0 * random.Next()) * RandomDirection(random);
    const double aspect = std::pow(10.0, -4.0 * random.Next());
    const Polygon front = RandomPolygon(random, Vec3(0.0), Vec3(0, 0, 1), aspect);
    const Polygon other = Floor(random.Next(), random.Next());
    EXPECT_EQ(Throughput(motion(front), Reversed(motion(front))), 0.0);
    EXPECT_EQ(Throughput(motion(front), motion(Reversed(other))), 0.0);
    EXPECT_EQ(Throughput(motion(front), motion(other)), 0.0);
  }
}

TEST(Degenerate, FarApart)
{
  for (const double d : { 1e3, 1e6, 1e9 })
  {
    ExpectSound(Floor(), Ceiling(d));
    EXPECT_NEAR(Throughput(Floor(), Ceiling(d)) * d * d, 1.0, 2.0 / (d * d) + 1e-14);
  }
}

TEST(Degenerate, FarFromTheOriginAndAtAnyScale)
{
  const double expected = Throughput(Floor(), Ceiling(0.25), Accuracy::Reference);
  const Polygon wall{ { 0, 0, 0 }, { 0, 1, 0 }, { 0, 1, 1 }, { 0, 0, 1 } };
  for (const double scale : { 1e-3, 1.0, 1e3 })
  {
    for (const double far : { 0.0, 1e3, 1e6 })
    {
      SCOPED_TRACE(testing::Message() << "scale " << scale << ", shift " << far);
      Motion motion;
      motion.frame = Frame(glm::normalize(Vec3(3, -1, 2)));
      motion.scale = scale;
      motion.shift = Vec3(far, -far, 0.5 * far);
      // The vertices themselves are rounded to 1e-16 of their coordinates.
      const double rounding = 1e-12 + 4e-15 * far / scale;
      const double opposite =
        Throughput(motion(Floor()), motion(Ceiling(0.25)), Accuracy::Reference);
      EXPECT_NEAR(opposite / (scale * scale), expected, rounding);
      const double adjacent = Throughput(motion(Floor()), motion(wall), Accuracy::Reference);
      EXPECT_NEAR(adjacent / (Pi * scale * scale), 0.200043776075403, rounding);
    }
  }
}

} // namespace
} // namespace vantage
