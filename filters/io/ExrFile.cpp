#include "io/ExrFile.h"

#include "core/Error.h"
#include "io/AtomicFile.h"

#include <ImfChannelList.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfInputFile.h>
#include <ImfOutputFile.h>
#include <algorithm>
#include <array>
#include <exception>
#include <filesystem>
#include <vector>

namespace vantage
{

namespace
{

constexpr std::array<const char*, 3> ChannelNames = { "R", "G", "B" };

/// Pixels, of what is read.
constexpr int LargestSide = 32768;
/// Even a picture of one colour takes a byte for so many pixels, but for what small ones need.
constexpr double PixelsOfAByte = 4096.0;
constexpr double PixelsOfAnyFile = 1 << 20;

/// Three floats a pixel, rows from top to bottom as OpenEXR wants them.
class FloatRows
{
public:
  FloatRows(int width, int height)
    : Width(width)
    , Height(height)
    , Values(std::size_t{ 3 } * width * height)
  {
  }

  float& At(int x, int yFromBottom, int channel)
  {
    const auto row = static_cast<std::size_t>(this->Height - 1 - yFromBottom);
    return this->Values[3 * (row * this->Width + x) + channel];
  }

  /// Where OpenEXR finds a channel whose data window begins at (left, top).
  Imf::Slice Channel(int channel, int left, int top)
  {
    const std::size_t pixel = 3 * sizeof(float);
    return Imf::Slice::Make(Imf::FLOAT, this->Values.data() + channel, { left, top }, this->Width,
      this->Height, pixel, pixel * this->Width);
  }

private:
  int Width;
  int Height;
  std::vector<float> Values;
};

/// The library quotes the file's own bytes.
std::string Printable(std::string text)
{
  std::replace_if(
    text.begin(), text.end(), [](unsigned char c) { return c < ' ' || c > '~'; }, '?');
  return text;
}

std::array<const char*, 3> ChannelsOf(const Imf::ChannelList& channels, const std::string& path)
{
  if (channels.findChannel("R") && channels.findChannel("G") && channels.findChannel("B"))
  {
    return ChannelNames;
  }
  if (channels.findChannel("Y"))
  {
    return { "Y", "Y", "Y" };
  }
  throw InputError(path + ": it has no channels R, G, B or Y; export it as RGB");
}

/// One plane after the other, so that a grey channel may be read three times.
Image ReadChannels(Imf::InputFile& file, const std::string& path)
{
  const Imath::Box2i window = file.header().dataWindow();
  const int width = window.max.x - window.min.x + 1;
  const int height = window.max.y - window.min.y + 1;
  if (double(width) * height >
      PixelsOfAnyFile + PixelsOfAByte * static_cast<double>(std::filesystem::file_size(path)))
  {
    throw InputError(path + ": it claims more pixels than it can hold; write it again");
  }
  const std::array<const char*, 3> names = ChannelsOf(file.header().channels(), path);
  FloatRows rows(width, height);
  for (int k = 0; k < 3; ++k)
  {
    Imf::FrameBuffer buffer;
    buffer.insert(names[k], rows.Channel(k, window.min.x, window.min.y));
    file.setFrameBuffer(buffer);
    file.readPixels(window.min.y, window.max.y);
  }
  Image image(width, height);
  for (int y = 0; y < height; ++y)
  {
    for (int x = 0; x < width; ++x)
    {
      image.At(x, y) = Color(rows.At(x, y, 0), rows.At(x, y, 1), rows.At(x, y, 2));
    }
  }
  return image;
}

} // namespace

void WriteExr(const Image& image, const std::string& path)
{
  if (image.pixels.empty())
  {
    throw InputError(path + ": an image without pixels cannot be written; give it a size");
  }
  FloatRows rows(image.width, image.height);
  Imf::Header header(image.width, image.height);
  Imf::FrameBuffer buffer;
  for (int k = 0; k < 3; ++k)
  {
    header.channels().insert(ChannelNames[k], Imf::Channel(Imf::FLOAT));
    buffer.insert(ChannelNames[k], rows.Channel(k, 0, 0));
    for (int y = 0; y < image.height; ++y)
    {
      for (int x = 0; x < image.width; ++x)
      {
        rows.At(x, y, k) = static_cast<float>(image.At(x, y)[k]);
      }
    }
  }
  WriteAtomically(path,
    [&](const std::string& temporary)
    {
      try
      {
        Imf::OutputFile file(temporary.c_str(), header);
        file.setFrameBuffer(buffer);
        file.writePixels(image.height);
      }
      catch (const std::exception& error)
      {
        throw InputError(path + ": cannot be written (" + error.what() + "); is the disk full?");
      }
    });
}

Image ReadExr(const std::string& path)
{
  std::error_code error;
  if (!std::filesystem::is_regular_file(path, error))
  {
    throw InputError(path + ": there is no such file; check the name");
  }
  // Else the library allocates whatever a damaged file asks for.
  Imf::Header::setMaxImageSize(LargestSide, LargestSide);
  Imf::Header::setMaxTileSize(LargestSide, LargestSide);
  try
  {
    Imf::InputFile file(path.c_str());
    return ReadChannels(file, path);
  }
  catch (const InputError&)
  {
    throw;
  }
  catch (const std::exception& error)
  {
    throw InputError(
      path + ": it cannot be read as OpenEXR (" + Printable(error.what()) + "); write it again");
  }
}

} // namespace vantage
