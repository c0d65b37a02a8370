#include "core/math/Image.h"

#include "core/Error.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace vantage
{

namespace
{

/// x / total, where nothing over nothing is no difference.
double Ratio(double x, double total)
{
  if (total > 0.0)
  {
    return x / total;
  }
  return x == 0.0 ? 0.0 : std::copysign(std::numeric_limits<double>::infinity(), x);
}

} // namespace

ImageDifference Compare(const Image& image, const Image& reference)
{
  if (image.width != reference.width || image.height != reference.height ||
      reference.pixels.empty())
  {
    throw InputError("images: sizes " + std::to_string(image.width) + "x" +
                     std::to_string(image.height) + " and " + std::to_string(reference.width) +
                     "x" + std::to_string(reference.height) +
                     " cannot be compared; give two of the same size");
  }
  double absolute = 0.0;
  double square = 0.0;
  double bias = 0.0;
  double total = 0.0;
  for (std::size_t p = 0; p < reference.pixels.size(); ++p)
  {
    for (int k = 0; k < 3; ++k)
    {
      const double d = image.pixels[p][k] - reference.pixels[p][k];
      absolute += std::abs(d);
      square += d * d;
      bias += d;
      total += std::abs(reference.pixels[p][k]);
    }
  }
  const double count = 3.0 * static_cast<double>(reference.pixels.size());
  ImageDifference result;
  result.relativeL1 = Ratio(absolute, total);
  result.relativeRmse = Ratio(std::sqrt(square / count), total / count);
  result.relativeBias = Ratio(bias, total);
  return result;
}

Image BlockMeans(const Image& image, int size)
{
  Image means((image.width + size - 1) / size, (image.height + size - 1) / size);
  for (int by = 0; by < means.height; ++by)
  {
    for (int bx = 0; bx < means.width; ++bx)
    {
      const int xEnd = std::min(image.width, (bx + 1) * size);
      const int yEnd = std::min(image.height, (by + 1) * size);
      for (int y = by * size; y < yEnd; ++y)
      {
        for (int x = bx * size; x < xEnd; ++x)
        {
          means.At(bx, by) += image.At(x, y);
        }
      }
      means.At(bx, by) /= static_cast<double>((xEnd - bx * size) * (yEnd - by * size));
    }
  }
  return means;
}

} // namespace vantage
