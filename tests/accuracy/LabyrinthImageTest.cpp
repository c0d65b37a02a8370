#include "accuracy/References.h"
#include "core/scene/Labyrinth.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>

namespace vantage
{
namespace
{

constexpr int ImageSize = 64;
constexpr double Unshot = 1e-4; ///< part of the view flux: far below the tolerances of the tests

/// Tolerances of refinement, for power and for shadow boundaries.
struct Fineness
{
  const char* name;
  double power, shadow;
};
constexpr Fineness Coarse{ "coarse", 1e-3, 3e-4 };
constexpr Fineness Default{ "default", 3e-4, 1e-4 };
constexpr Fineness Fine{ "fine", 1e-4, 3e-5 };
constexpr Fineness ForReference{ "reference", 3e-5, 1e-5 };

Solver SolvedView(const Scene& scene, const Camera& camera, const Fineness& fineness)
{
  SolverSettings settings;
  settings.method = Method::ImportanceShooting;
  settings.refinement.powerTolerance = fineness.power;
  settings.refinement.shadowTolerance = fineness.shadow;
  return test::Solved(scene, camera, settings, Unshot);
}

class LabyrinthImage : public testing::TestWithParam<const char*>
{
protected:
  const Scene Rooms = MakeLabyrinth();
  const Camera View = test::SquareCamera(this->Rooms, GetParam());
};

/// Pixel for pixel, without antialiasing on either side. What is left is the discretisation: shadow
/// boundaries are as sharp as the elements are small. The noise of the reference is below 1 %.
TEST_P(LabyrinthImage, FinerElementsComeCloserToTheExactPixels)
{
  const Image exact = test::GatheredImage(
    SolvedView(this->Rooms, this->View, ForReference), this->View, ImageSize, 1500);
  ElementImageSettings pixels;
  pixels.width = pixels.height = ImageSize;
  pixels.pixelCentres = true;
  double last = 1.0;
  for (const Fineness& fineness : { Coarse, Default, Fine })
  {
    const Solver solver = SolvedView(this->Rooms, this->View, fineness);
    const double error = Compare(solver.Render(this->View, pixels), exact).relativeL1;
    test::Record(std::string(GetParam()) + " L1 " + fineness.name, error);
    test::Record(std::string(GetParam()) + " evaluations " + fineness.name,
      static_cast<double>(solver.History().back().work.Evaluations()));
    EXPECT_LT(error, last) << fineness.name;
    last = error;
  }
  EXPECT_LE(last, 0.05);
}

/// An oracle that shares nothing with the solver but the geometry. Its noise on the mean of the
/// image is asserted; of the 2 % the rest is for the discretisation.
TEST_P(LabyrinthImage, DefaultTolerancesHaveNoBiasAgainstPathTracing)
{
  const test::TracedImage traced = test::PathTraced(this->Rooms, this->View, ImageSize, 128);
  test::Record(std::string(GetParam()) + " noise of the path tracer", traced.noiseOfMean);
  ASSERT_LT(traced.noiseOfMean, 0.003);
  ElementImageSettings pixels;
  pixels.width = pixels.height = ImageSize;
  pixels.samplesPerPixel = 16;
  const Solver solver = SolvedView(this->Rooms, this->View, Default);
  const ImageDifference difference =
    Compare(BlockMeans(solver.Render(this->View, pixels), 8), BlockMeans(traced.image, 8));
  test::Record(std::string(GetParam()) + " bias", difference.relativeBias);
  test::Record(std::string(GetParam()) + " L1 of blocks", difference.relativeL1);
  EXPECT_LE(std::abs(difference.relativeBias), 0.02);
  // Errors within a block cancel only in part: no worse than what single pixels are held to.
  EXPECT_LE(difference.relativeL1, 0.05);
}

INSTANTIATE_TEST_SUITE_P(TwentyRooms, LabyrinthImage, testing::Values("view1", "view2"));

} // namespace
} // namespace vantage
