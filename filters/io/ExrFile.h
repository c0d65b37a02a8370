#pragma once

#include "core/math/Image.h"

#include <string>

/// \file ExrFile.h
/// Radiance images as OpenEXR.

namespace vantage
{

/// Writes channels R, G, B as 32-bit floats, linear, without loss (ZIP), whole or not at all.
/// \throw InputError when the image is empty or the file cannot be written.
void WriteExr(const Image& image, const std::string& path);

/// Reads channels R, G, B (any precision; a channel Y alone is taken for grey).
/// \throw InputError when the file does not exist, is no OpenEXR image, has other channels, more
/// than 32768 rows or columns, or claims more pixels than it can hold.
Image ReadExr(const std::string& path);

} // namespace vantage
