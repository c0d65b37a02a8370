#include "plates/PlatePainter.h"

#include "SolutionAdapter.h"
#include "plates/ContactSheet.h"
#include "plates/ElementPicture.h"
#include "plates/InteractionPicture.h"
#include "plates/OffscreenDisplay.h"
#include "vtkRadianceToneMapping.h"

#include <vtkActor.h>
#include <vtkCamera.h>
#include <vtkDataArray.h>
#include <vtkImageAppend.h>
#include <vtkImageData.h>
#include <vtkLookupTable.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkRenderer.h>

namespace vantage
{

namespace
{

/// Rooms below interactions are shown darker by this many powers of two.
constexpr double Dimming = 2.0;
/// Lines that are opaque. A camera inside looks at few rooms and along many lines.
constexpr double OpaqueFromAbove = 130.0;
constexpr double OpaqueFromInside = 25.0;
/// For edges that need no more smoothing.
constexpr int SamplesPerPixel = 9;

vtkSmartPointer<vtkImageData> MakeGutter(int width, int height)
{
  auto gutter = vtkSmartPointer<vtkImageData>::New();
  gutter->SetDimensions(width, height, 1);
  gutter->AllocateScalars(VTK_UNSIGNED_CHAR, 3);
  gutter->GetPointData()->GetScalars()->Fill(255.0);
  return gutter;
}

} // namespace

PlatePainter::PlatePainter(OffscreenDisplay& display, int width, int height, double exposure)
  : Display(display)
  , Width(width)
  , Height(height)
  , Exposure(exposure)
{
}

void PlatePainter::SetRooms(vtkPolyData* elements, const Camera& overview)
{
  this->Rooms = elements;
  this->Shown = PatchesWorthShowing(elements);
  this->Overview = FitCamera(overview, elements, this->Shown);
}

vtkSmartPointer<vtkImageData> PlatePainter::DrawFromAbove(vtkPolyData* elements) const
{
  return this->Draw({ DrawElements(elements, this->Shown, this->Overview, this->Exposure) });
}

vtkSmartPointer<vtkImageData> PlatePainter::DrawView(
  const Camera& camera, const Solver& solver) const
{
  ElementImageSettings settings;
  settings.width = this->Width;
  settings.height = this->Height;
  settings.samplesPerPixel = SamplesPerPixel;
  vtkNew<vtkRadianceToneMapping> toneMapping;
  toneMapping->SetInputData(ImageToImageData(solver.Render(camera, settings)));
  toneMapping->AutomaticExposureOff();
  toneMapping->SetExposure(this->Exposure);
  toneMapping->Update();
  // Without the radiance that it also holds.
  auto image = vtkSmartPointer<vtkImageData>::New();
  image->CopyStructure(vtkImageData::SafeDownCast(toneMapping->GetOutput()));
  image->GetPointData()->SetScalars(toneMapping->GetOutput()->GetPointData()->GetArray("RGB"));
  return image;
}

vtkSmartPointer<vtkImageData> PlatePainter::DrawInteractionsFromAbove(
  vtkPolyData* interactions, const std::string& array, const std::string& title) const
{
  const auto rooms =
    DrawElements(this->Rooms, this->Shown, this->Overview, this->Exposure - Dimming);
  const auto scale = MakeInteractionScale(interactions, array);
  // A layer of their own: walls do not hide them.
  vtkNew<vtkRenderer> lines;
  lines->SetLayer(1);
  lines->SetActiveCamera(rooms->GetActiveCamera());
  lines->AddActor(MakeInteractionLines(interactions, array, scale, OpaqueFromAbove));
  AddScaleBar(lines, scale, title, this->Height);
  DrawInOrder(lines);
  return this->Draw({ rooms, lines });
}

vtkSmartPointer<vtkImageData> PlatePainter::DrawInteractionsFrom(
  const Camera& camera, vtkPolyData* interactions, const std::string& array) const
{
  const auto room = DrawElements(this->Rooms, this->Shown, camera, this->Exposure - Dimming);
  const auto scale = MakeInteractionScale(interactions, array);
  room->AddActor(MakeInteractionLines(interactions, array, scale, OpaqueFromInside));
  DrawInOrder(room);
  return this->Draw({ room });
}

vtkSmartPointer<vtkImageData> PlatePainter::DrawInteractionsTwice(vtkPolyData* interactions,
  const Camera& camera, const std::string& array, const std::string& title) const
{
  vtkNew<vtkImageAppend> both;
  both->AddInputData(this->DrawInteractionsFromAbove(interactions, array, title));
  both->AddInputData(MakeGutter(static_cast<int>(this->Width * SheetGutter), this->Height));
  both->AddInputData(this->DrawInteractionsFrom(camera, interactions, array));
  both->Update();
  return both->GetOutput();
}

vtkSmartPointer<vtkImageData> PlatePainter::Draw(const std::vector<vtkRenderer*>& renderers) const
{
  return this->Display.Draw(renderers, this->Width, this->Height);
}

} // namespace vantage
