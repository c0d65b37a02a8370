#include "accuracy/References.h"
#include "support/TestScenes.h"

#include <gtest/gtest.h>

#include <cmath>

namespace vantage
{
namespace
{

/// Blocks of 8 x 8 pixels against plain path tracing, which shares nothing with the solver but the
/// geometry. The noise of the mean is asserted to be small; what is left is the discretisation,
/// most of it where the block stands: elements of the floor that reach below it are dark in part.
TEST(PathTracerAgreement, BlockMeansOfTheLitBox)
{
  constexpr int ImageSize = 64;
  const Scene scene = test::MakeLitBox();
  const Camera camera = test::SquareCamera(scene, "inside");
  const test::TracedImage traced = test::PathTraced(scene, camera, ImageSize, 256);
  test::Record("noise of the path tracer", traced.noiseOfMean);
  ASSERT_LT(traced.noiseOfMean, 0.003);

  SolverSettings settings;
  settings.method = Method::ImportanceShooting;
  settings.refinement.powerTolerance = 1e-5;
  settings.refinement.shadowTolerance = 3e-6;
  settings.refinement.minimumElementSize = 0.02;
  const Solver solver = test::Solved(scene, camera, settings, 1e-4);
  ElementImageSettings pixels;
  pixels.width = pixels.height = ImageSize;
  pixels.samplesPerPixel = 16;
  const ImageDifference difference =
    Compare(BlockMeans(solver.Render(camera, pixels), 8), BlockMeans(traced.image, 8));
  test::Record("L1 of blocks", difference.relativeL1);
  test::Record("RMSE of blocks", difference.relativeRmse);
  test::Record("bias", difference.relativeBias);
  EXPECT_LE(difference.relativeL1, 0.02);
  EXPECT_LE(std::abs(difference.relativeBias), 0.01);
}

} // namespace
} // namespace vantage
