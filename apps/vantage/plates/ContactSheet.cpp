#include "plates/ContactSheet.h"

#include "plates/OffscreenDisplay.h"
#include "plates/PlateTable.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <vtkImageData.h>
#include <vtkImageResize.h>
#include <vtkImageSincInterpolator.h>
#include <vtkNew.h>
#include <vtkRenderer.h>
#include <vtkTextActor.h>
#include <vtkTextProperty.h>

namespace vantage
{

namespace
{

// All in pixels of the page.
constexpr int PictureWidth = 576;
constexpr int Gutter = static_cast<int>(PictureWidth * SheetGutter);
constexpr int Margin = 48;
constexpr int PlacesAcross = 4;
constexpr int PageWidth = 2 * Margin + PlacesAcross * PictureWidth + (PlacesAcross - 1) * Gutter;
constexpr int TitleHeight = 100;
constexpr int CaptionHeight = 76;
constexpr int TableLineHeight = 30;
constexpr int TitleSize = 34;
constexpr int CaptionSize = 20;
constexpr int SmallSize = 17;

struct TextStyle
{
  int size = SmallSize;
  bool isBold = false;
  bool isRight = false; ///< ends at the place given instead of beginning there
  double grey = 0.1;
};

/// A page that is filled from top to bottom; y counts downwards from the top.
class Page
{
public:
  explicit Page(int height)
    : Height(height)
  {
    this->Texts->SetBackground(1.0, 1.0, 1.0);
  }

  /// \param baseline of the text
  void Write(const std::string& text, int x, int baseline, const TextStyle& style)
  {
    constexpr int Scale = OffscreenDisplay::Supersampling;
    vtkNew<vtkTextActor> actor;
    actor->SetInput(text.c_str());
    actor->SetPosition(Scale * x, Scale * (this->Height - baseline));
    vtkTextProperty* property = actor->GetTextProperty();
    property->SetFontFamilyToArial();
    property->SetFontSize(Scale * style.size);
    property->SetBold(style.isBold);
    property->SetColor(style.grey, style.grey, style.grey);
    property->SetVerticalJustificationToBottom();
    property->UseTightBoundingBoxOff();
    if (style.isRight)
    {
      property->SetJustificationToRight();
    }
    this->Texts->AddActor2D(actor);
  }

  /// \param top of the picture, whose size fits already
  void Paste(vtkImageData* picture, int left, int top)
  {
    this->Pictures.push_back({ picture, left, top });
  }

  vtkSmartPointer<vtkImageData> Draw(OffscreenDisplay& display)
  {
    const auto page = display.Draw({ this->Texts }, PageWidth, this->Height);
    for (const Pasted& pasted : this->Pictures)
    {
      int size[3];
      pasted.picture->GetDimensions(size);
      const int bottom = this->Height - pasted.top - size[1];
      for (int y = 0; y < size[1]; ++y)
      {
        std::memcpy(page->GetScalarPointer(pasted.left, bottom + y, 0),
          pasted.picture->GetScalarPointer(0, y, 0), 3 * static_cast<std::size_t>(size[0]));
      }
    }
    return page;
  }

private:
  struct Pasted
  {
    vtkSmartPointer<vtkImageData> picture;
    int left, top;
  };

  int Height;
  vtkNew<vtkRenderer> Texts;
  std::vector<Pasted> Pictures;
};

int LeftOf(int column)
{
  return Margin + column * (PictureWidth + Gutter);
}

int WidthOf(const SheetPicture& picture)
{
  return picture.columns * PictureWidth + (picture.columns - 1) * Gutter;
}

/// Of the pictures one place wide; wide ones are made to fit.
int PictureHeight(const Sheet& sheet)
{
  int size[3] = { 4, 3, 1 };
  for (const SheetPicture& picture : sheet.pictures)
  {
    if (picture.columns == 1)
    {
      picture.image->GetDimensions(size);
    }
  }
  return std::max(
    1, static_cast<int>(std::lround(static_cast<double>(PictureWidth) * size[1] / size[0])));
}

vtkSmartPointer<vtkImageData> Resized(vtkImageData* image, int width, int height)
{
  vtkNew<vtkImageSincInterpolator> interpolator;
  interpolator->AntialiasingOn();
  vtkNew<vtkImageResize> resize;
  resize->SetInputData(image);
  resize->SetInterpolator(interpolator);
  resize->SetOutputDimensions(width, height, 1);
  resize->Update();
  return resize->GetOutput();
}

/// Right or left ends of the columns, so that the table fills the page.
std::vector<int> ColumnPlaces(const std::vector<std::vector<std::string>>& table)
{
  std::vector<double> widths(table.front().size());
  double sum = 0.0;
  for (std::size_t column = 0; column < widths.size(); ++column)
  {
    for (const std::vector<std::string>& row : table)
    {
      widths[column] = std::max(widths[column], static_cast<double>(row[column].size() + 3));
    }
    sum += widths[column];
  }
  std::vector<int> places;
  double left = 0.0;
  for (std::size_t column = 0; column < widths.size(); ++column)
  {
    const double space = 3.0;
    const double place = IsNumberColumn(column) ? left + widths[column] - space : left;
    places.push_back(Margin + static_cast<int>((PageWidth - 2 * Margin) * place / sum));
    left += widths[column];
  }
  return places;
}

void WriteTable(Page& page, const std::vector<std::vector<std::string>>& table, int top)
{
  const std::vector<int> places = ColumnPlaces(table);
  for (std::size_t row = 0; row < table.size(); ++row)
  {
    TextStyle style;
    style.isBold = row == 0;
    const int baseline = top + TableLineHeight * static_cast<int>(row + 1);
    for (std::size_t column = 0; column < table[row].size(); ++column)
    {
      style.isRight = IsNumberColumn(column);
      page.Write(table[row][column], places[column], baseline, style);
    }
  }
}

} // namespace

vtkSmartPointer<vtkImageData> DrawContactSheet(OffscreenDisplay& display, const Sheet& sheet)
{
  const int height = PictureHeight(sheet);
  const int rowHeight = height + CaptionHeight;
  int rows = 0;
  for (const SheetPicture& picture : sheet.pictures)
  {
    rows = std::max(rows, picture.row + 1);
  }
  const int tableTop = Margin + TitleHeight + rows * rowHeight;
  const int lines = static_cast<int>(sheet.table.size() + sheet.notes.size());
  Page page(tableTop + lines * TableLineHeight + 20 + Margin);

  page.Write(sheet.title, Margin, Margin + 36, { TitleSize, true });
  page.Write(sheet.subtitle, Margin, Margin + 72, { CaptionSize, false, false, 0.35 });
  for (const SheetPicture& picture : sheet.pictures)
  {
    const int left = LeftOf(picture.column);
    const int top = Margin + TitleHeight + picture.row * rowHeight;
    page.Paste(Resized(picture.image, WidthOf(picture), height), left, top);
    page.Write(picture.name, left, top + height + 30, { CaptionSize, true });
    page.Write(picture.caption, left + 40, top + height + 30, { CaptionSize });
    page.Write(picture.figures, left + 40, top + height + 54, { SmallSize, false, false, 0.35 });
  }
  WriteTable(page, sheet.table, tableTop);
  for (std::size_t k = 0; k < sheet.notes.size(); ++k)
  {
    const int line = static_cast<int>(sheet.table.size() + k + 1);
    page.Write(sheet.notes[k], Margin, tableTop + 20 + line * TableLineHeight,
      { SmallSize, false, false, 0.35 });
  }
  return page.Draw(display);
}

} // namespace vantage
