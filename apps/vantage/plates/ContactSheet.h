#pragma once

#include <string>
#include <vector>
#include <vtkSmartPointer.h>

class vtkImageData;

/// \file ContactSheet.h
/// All plates on one page.

namespace vantage
{

class OffscreenDisplay;

/// A picture with a caption. A page has rows of four; a wide picture takes two places.
struct SheetPicture
{
  vtkSmartPointer<vtkImageData> image; ///< 3 unsigned char
  std::string name;                    ///< "1a", set in bold
  std::string caption;                 ///< one line
  std::string figures;                 ///< one line, set smaller
  int row = 0;
  int column = 0;
  int columns = 1;
};

/// What stands on the page.
struct Sheet
{
  std::string title;
  std::string subtitle;
  std::vector<SheetPicture> pictures;
  std::vector<std::vector<std::string>> table; ///< rows of as many cells, the first is the header
  std::vector<std::string> notes;              ///< lines below the table
};

/// Width of the space between two pictures, as a part of a picture's width.
inline constexpr double SheetGutter = 1.0 / 24.0;

/// White page, pictures of the same height in rows, below them the table.
vtkSmartPointer<vtkImageData> DrawContactSheet(OffscreenDisplay& display, const Sheet& sheet);

} // namespace vantage
