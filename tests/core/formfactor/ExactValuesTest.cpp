#include "core/formfactor/FormFactor.h"
#include "core/formfactor/Shapes.h"

#include <gtest/gtest.h>

#include <string>

namespace vantage
{
namespace
{

struct ExactCase
{
  std::string name;
  Polygon a, b;
  std::vector<Polygon> occluders;
  double formFactor; ///< classical, from a to b
};

Polygon Leaf(double degrees)
{
  const double t = degrees * Pi / 180.0;
  const Vec3 along(std::cos(t), 0, std::sin(t));
  return { Vec3(0, 0, 0), Vec3(0, 1, 0), Vec3(0, 1, 0) + along, along };
}

/// Faces of the regular tetrahedron, facing inwards.
Polygon TetrahedronFace(int opposite)
{
  const Vec3 corners[4] = { { 1, 1, 1 }, { 1, -1, -1 }, { -1, 1, -1 }, { -1, -1, 1 } };
  Polygon face;
  for (int i = 0; i < 4; ++i)
  {
    if (i != opposite)
    {
      face.Add(corners[i]);
    }
  }
  const bool inwards = glm::dot(AreaNormal(face), corners[opposite] - face[0]) > 0.0;
  return inwards ? face : Reversed(face);
}

/// References with 30 digits, by the closed forms where there are any.
std::vector<ExactCase> ExactCases()
{
  const Polygon wall{ { 0, 0, 0 }, { 0, 1, 0 }, { 0, 1, 1 }, { 0, 0, 1 } };
  const Polygon gapped{ { -0.01, 0, 0 }, { -0.01, 1, 0 }, { -0.01, 1, 1 }, { -0.01, 0, 1 } };
  const Polygon sunk{ { 0, 0, -0.5 }, { 0, 1, -0.5 }, { 0, 1, 0.5 }, { 0, 0, 0.5 } };
  const Polygon atCorner{ { 1, 1, 0 }, { 2, 1, 0 }, { 2, 1, 1 }, { 1, 1, 1 } };
  const Polygon wide{ { 0, 0, 0 }, { 10, 0, 0 }, { 10, 1, 0 }, { 0, 1, 0 } };
  const Polygon low{ { 0, 0, 0 }, { 0, 1, 0 }, { 0, 1, 0.1 }, { 0, 0, 0.1 } };
  return {
    { "ParallelAtOne", Floor(), Ceiling(1), {}, 0.199824895698387 },
    { "ParallelAtTenth", Floor(), Ceiling(0.1), {}, 0.826994522397257 },
    { "ParallelAtHundredth", Floor(), Ceiling(0.01), {}, 0.980416602925973 },
    { "ParallelAtFive", Floor(), Ceiling(5), {}, 0.012403977313245 },
    { "SharedEdge", Floor(), wall, {}, 0.200043776075403 },
    { "EdgeWithGap", Floor(), gapped, {}, 0.195799037121326 },
    { "HalfBelowTheFloor", Floor(), sunk, {}, 0.1461866791057133 },
    { "Dihedral30", Floor(), Leaf(30), {}, 0.619028323090803 },
    { "Dihedral120", Floor(), Leaf(120), {}, 0.086615001118276 },
    { "Tetrahedron", TetrahedronFace(0), TetrahedronFace(1), {}, 1.0 / 3.0 },
    { "SharedVertex", Floor(), atCorner, {}, 0.040592230101559 },
    { "ParallelOneByTwo", Floor(1, 2), Ceiling(0.5, 1, 2), {}, 0.508988669041438 },
    { "LowWallOfWideFloor", wide, low, {}, 0.004393873007072 },
    { "QuarterOccluded", Floor(), Ceiling(1), { Floor(0.5, 0.5, 0.5) }, 0.149868671773790 },
    { "HalfOccluded", Floor(), Ceiling(1), { Floor(0.5, 1.0, 0.5) }, 0.099912447849194 },
  };
}

class ExactValues : public testing::TestWithParam<ExactCase>
{
};

// The tolerances are those that Accuracy promises.
TEST_P(ExactValues, AreReproduced)
{
  const ExactCase& c = this->GetParam();
  const bool open = c.occluders.empty();
  for (const Accuracy accuracy : { Accuracy::Default, Accuracy::Reference })
  {
    const bool fine = accuracy == Accuracy::Reference;
    const double tolerance = open ? (fine ? 1e-8 : 1e-5) : (fine ? 1e-6 : 1e-4);
    for (const bool swapped : { false, true })
    {
      const Polygon& from = swapped ? c.b : c.a;
      const Polygon& to = swapped ? c.a : c.b;
      const double g =
        open ? Throughput(from, to, accuracy) : VisibleThroughput(from, to, c.occluders, accuracy);
      EXPECT_NEAR(g / (Pi * Area(c.a) * c.formFactor), 1.0, tolerance) << "swapped " << swapped;
    }
  }
}

// Polygons that are aligned, parallel or touch leave nothing to quadrature: only rounding remains.
TEST_P(ExactValues, TheContourIsAsGoodAsRounding)
{
  const ExactCase& c = this->GetParam();
  if (c.occluders.empty())
  {
    const double g = Throughput(c.a, c.b, Accuracy::Reference);
    EXPECT_NEAR(g / (Pi * Area(c.a) * c.formFactor), 1.0, 2e-13); // 15 digits in the references
  }
}

INSTANTIATE_TEST_SUITE_P(All, ExactValues, testing::ValuesIn(ExactCases()),
  [](const testing::TestParamInfo<ExactCase>& info) { return info.param.name; });

/// Directly opposed squares of side 1 at distance d (Howell, configuration C-11).
double OpposedSquares(double d)
{
  const long double x = 1.0L / d;
  const long double root = std::sqrt(1.0L + x * x);
  const long double logarithm = 0.5L * std::log1p(x * x * x * x / (1.0L + 2.0L * x * x));
  return static_cast<double>(2.0L / (3.14159265358979323846L * x * x) *
                             (logarithm + 2.0L * x * (root * std::atan(x / root) - std::atan(x))));
}

TEST(NearlyCoincident, SquaresFollowTheClosedForm)
{
  EXPECT_NEAR(OpposedSquares(1.0), 0.199824895698387, 1e-14);
  for (const double d : { 1e-2, 1e-4, 1e-7, 1e-10 })
  {
    // Both the formula and the contours lose a few digits to cancellation.
    EXPECT_NEAR(Throughput(Floor(), Ceiling(d)) / Pi, OpposedSquares(d), 1e-12) << "d = " << d;
  }
}

} // namespace
} // namespace vantage
