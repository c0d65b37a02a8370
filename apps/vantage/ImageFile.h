#pragma once

#include "core/math/Image.h"
#include "core/view/ToneMapping.h"

#include <string>
#include <vector>

/// \file ImageFile.h
/// Images by the suffix of their file: .exr and .vti hold radiance, .png what a screen shows.

namespace vantage
{

const std::vector<std::string>& ImageSuffixes();

/// Tone mapping is for .png only. \throw InputError when the suffix is unknown or the file cannot
/// be written.
void WriteImage(
  const Image& image, const std::string& path, const ToneMappingSettings& toneMapping = {});

/// Radiance, W m^-2 sr^-1; of a .png linear values in [0, 1], the transfer function of sRGB undone.
/// \throw InputError when the suffix is unknown or the file is not such an image.
Image ReadImage(const std::string& path);

} // namespace vantage
