#include "fuzz/Target.h"
#include "io/ExrFile.h"
#include "io/Files.h"

namespace vantage::fuzz
{

/// The bytes are an .exr.
void ReadBytes(const std::string& bytes)
{
  static const test::TemporaryFolder folder;
  Image image;
  if (IsRead([&] { image = ReadExr(folder.Write("i.exr", bytes)); }))
  {
    Require(image.width > 0 && image.height > 0 &&
              image.pixels.size() ==
                static_cast<std::size_t>(image.width) * static_cast<std::size_t>(image.height),
      "an image of another size than its pixels");
  }
}

} // namespace vantage::fuzz
