#include "report/SpeedChart.h"

#include "plates/OffscreenDisplay.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <functional>
#include <vtkAxis.h>
#include <vtkChartLegend.h>
#include <vtkChartXY.h>
#include <vtkContextActor.h>
#include <vtkContextScene.h>
#include <vtkDoubleArray.h>
#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkPen.h>
#include <vtkPlotPoints.h>
#include <vtkRenderer.h>
#include <vtkStringArray.h>
#include <vtkTable.h>
#include <vtkTextProperty.h>

namespace vantage
{

namespace
{

constexpr int Scale = OffscreenDisplay::Supersampling;
constexpr int FontSize = 15; ///< pixels
constexpr float LineWidth = 2.0F;
constexpr float MarkerSize = 10.0F;

struct CurveStyle
{
  std::array<unsigned char, 3> color;
  int marker;
  int line;
};

/// The colours of Okabe and Ito (2008), chosen for readers with any kind of colour vision. Pairs of
/// marker and line are different as well. VTK's crosses would be too thin.
const std::array<CurveStyle, 8> Styles = { {
  { { 0, 0, 0 }, VTK_MARKER_SQUARE, vtkPen::SOLID_LINE },
  { { 86, 180, 233 }, VTK_MARKER_CIRCLE, vtkPen::DASH_LINE },
  { { 230, 159, 0 }, VTK_MARKER_SQUARE, vtkPen::DASH_LINE },
  { { 0, 158, 115 }, VTK_MARKER_DIAMOND, vtkPen::SOLID_LINE },
  { { 213, 94, 0 }, VTK_MARKER_CIRCLE, vtkPen::SOLID_LINE },
  { { 204, 121, 167 }, VTK_MARKER_SQUARE, vtkPen::DASH_DOT_LINE },
  { { 0, 114, 178 }, VTK_MARKER_DIAMOND, vtkPen::DASH_LINE },
  { { 120, 120, 120 }, VTK_MARKER_CIRCLE, vtkPen::DASH_DOT_LINE },
} };

/// The shortest text, with k and M for thousands and millions.
std::string ShortNumber(double value)
{
  const char* unit = value >= 1e9 ? " G" : value >= 1e6 ? " M" : value >= 1e3 ? " k" : "";
  const double scale = value >= 1e9 ? 1e9 : value >= 1e6 ? 1e6 : value >= 1e3 ? 1e3 : 1.0;
  char text[32];
  std::snprintf(text, sizeof text, "%.6g%s", value / scale, unit);
  return text;
}

std::string Percent(double value)
{
  char text[32];
  std::snprintf(text, sizeof text, "%.6g %%", 100.0 * value);
  return text;
}

void SetText(vtkTextProperty* text, int size)
{
  text->SetFontSize(size * Scale);
  text->SetColor(0.1, 0.1, 0.1);
  text->BoldOff();
  text->ItalicOff();
}

/// Number k of 1, 2, 5, 10, 20, 50 ...; of 1 it is 0.
double TickOf(int k)
{
  const int decade = k >= 0 ? k / 3 : -((2 - k) / 3);
  constexpr std::array<double, 3> Steps = { 1.0, 2.0, 5.0 };
  return Steps[static_cast<std::size_t>(k - 3 * decade)] * std::pow(10.0, decade);
}

/// The last tick that is not above the value.
int TickBelow(double value)
{
  int k = 3 * static_cast<int>(std::floor(std::log10(value))) - 1;
  while (TickOf(k + 1) <= value)
  {
    ++k;
  }
  return k;
}

/// Of the logarithms of values in [low, high], from tick to tick. Where these are many, only powers
/// of ten are written.
void SetAxis(vtkAxis* axis, const std::string& title, double low, double high,
  const std::function<std::string(double)>& print)
{
  constexpr int Many = 10;
  constexpr double Margin = 0.03; // of a decade, so that no marker stands on the frame
  const int first = TickBelow(low);
  const int last = TickBelow(high) + 1;
  vtkNew<vtkDoubleArray> positions;
  vtkNew<vtkStringArray> labels;
  for (int k = first; k <= last; ++k)
  {
    positions->InsertNextValue(std::log10(TickOf(k)));
    labels->InsertNextValue(last - first < Many || k % 3 == 0 ? print(TickOf(k)) : "");
  }
  const double from = std::log10(TickOf(first)) - Margin;
  const double to = std::log10(TickOf(last)) + Margin;
  axis->SetTitle(title);
  axis->SetBehavior(vtkAxis::FIXED);
  axis->SetRange(from, to);
  axis->SetCustomTickPositions(positions, labels);
  axis->GetGridPen()->SetColor(225, 225, 225);
  axis->GetGridPen()->SetWidth(Scale);
  axis->GetPen()->SetWidth(Scale);
  SetText(axis->GetTitleProperties(), FontSize);
  SetText(axis->GetLabelProperties(), FontSize);
}

/// \param table is filled; it must live as long as the chart
void AddCurve(vtkChartXY* chart, const ChartCurve& curve, vtkTable* table)
{
  vtkNew<vtkDoubleArray> costs;
  costs->SetName("cost");
  vtkNew<vtkDoubleArray> errors;
  errors->SetName(curve.name.c_str());
  for (const CurvePoint& point : curve.points)
  {
    costs->InsertNextValue(std::log10(point.cost));
    errors->InsertNextValue(std::log10(point.error));
  }
  table->AddColumn(costs);
  table->AddColumn(errors);
  const CurveStyle& style = Styles[curve.style % Styles.size()];
  auto* plot = vtkPlotPoints::SafeDownCast(chart->AddPlot(vtkChart::LINE));
  plot->SetInputData(table, 0, 1);
  plot->SetLabel(curve.name);
  plot->SetColor(style.color[0], style.color[1], style.color[2], 255);
  plot->SetWidth(LineWidth * Scale);
  plot->GetPen()->SetLineType(style.line);
  plot->SetMarkerStyle(style.marker);
  plot->SetMarkerSize(MarkerSize * Scale);
}

/// Smallest and largest of all points.
std::pair<double, double> RangeOf(
  const SpeedChart& chart, const std::function<double(const CurvePoint&)>& value)
{
  double low = std::numeric_limits<double>::infinity();
  double high = 0.0;
  for (const ChartCurve& curve : chart.curves)
  {
    for (const CurvePoint& point : curve.points)
    {
      low = std::min(low, value(point));
      high = std::max(high, value(point));
    }
  }
  return { low, high };
}

} // namespace

vtkSmartPointer<vtkImageData> DrawSpeedChart(
  OffscreenDisplay& display, const SpeedChart& chart, int width, int height)
{
  vtkNew<vtkChartXY> plots;
  std::vector<vtkNew<vtkTable>> tables(chart.curves.size());
  for (std::size_t k = 0; k < chart.curves.size(); ++k)
  {
    AddCurve(plots, chart.curves[k], tables[k]);
  }
  const auto [cheapest, dearest] = RangeOf(chart, [](const CurvePoint& p) { return p.cost; });
  const auto [best, worst] = RangeOf(chart, [](const CurvePoint& p) { return p.error; });
  SetAxis(plots->GetAxis(vtkAxis::BOTTOM), chart.costTitle, cheapest, dearest, ShortNumber);
  SetAxis(plots->GetAxis(vtkAxis::LEFT), "Error of the picture, relative L1", best, worst, Percent);
  plots->SetTitle(chart.title);
  SetText(plots->GetTitleProperties(), FontSize + 2);
  plots->SetShowLegend(true);
  vtkChartLegend* legend = plots->GetLegend();
  legend->SetInline(false);
  legend->SetHorizontalAlignment(vtkChartLegend::RIGHT);
  legend->SetVerticalAlignment(vtkChartLegend::TOP);
  SetText(legend->GetLabelProperties(), FontSize);
  legend->SetSymbolWidth(40 * Scale);

  vtkNew<vtkContextActor> actor;
  actor->GetScene()->AddItem(plots);
  vtkNew<vtkRenderer> renderer;
  renderer->SetBackground(1.0, 1.0, 1.0);
  renderer->AddActor(actor);
  actor->GetScene()->SetRenderer(renderer);
  return display.Draw({ renderer }, width, height);
}

} // namespace vantage
