#include "core/view/ToneMapping.h"

#include "core/Error.h"

#include <algorithm>
#include <cmath>
#include <string>

namespace vantage
{

namespace
{

constexpr double MiddleGrey = 0.18;

std::uint8_t ToByte(double linear)
{
  // The comparison is false for what is not a number, which so becomes black.
  const double inRange = linear > 0.0 ? std::min(linear, 1.0) : 0.0;
  return static_cast<std::uint8_t>(std::lround(255.0 * LinearToSrgb(inRange)));
}

ScreenColor MapOne(const Color& radiance, double scale, double white)
{
  const Color exposed = radiance * scale;
  const double luminance = Luminance(exposed);
  Color shown = exposed;
  if (std::isinf(luminance))
  {
    shown = Color(1.0);
  }
  else if (luminance > 0.0)
  {
    shown *= (1.0 + luminance / (white * white)) / (1.0 + luminance);
  }
  return { ToByte(shown.x), ToByte(shown.y), ToByte(shown.z) };
}

} // namespace

void ToneMappingSettings::Validate() const
{
  if (this->exposure && !std::isfinite(*this->exposure))
  {
    throw InputError("exposure: it is not a finite number; give stops, such as -2 or 0.5");
  }
  if (!(this->white > 0.0 && std::isfinite(this->white)))
  {
    throw InputError(
      "white: it is " + std::to_string(this->white) + "; give a luminance above zero");
  }
}

double AutomaticExposure(const std::vector<Color>& radiance)
{
  double sum = 0.0;
  std::size_t count = 0;
  for (const Color& c : radiance)
  {
    const double luminance = Luminance(c);
    if (luminance > 0.0 && std::isfinite(luminance))
    {
      sum += std::log2(luminance);
      ++count;
    }
  }
  return count == 0 ? 0.0 : std::log2(MiddleGrey) - sum / static_cast<double>(count);
}

std::vector<ScreenColor> ToneMap(
  const std::vector<Color>& radiance, const ToneMappingSettings& settings)
{
  settings.Validate();
  const double scale =
    std::exp2(settings.exposure ? *settings.exposure : AutomaticExposure(radiance));
  std::vector<ScreenColor> screen(radiance.size());
  std::transform(radiance.begin(), radiance.end(), screen.begin(),
    [&](const Color& c) { return MapOne(c, scale, settings.white); });
  return screen;
}

double LinearToSrgb(double linear)
{
  return linear <= 0.0031308 ? 12.92 * linear : 1.055 * std::pow(linear, 1.0 / 2.4) - 0.055;
}

double SrgbToLinear(double srgb)
{
  return srgb <= 0.04045 ? srgb / 12.92 : std::pow((srgb + 0.055) / 1.055, 2.4);
}

} // namespace vantage
