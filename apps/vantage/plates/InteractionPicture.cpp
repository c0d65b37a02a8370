#include "plates/InteractionPicture.h"

#include "plates/OffscreenDisplay.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>
#include <vtkActor.h>
#include <vtkCameraPass.h>
#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkColorTransferFunction.h>
#include <vtkLightsPass.h>
#include <vtkLookupTable.h>
#include <vtkNew.h>
#include <vtkOpaquePass.h>
#include <vtkOverlayPass.h>
#include <vtkPolyData.h>
#include <vtkPolyDataMapper.h>
#include <vtkProperty.h>
#include <vtkRenderPassCollection.h>
#include <vtkRenderer.h>
#include <vtkScalarBarActor.h>
#include <vtkSequencePass.h>
#include <vtkTextActor.h>
#include <vtkTextProperty.h>
#include <vtkTranslucentPass.h>
#include <vtkUnsignedCharArray.h>

namespace vantage
{

namespace
{

constexpr int Decades = 5;
constexpr double LineWidth = 0.9; ///< pixels
constexpr double StrongestOpacity = 0.9;

/// Corner points of "inferno" (Smith and van der Walt 2015), without its darkest quarter, which
/// would not be seen on black.
constexpr std::array<std::array<double, 3>, 5> Colors = { { { 0.33, 0.06, 0.43 },
  { 0.58, 0.15, 0.40 }, { 0.85, 0.28, 0.25 }, { 0.98, 0.56, 0.04 }, { 0.99, 0.99, 0.65 } } };

struct Line
{
  vtkIdType cell;
  double value;
};

/// Those within the scale, weakest first; equal ones in the order they were made.
std::vector<Line> SortedLines(vtkDataArray* values, double lowest)
{
  std::vector<Line> lines;
  for (vtkIdType cell = 0; cell < values->GetNumberOfTuples(); ++cell)
  {
    const double value = values->GetComponent(cell, 0);
    if (value >= lowest)
    {
      lines.push_back({ cell, value });
    }
  }
  std::stable_sort(
    lines.begin(), lines.end(), [](const Line& a, const Line& b) { return a.value < b.value; });
  return lines;
}

/// Of the line of that rank (1: the strongest). The first are nearly opaque, the others fade with
/// their rank, so that ten times the lines leave little more than twice the ink on the page.
double OpacityOf(std::size_t rank, double opaqueLines)
{
  return StrongestOpacity * std::min(1.0, std::pow(opaqueLines / static_cast<double>(rank), 0.6));
}

/// The next number above with a single digit that is not zero.
double RoundedUp(double value)
{
  const double decade = std::pow(10.0, std::floor(std::log10(value)));
  return std::ceil(value / decade) * decade;
}

} // namespace

vtkSmartPointer<vtkLookupTable> MakeInteractionScale(
  vtkPolyData* interactions, const std::string& array)
{
  double range[2] = { 0.0, 1.0 };
  interactions->GetCellData()->GetArray(array.c_str())->GetRange(range);
  const double top = range[1] > 0.0 ? RoundedUp(range[1]) : 1.0;

  vtkNew<vtkColorTransferFunction> colors;
  colors->SetColorSpaceToLab();
  for (std::size_t k = 0; k < Colors.size(); ++k)
  {
    colors->AddRGBPoint(
      static_cast<double>(k) / (Colors.size() - 1), Colors[k][0], Colors[k][1], Colors[k][2]);
  }
  const auto scale = vtkSmartPointer<vtkLookupTable>::New();
  constexpr int Steps = 256;
  scale->SetNumberOfTableValues(Steps);
  for (int k = 0; k < Steps; ++k)
  {
    double color[3];
    colors->GetColor(static_cast<double>(k) / (Steps - 1), color);
    scale->SetTableValue(k, color[0], color[1], color[2]);
  }
  scale->SetRange(top * std::pow(10.0, -Decades), top);
  scale->SetScaleToLog10();
  return scale;
}

vtkSmartPointer<vtkActor> MakeInteractionLines(
  vtkPolyData* interactions, const std::string& array, vtkLookupTable* scale, double opaqueLines)
{
  vtkDataArray* values = interactions->GetCellData()->GetArray(array.c_str());
  vtkNew<vtkCellArray> cells;
  vtkNew<vtkUnsignedCharArray> colors;
  colors->SetNumberOfComponents(4);
  const std::vector<Line> lines = SortedLines(values, scale->GetRange()[0]);
  for (std::size_t place = 0; place < lines.size(); ++place)
  {
    const Line& line = lines[place];
    vtkIdType count = 0;
    const vtkIdType* ends = nullptr;
    interactions->GetLines()->GetCellAtId(line.cell, count, ends);
    cells->InsertNextCell(count, ends);
    const unsigned char* color = scale->MapValue(line.value);
    const double opacity = OpacityOf(lines.size() - place, opaqueLines);
    colors->InsertNextTuple4(color[0], color[1], color[2], 255.0 * opacity);
  }
  vtkNew<vtkPolyData> drawn;
  drawn->SetPoints(interactions->GetPoints());
  drawn->SetLines(cells);
  drawn->GetCellData()->SetScalars(colors);

  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputData(drawn);
  mapper->SetScalarModeToUseCellData();
  const auto actor = vtkSmartPointer<vtkActor>::New();
  actor->SetMapper(mapper);
  actor->ForceTranslucentOn();
  actor->GetProperty()->LightingOff();
  actor->GetProperty()->SetLineWidth(
    static_cast<float>(LineWidth * OffscreenDisplay::Supersampling));
  return actor;
}

void AddScaleBar(vtkRenderer* renderer, vtkLookupTable* scale, const std::string& title, int height)
{
  // In parts of the picture; there is room below a building that is seen obliquely.
  constexpr double Left = 0.53;
  constexpr double Bottom = 0.02;
  constexpr double Width = 0.43;
  constexpr double Height = 0.11;
  const int fontSize = std::max(7, height / 37) * OffscreenDisplay::Supersampling;

  vtkNew<vtkScalarBarActor> bar;
  bar->SetLookupTable(scale);
  bar->SetNumberOfLabels(Decades + 1);
  bar->SetLabelFormat("%.0e");
  bar->SetOrientationToHorizontal();
  bar->SetPosition(Left, Bottom);
  bar->SetWidth(Width);
  bar->SetHeight(Height);
  bar->SetBarRatio(0.3);
  bar->UnconstrainedFontSizeOn();

  vtkNew<vtkTextActor> caption;
  caption->SetInput(title.c_str());
  caption->GetPositionCoordinate()->SetCoordinateSystemToNormalizedViewport();
  caption->SetPosition(Left + 0.5 * Width, Bottom + 0.75 * Height); // above the labels
  caption->GetTextProperty()->SetJustificationToCentered();

  for (vtkTextProperty* text : { bar->GetLabelTextProperty(), caption->GetTextProperty() })
  {
    text->SetFontSize(fontSize);
    text->SetColor(0.1, 0.1, 0.1);
    text->BoldOff();
    text->ItalicOff();
    text->ShadowOff();
  }
  renderer->AddActor2D(bar);
  renderer->AddActor2D(caption);
}

void DrawInOrder(vtkRenderer* renderer)
{
  vtkNew<vtkRenderPassCollection> passes;
  passes->AddItem(vtkNew<vtkLightsPass>());
  passes->AddItem(vtkNew<vtkOpaquePass>());
  passes->AddItem(vtkNew<vtkTranslucentPass>());
  passes->AddItem(vtkNew<vtkOverlayPass>());
  vtkNew<vtkSequencePass> sequence;
  sequence->SetPasses(passes);
  vtkNew<vtkCameraPass> camera;
  camera->SetDelegatePass(sequence);
  renderer->SetPass(camera);
}

} // namespace vantage
