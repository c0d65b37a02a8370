#pragma once

#include "core/math/Types.h"

#include <vector>

/// \file Image.h
/// A radiance image.

namespace vantage
{

/// Linear radiance, W m^-2 sr^-1, rows from bottom to top, pixels from left to right.
struct Image
{
  int width = 0;
  int height = 0;
  std::vector<Color> pixels;

  Image() = default;
  Image(int w, int h)
    : width(w)
    , height(h)
    , pixels(static_cast<std::size_t>(w) * h, Color(0.0))
  {
  }
  Color& At(int x, int y) { return this->pixels[static_cast<std::size_t>(y) * this->width + x]; }
  const Color& At(int x, int y) const
  {
    return this->pixels[static_cast<std::size_t>(y) * this->width + x];
  }
};

/// How far `image` is from `reference`, over all pixels and channels.
struct ImageDifference
{
  double relativeL1 = 0.0;   ///< sum |image - reference| / sum |reference|
  double relativeRmse = 0.0; ///< root mean square difference / mean |reference|
  double relativeBias = 0.0; ///< sum (image - reference) / sum |reference|
};

/// \throw InputError when the sizes differ or an image is empty. A black reference gives 0 for an
/// equal image and infinity otherwise.
ImageDifference Compare(const Image& image, const Image& reference);

/// Means of blocks of size x size pixels; partial blocks at the right and top edges are kept.
Image BlockMeans(const Image& image, int size);

} // namespace vantage
