#include "io/ExrFile.h"
#include "core/Error.h"
#include "io/Files.h"

#include <ImfFrameBuffer.h>
#include <ImfInputFile.h>
#include <gtest/gtest.h>

namespace vantage
{
namespace
{

using test::TemporaryFolder;

TEST(ExrFile, RoundTripKeepsFloatsAndRows)
{
  const TemporaryFolder folder;
  Image image(5, 3);
  for (std::size_t p = 0; p < image.pixels.size(); ++p)
  {
    // Values that a float holds exactly, beyond the range of half.
    image.pixels[p] = Color(0.25 * static_cast<double>(p), 1e6 + static_cast<double>(p), 0x1p-30);
  }
  WriteExr(image, folder / "a.exr");
  const Image back = ReadExr(folder / "a.exr");
  EXPECT_EQ(back.width, 5);
  EXPECT_EQ(back.height, 3);
  EXPECT_EQ(back.pixels, image.pixels);
  EXPECT_EQ(folder.FileCount(), 1u);
}

TEST(ExrFile, TheTopRowStandsFirstInTheFile)
{
  const TemporaryFolder folder;
  Image image(2, 3);
  image.At(0, 2) = Color(7.0, 0.0, 0.0);
  WriteExr(image, folder / "a.exr");
  // Read by the library alone: pixel (0, 0) of OpenEXR is the upper left one.
  Imf::InputFile file((folder / "a.exr").c_str());
  std::vector<float> red(6);
  Imf::FrameBuffer buffer;
  buffer.insert("R",
    Imf::Slice(Imf::FLOAT, reinterpret_cast<char*>(red.data()), sizeof(float), 2 * sizeof(float)));
  file.setFrameBuffer(buffer);
  file.readPixels(0, 2);
  EXPECT_EQ(red, (std::vector<float>{ 7.0f, 0.0f, 0.0f, 0.0f, 0.0f, 0.0f }));
}

TEST(ExrFile, RefusesAFileOfSomeBytesThatClaimsABillionPixels)
{
  const TemporaryFolder folder;
  WriteExr(Image(8, 8), folder / "whole.exr");
  std::string text = test::ReadText(folder / "whole.exr");
  // Behind the name, the type, the size and the lower ends of the data window.
  const std::size_t upperEnds = text.find("dataWindow") + 11 + 6 + 4 + 8;
  text.replace(upperEnds, 8, std::string("\xff\x7e\0\0\xff\x7e\0\0", 8));
  text.append(20000, '\0'); // there has to be a table of the rows
  try
  {
    ReadExr(folder.Write("huge.exr", text));
    FAIL() << "the file was read";
  }
  catch (const InputError& error)
  {
    EXPECT_NE(std::string(error.what()).find("more pixels"), std::string::npos) << error.what();
  }
}

TEST(ExrFile, RefusesWhatIsNoImage)
{
  const TemporaryFolder folder;
  EXPECT_THROW(ReadExr(folder / "none.exr"), InputError);
  EXPECT_THROW(ReadExr(folder.Write("text.exr", "no image")), InputError);
  WriteExr(Image(8, 8), folder / "whole.exr");
  const std::string whole = test::ReadText(folder / "whole.exr");
  EXPECT_THROW(ReadExr(folder.Write("half.exr", whole.substr(0, whole.size() / 2))), InputError);
  EXPECT_THROW(WriteExr(Image(), folder / "empty.exr"), InputError);
  EXPECT_THROW(WriteExr(Image(1, 1), folder / "none/a.exr"), InputError);
}

} // namespace
} // namespace vantage
