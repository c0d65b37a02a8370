#include "report/ReportFigures.h"

#include "ImageFile.h"
#include "SolutionAdapter.h"
#include "TextTable.h"
#include "VtkFile.h"
#include "plates/PlatePainter.h"
#include "report/MethodRun.h"

#include <algorithm>
#include <cmath>
#include <vtkCellData.h>
#include <vtkDataArray.h>
#include <vtkImageData.h>
#include <vtkPolyData.h>

namespace vantage
{

namespace
{

/// Ends of a diverging scale that readers with any kind of colour vision can tell apart.
constexpr ScreenColor TooBright = { 179, 88, 6 };
constexpr ScreenColor TooDark = { 33, 82, 166 };

constexpr int PanelHeight = 360; ///< pixels

double MeanRadiance(const Image& image)
{
  double sum = 0.0;
  for (const Color& pixel : image.pixels)
  {
    sum += Mean(pixel);
  }
  return sum / static_cast<double>(image.pixels.size());
}

ScreenColor ColorOfDifference(double relative)
{
  const double size =
    std::log(std::abs(relative) / LeastDifference) / std::log(MostDifference / LeastDifference);
  const double part = std::isfinite(size) ? std::clamp(size, 0.0, 1.0) : 0.0;
  const ScreenColor& end = relative > 0.0 ? TooBright : TooDark;
  ScreenColor color{};
  for (std::size_t k = 0; k < color.size(); ++k)
  {
    color[k] = static_cast<std::uint8_t>(std::lround(255.0 + part * (end[k] - 255.0)));
  }
  return color;
}

double LargestOf(vtkPolyData* data, const std::string& array)
{
  return data->GetNumberOfCells() > 0 ? data->GetCellData()->GetArray(array.c_str())->GetRange()[1]
                                      : 0.0;
}

} // namespace

void WritePicture(const Target& target, const Image& image, const std::string& path)
{
  ToneMappingSettings settings;
  settings.exposure = target.exposure;
  WriteImage(image, path, settings);
}

void WriteDifference(const Target& target, const Image& image, const std::string& path)
{
  const double mean = MeanRadiance(target.reference);
  std::vector<ScreenColor> pixels;
  for (std::size_t p = 0; p < image.pixels.size(); ++p)
  {
    pixels.push_back(ColorOfDifference(Mean(image.pixels[p] - target.reference.pixels[p]) / mean));
  }
  WritePng(pixels, image.width, image.height, path);
}

InteractionPainter::InteractionPainter(OffscreenDisplay& display, const Target& target)
  : Display(display)
  , Goal(target)
{
}

/// Of a method that lights all rooms alike, coarsely.
vtkPolyData* InteractionPainter::Rooms()
{
  if (!this->LitRooms)
  {
    SolverSettings settings;
    settings.method = Method::ProgressiveShooting;
    settings.refinement.powerTolerance = 3e-3;
    settings.refinement.shadowTolerance = 1e-3;
    Solver solver(this->Goal.scene, settings);
    Budget budget;
    budget.error = 0.3;
    budget.seconds = 10.0;
    solver.Run(budget);
    this->LitRooms = ElementsToPolyData(solver.Elements());
  }
  return this->LitRooms;
}

InteractionFigure InteractionPainter::Draw(const Solver& solver)
{
  InteractionFigure figure;
  const auto interactions = InteractionsToPolyData(solver.Interactions());
  const bool knowsView = LargestOf(interactions, "Contribution") > 0.0;
  const std::string array = knowsView ? "Contribution" : "ShotFlux";
  if (LargestOf(interactions, array) <= 0.0)
  {
    return figure;
  }
  const std::string unit = knowsView ? "Contribution to the view [W/m\u00b2]" : "Flux carried [W]";
  figure.caption = Grouped(static_cast<std::uint64_t>(interactions->GetNumberOfCells())) +
                   " interactions, " +
                   (knowsView ? "by their contribution to the view" : "by the flux they carry");
  const std::vector<Camera>& cameras = this->Goal.scene.cameras;
  const auto overview = std::find_if(
    cameras.begin(), cameras.end(), [](const Camera& camera) { return camera.name == "overview"; });
  const int width = static_cast<int>(std::lround(PanelHeight * this->Goal.camera.aspect));
  PlatePainter painter(this->Display, width, PanelHeight, this->Goal.exposure);
  if (overview != cameras.end())
  {
    Camera above = *overview;
    above.aspect = this->Goal.camera.aspect;
    painter.SetRooms(this->Rooms(), above);
    figure.image = painter.DrawInteractionsTwice(interactions, this->Goal.camera, array, unit);
  }
  else
  {
    painter.SetRooms(this->Rooms(), this->Goal.camera);
    figure.image = painter.DrawInteractionsFrom(this->Goal.camera, interactions, array);
  }
  return figure;
}

} // namespace vantage
