#include "core/view/SmoothFit.h"

#include <gtest/gtest.h>

#include <cmath>

namespace vantage
{
namespace
{

const Vec2 Low(-1.0, 2.0);
const Vec2 High(0.5, 6.0);

double Wave(const Vec2& p)
{
  return 1.0 + 0.04 * std::sin(0.6 * p.x + 0.2 * p.y);
}

TEST(SmoothFit, IsExactForABiquadraticPolynomial)
{
  int calls = 0;
  const auto f = [&](const Vec2& p)
  {
    ++calls;
    return (1.0 + 0.3 * p.x - 0.2 * p.x * p.x) * (2.0 - 0.1 * p.y + 0.05 * p.y * p.y);
  };
  const auto fit = FitSmooth(Low, High, 0.1, f);
  ASSERT_TRUE(fit);
  EXPECT_EQ(calls, 13);
  for (const Vec2& u : { Vec2(0.1, 0.2), Vec2(0.9, 0.4), Vec2(0.37, 0.81), Vec2(1.0, 0.0) })
  {
    const Vec2 place = Low + u * (High - Low);
    EXPECT_NEAR(fit->At(place), f(place), 1e-14); // round-off
  }
}

TEST(SmoothFit, StaysWithinItsTolerance)
{
  for (const double tolerance : { 1e-2, 2e-3 })
  {
    const auto fit = FitSmooth(Low, High, tolerance, Wave);
    ASSERT_TRUE(fit) << tolerance;
    for (int i = 0; i <= 100; ++i)
    {
      const Vec2 place = Low + Vec2(0.1 * (i % 11), 0.1 * (i / 11)) * (High - Low);
      EXPECT_NEAR(fit->At(place), Wave(place), 2.0 * tolerance); // between the places looked at
    }
  }
  EXPECT_FALSE(FitSmooth(Low, High, 1e-6, Wave));
}

TEST(SmoothFit, ItsToleranceIsRelativeToTheValues)
{
  const auto dim = [](const Vec2& p) { return 1e-3 * Wave(p); };
  EXPECT_TRUE(FitSmooth(Low, High, 2e-3, dim));
  EXPECT_FALSE(FitSmooth(Low, High, 1e-6, dim));
  EXPECT_TRUE(FitSmooth(Low, High, 1e-6, [](const Vec2&) { return 0.0; }));
}

TEST(SmoothFit, AJumpIsNoticedSoon)
{
  int calls = 0;
  const auto jump = [&](const Vec2& p)
  {
    ++calls;
    return p.x > -0.6 ? 1.0 : 0.0;
  };
  EXPECT_FALSE(FitSmooth(Low, High, 0.01, jump));
  EXPECT_EQ(calls, 5);
}

/// As all spots in a row have it, or a single one.
TEST(SmoothFit, ARectangleMayBeALineOrAPoint)
{
  const auto f = [](const Vec2& p) { return p.x + p.y; };
  const auto line = FitSmooth(Vec2(0.0, 1.0), Vec2(2.0, 1.0), 1e-9, f);
  ASSERT_TRUE(line);
  EXPECT_NEAR(line->At({ 0.7, 1.0 }), 1.7, 1e-14);
  const auto point = FitSmooth(Low, Low, 1e-9, f);
  ASSERT_TRUE(point);
  EXPECT_NEAR(point->At(Low), 1.0, 1e-14);
}

} // namespace
} // namespace vantage
