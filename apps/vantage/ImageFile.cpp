#include "ImageFile.h"

#include "CommandLine.h"
#include "VtkFile.h"
#include "io/ExrFile.h"

namespace vantage
{

const std::vector<std::string>& ImageSuffixes()
{
  static const std::vector<std::string> suffixes = { ".png", ".exr", ".vti" };
  return suffixes;
}

void WriteImage(const Image& image, const std::string& path, const ToneMappingSettings& toneMapping)
{
  RequireSuffix(path, ImageSuffixes());
  const std::string suffix = SuffixOf(path);
  if (suffix == ".exr")
  {
    WriteExr(image, path);
  }
  else if (suffix == ".vti")
  {
    WriteVti(image, path);
  }
  else
  {
    WritePng(ToneMap(image.pixels, toneMapping), image.width, image.height, path);
  }
}

Image ReadImage(const std::string& path)
{
  RequireSuffix(path, ImageSuffixes());
  const std::string suffix = SuffixOf(path);
  return suffix == ".exr" ? ReadExr(path) : suffix == ".vti" ? ReadVti(path) : ReadPng(path);
}

} // namespace vantage
