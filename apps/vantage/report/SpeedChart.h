#pragma once

#include "report/ReachTable.h"

#include <string>
#include <vector>
#include <vtkSmartPointer.h>

class vtkImageData;

/// \file SpeedChart.h
/// Error against cost, both axes logarithmic.

namespace vantage
{

class OffscreenDisplay;

/// A line with a marker at each of its points. Lines of different styles differ in colour, marker
/// and dashes, so that they can be told apart without colours.
struct ChartCurve
{
  std::string name;
  std::size_t style = 0;
  std::vector<CurvePoint> points; ///< costs and errors > 0
};

struct SpeedChart
{
  std::string title;
  std::string costTitle; ///< of the horizontal axis, with its unit
  std::vector<ChartCurve> curves;
};

/// Drawn by VTK's charts on white, with ticks at 1, 2 and 5 times powers of ten and the legend
/// beside the plot; 3 unsigned char. \pre a curve has a point
vtkSmartPointer<vtkImageData> DrawSpeedChart(
  OffscreenDisplay& display, const SpeedChart& chart, int width, int height);

} // namespace vantage
