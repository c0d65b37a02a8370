#include "report/ReachTable.h"

#include "TextTable.h"

#include <cmath>
#include <gtest/gtest.h>

namespace vantage
{
namespace
{

Measurement Measured(double seconds, double error)
{
  Measurement m;
  m.imageCpuSeconds = seconds;
  m.error = error;
  return m;
}

double Seconds(const Measurement& m)
{
  return m.CpuSeconds();
}

TEST(ReachTable, EnvelopeKeepsWhatNothingCheaperEquals)
{
  const std::vector<CurvePoint> envelope = LowerEnvelope(
    { Measured(4.0, 0.1), Measured(1.0, 0.5), Measured(2.0, 0.6), Measured(3.0, 0.1),
      Measured(3.0, 0.3), Measured(0.0, 0.01), Measured(8.0, 0.05), Measured(9.0, 0.05) },
    Seconds);
  ASSERT_EQ(envelope.size(), 3U);
  EXPECT_EQ(envelope[0].cost, 1.0);
  EXPECT_EQ(envelope[1].cost, 3.0);
  EXPECT_EQ(envelope[1].error, 0.1);
  EXPECT_EQ(envelope[2].cost, 8.0);
}

/// Error c / sqrt(t), as of path tracing, is a straight line in both logarithms.
TEST(ReachTable, InterpolationIsExactForPowerLaws)
{
  std::vector<Measurement> measurements;
  for (const double seconds : { 1.0, 7.0, 100.0 })
  {
    measurements.push_back(Measured(seconds, 0.3 / std::sqrt(seconds)));
  }
  const std::vector<CurvePoint> envelope = LowerEnvelope(measurements, Seconds);
  for (const double error : { 0.2, 0.1, 0.05 })
  {
    const Reach reach = ReachOf(envelope, error);
    EXPECT_EQ(reach.kind, Reach::Kind::At);
    EXPECT_NEAR(reach.cost, std::pow(0.3 / error, 2), 1e-12 * reach.cost);
  }
  EXPECT_EQ(ReachOf(envelope, 0.4).kind, Reach::Kind::AtMost);
  EXPECT_EQ(ReachOf(envelope, 0.4).cost, 1.0);
  EXPECT_EQ(ReachOf(envelope, 0.01).kind, Reach::Kind::Never);
  EXPECT_EQ(ReachOf(envelope, 0.01).cost, 100.0);
  EXPECT_EQ(ReachOf({}, 0.1).kind, Reach::Kind::Never);
}

/// The errors asked for are 10, 5, 2 and 1 %; every other column is a ratio.
TEST(ReachTable, RatiosAreBoundsWhereTheyMustBe)
{
  const auto cells = MakeReachTable(
    { { "yardstick", { Measured(1.0, 0.08), Measured(4.0, 0.02) } },
      { "slow", { Measured(10.0, 0.2), Measured(40.0, 0.05), Measured(80.0, 0.04) } },
      { "never", { Measured(0.5, 0.5) } }, { "free", { Measured(0.0, 0.5) } } },
    Seconds, "yardstick", " s");
  ASSERT_EQ(cells.size(), 4U); // what costs nothing has no curve
  EXPECT_EQ(cells[1], (std::vector<std::string>{ "yardstick", "< 1.0 s", "\u2013", "1.6 s",
                        "1.0 \u00d7", "4.0 s", "1.0 \u00d7", "not reached", "\u2013" }));
  EXPECT_EQ(cells[2], (std::vector<std::string>{ "slow", "20 s", "> 20 \u00d7", "40 s", "25 \u00d7",
                        "not reached", "> 20 \u00d7", "not reached", "\u2013" }));
  EXPECT_EQ(cells[3][1], "not reached");
  EXPECT_EQ(cells[3][2], "\u2013"); // more than half as much says nothing
}

TEST(TextTable, TwoDigitsAreTwo)
{
  EXPECT_EQ(TwoDigits(0.0), "0");
  EXPECT_EQ(TwoDigits(0.0314), "0.031");
  EXPECT_EQ(TwoDigits(0.0996), "0.10");
  EXPECT_EQ(TwoDigits(1.0), "1.0");
  EXPECT_EQ(TwoDigits(9.96), "10");
  EXPECT_EQ(TwoDigits(237.0), "240");
  EXPECT_EQ(TwoDigits(1234567.0), "1,200,000");
}

} // namespace
} // namespace vantage
