#pragma once

#include "core/math/Types.h"

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

/// \file ToneMapping.h
/// From radiance to what a screen shows.

namespace vantage
{

struct ToneMappingSettings
{
  /// Radiance is multiplied by 2^exposure first. Without one, AutomaticExposure() is taken.
  std::optional<double> exposure;
  /// The luminance, after exposure, that becomes pure white, > 0. Brighter is white too.
  double white = 2.0;

  /// \throw InputError naming the first value out of range.
  void Validate() const;
};

/// Linear red, green, blue of Rec. 709 to relative luminance.
inline double Luminance(const Color& c)
{
  return 0.2126 * c.x + 0.7152 * c.y + 0.0722 * c.z;
}

/// The exposure that takes the log-average luminance to middle grey, 0.18 (Reinhard et al. 2002,
/// equations 1 and 2); pixels that are black or not finite do not count. 0 when all are.
double AutomaticExposure(const std::vector<Color>& radiance);

/// Red, green, blue on a screen, 0 .. 255.
using ScreenColor = std::array<std::uint8_t, 3>;

/// Photographic tone reproduction: after exposure, luminance L becomes
/// L (1 + L / white^2) / (1 + L), hue is kept (Reinhard et al. 2002, equation 4); then the transfer
/// function of sRGB (IEC 61966-2-1), rounded. What is not a number becomes black. O(n).
/// \throw InputError as ToneMappingSettings::Validate.
std::vector<ScreenColor> ToneMap(
  const std::vector<Color>& radiance, const ToneMappingSettings& settings = {});

/// The transfer function of sRGB for one channel in [0, 1], and its inverse.
double LinearToSrgb(double linear);
double SrgbToLinear(double srgb);

} // namespace vantage
