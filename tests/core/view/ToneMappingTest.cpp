#include "core/view/ToneMapping.h"
#include "core/Error.h"

#include <cmath>
#include <gtest/gtest.h>
#include <limits>

namespace vantage
{
namespace
{

constexpr double Infinity = std::numeric_limits<double>::infinity();

ScreenColor MapOne(const Color& color, double exposure = 0.0)
{
  ToneMappingSettings settings;
  settings.exposure = exposure;
  return ToneMap({ color }, settings)[0];
}

TEST(ToneMapping, TransferFunctionHasThePointsOfItsStandard)
{
  EXPECT_EQ(LinearToSrgb(0.0), 0.0);
  EXPECT_NEAR(LinearToSrgb(1.0), 1.0, 1e-15);
  EXPECT_NEAR(LinearToSrgb(0.0031308), 0.04045, 1e-6); // the standard's digits
  EXPECT_NEAR(LinearToSrgb(0.214041), 0.5, 1e-6);
  for (double x = 0.0; x <= 1.0; x += 0.01)
  {
    EXPECT_NEAR(SrgbToLinear(LinearToSrgb(x)), x, 1e-7); // its two branches do not quite meet
  }
}

TEST(ToneMapping, AutomaticExposureTakesTheLogAverageToMiddleGrey)
{
  // Log average of 1 and 4 is 2.
  EXPECT_NEAR(AutomaticExposure({ Color(1.0), Color(4.0) }), std::log2(0.18 / 2.0), 1e-14);
  // What is black or no number does not count.
  EXPECT_NEAR(AutomaticExposure({ Color(0.0), Color(2.0), Color(NAN), Color(Infinity) }),
    std::log2(0.18 / 2.0), 1e-14);
  EXPECT_EQ(AutomaticExposure({}), 0.0);
  EXPECT_EQ(AutomaticExposure({ Color(0.0) }), 0.0);
}

TEST(ToneMapping, UnitOfRadianceDoesNotMatterWithoutAnExposure)
{
  const std::vector<Color> image = { Color(0.1, 0.2, 0.3), Color(1.0, 0.5, 0.2), Color(3.0) };
  std::vector<Color> scaled = image;
  for (Color& c : scaled)
  {
    c *= 1024.0; // a power of two: no rounding
  }
  EXPECT_EQ(ToneMap(image), ToneMap(scaled));
}

TEST(ToneMapping, FollowsTheEquation)
{
  const double white = ToneMappingSettings().white;
  for (const double luminance : { 0.01, 0.18, 0.7, 1.5 })
  {
    const double mapped = luminance * (1.0 + luminance / (white * white)) / (1.0 + luminance);
    const auto expected = static_cast<int>(std::lround(255.0 * LinearToSrgb(mapped)));
    EXPECT_EQ(MapOne(Color(luminance))[0], expected);
    EXPECT_EQ(MapOne(Color(luminance / 8.0), 3.0)[1], expected);
  }
  EXPECT_EQ(MapOne(Color(white)), (ScreenColor{ 255, 255, 255 }));
}

TEST(ToneMapping, ExtremesStayOnTheScreen)
{
  EXPECT_EQ(MapOne(Color(0.0)), (ScreenColor{ 0, 0, 0 }));
  EXPECT_EQ(MapOne(Color(1e300)), (ScreenColor{ 255, 255, 255 }));
  EXPECT_EQ(MapOne(Color(Infinity)), (ScreenColor{ 255, 255, 255 }));
  EXPECT_EQ(MapOne(Color(NAN)), (ScreenColor{ 0, 0, 0 }));
  EXPECT_EQ(MapOne(Color(-1.0)), (ScreenColor{ 0, 0, 0 }));
  EXPECT_EQ(MapOne(Color(100.0, 0.0, 0.0))[1], 0); // a saturated lamp keeps its hue
}

TEST(ToneMapping, RefusesWhatIsNoNumber)
{
  ToneMappingSettings settings;
  settings.exposure = NAN;
  EXPECT_THROW(ToneMap({ Color(1.0) }, settings), InputError);
  settings.exposure = 0.0;
  settings.white = 0.0;
  EXPECT_THROW(ToneMap({ Color(1.0) }, settings), InputError);
}

} // namespace
} // namespace vantage
