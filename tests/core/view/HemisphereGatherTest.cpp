#include "core/view/HemisphereGather.h"

#include "core/formfactor/FormFactor.h"
#include "core/view/BrightPlate.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace vantage
{
namespace
{

using test::BrightPlate;

/// Irradiance at a point of the ceiling: pi from all around, more from the plate.
double ExactAt(const BrightPlate& room, const Vec3& point)
{
  const double factor =
    PointToPolygon(point, Vec3(0, 0, -1), room.Stage.occluders.Shape(room.Patch / 2));
  return Pi + (room.Bright - 1.0) * std::abs(factor);
}

struct Errors
{
  double mean = 0.0;
  double square = 0.0; ///< mean
  double noise = 0.0;  ///< mean square of what is guessed
};

/// At places all over the ceiling.
Errors ErrorsOf(const BrightPlate& room, std::uint32_t rays, int count, std::uint64_t seed)
{
  RandomStream random(seed);
  Errors errors;
  for (int i = 0; i < count; ++i)
  {
    const Vec3 point(2.0 * random.Next2(), 2.0);
    const HemisphereEstimate estimate =
      GatherHemisphere(room.Stage.occluders, room.Lit, room.Ceiling, point, rays, Hash(seed, i));
    const double error = Mean(estimate.irradiance) - ExactAt(room, point);
    errors.mean += error / count;
    errors.square += error * error / count;
    errors.noise += estimate.noise * estimate.noise / count;
  }
  return errors;
}

TEST(HemisphereGather, ComesCloserWithMoreRaysAndKnowsItsNoise)
{
  for (const bool bySpots : { false, true })
  {
    BrightPlate room(BrightPlate::Square(), 20.0);
    if (bySpots)
    {
      room.Light(4000, 1);
    }
    double last = std::numeric_limits<double>::infinity();
    for (const std::uint32_t rays : { 64, 512, 4096 })
    {
      const Errors errors = ErrorsOf(room, rays, 300, 41);
      EXPECT_LT(errors.square, 0.15 * last) << rays;
      EXPECT_GT(errors.noise, 0.3 * errors.square) << rays;
      EXPECT_LT(errors.noise, 4.0 * errors.square) << rays;
      last = errors.square;
    }
  }
}

TEST(HemisphereGather, FindsBrightSpotsWithFewRays)
{
  BrightPlate room(BrightPlate::Square());
  const Errors byChance = ErrorsOf(room, 64, 1000, 42);
  room.Light(4000, 2);
  ASSERT_FALSE(room.Lit.Spots().All().empty());
  const Errors bySpots = ErrorsOf(room, 64, 1000, 42);
  EXPECT_LT(bySpots.square, 0.01 * byChance.square);
  EXPECT_LT(std::abs(bySpots.mean), 5.0 * std::sqrt(bySpots.square / 1000.0));
}

/// A lid over the left half of the plate hides some of it, or all. The oracle are very many rays
/// that know of no spots.
TEST(HemisphereGather, HiddenSpotsBringNoBias)
{
  BrightPlate room(BrightPlate::Square(), 50.0,
    { { { 0.5, 0.5, 0.6 }, { 1.0, 0.5, 0.6 }, { 1.0, 1.5, 0.6 }, { 0.5, 1.5, 0.6 } } });
  const LitSurfaces plain(room.Stage.occluders, room.Stage.solution);
  room.Light(4000, 3);
  ASSERT_FALSE(room.Lit.Spots().All().empty());
  for (const double x : { 0.3, 0.8, 1.0, 1.9 })
  {
    const Vec3 point(x, 1.0, 2.0);
    constexpr int Seeds = 400;
    double sum = 0.0;
    double squares = 0.0;
    for (int seed = 0; seed < Seeds; ++seed)
    {
      const double found = Mean(
        GatherHemisphere(room.Stage.occluders, room.Lit, room.Ceiling, point, 64, seed).irradiance);
      sum += found;
      squares += found * found;
    }
    const double mean = sum / Seeds;
    const double sigma = std::sqrt(std::max(squares / Seeds - mean * mean, 0.0) / Seeds);
    const HemisphereEstimate exact =
      GatherHemisphere(room.Stage.occluders, plain, room.Ceiling, point, 1u << 18, 99);
    const bool isHidden = x == 0.3;
    EXPECT_EQ(mean < 1.0001 * Pi, isHidden) << x;
    // What is hidden leaves the round-off of 64 rays.
    EXPECT_NEAR(mean, Mean(exact.irradiance), 5.0 * std::hypot(sigma, exact.noise) + 1e-11) << x;
  }
}

TEST(HemisphereGather, AllRaysTogetherHaveTheWeightOfTheHemisphere)
{
  BrightPlate room(BrightPlate::Square());
  const auto sumOfWeights = [&](std::uint64_t seed)
  {
    const HemisphereRays rays(
      room.Stage.occluders, room.Lit, room.Ceiling, { 0.6, 1.3, 2.0 }, LitBy::Texels, 64, seed);
    double sum = 0.0;
    std::uint64_t shadowRays = 0;
    for (std::uint32_t ray = 0; ray < 64; ++ray)
    {
      const auto seen = rays.Cast(ray, shadowRays);
      sum += seen ? seen->weight : 0.0;
    }
    return sum;
  };
  EXPECT_NEAR(sumOfWeights(1), Pi, 1e-12); // round-off of 64
  room.Light(4000, 4);
  double sum = 0.0;
  for (std::uint64_t seed = 0; seed < 1000; ++seed)
  {
    sum += sumOfWeights(seed) / 1000.0;
  }
  // The spots have 1 % of the hemisphere, in which the weights vary.
  EXPECT_NEAR(sum, Pi, 5.0 * 0.01 * Pi / std::sqrt(1000.0));
}

} // namespace
} // namespace vantage
