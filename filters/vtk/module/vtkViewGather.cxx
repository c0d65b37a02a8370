#include "vtkViewGather.h"

#include "CameraAdapter.h"
#include "SolutionAdapter.h"
#include "SolvedView.h"
#include "vtkTransportSolution.h"

#include <vtkCamera.h>
#include <vtkFieldData.h>
#include <vtkImageData.h>
#include <vtkInformation.h>
#include <vtkInformationVector.h>
#include <vtkObjectFactory.h>
#include <vtkSMPTools.h>
#include <vtkStreamingDemandDrivenPipeline.h>

#include <tbb/task_arena.h>

#include <algorithm>

vtkStandardNewMacro(vtkViewGather);
vtkCxxSetObjectMacro(vtkViewGather, Camera, vtkCamera);

vtkViewGather::vtkViewGather()
{
  const vantage::GatherSettings settings;
  this->Width = settings.width;
  this->Height = settings.height;
  this->Error = settings.error;
  this->PixelCentres = settings.pixelCentres;
  this->Seed = settings.seed;
}

vtkViewGather::~vtkViewGather()
{
  vtkViewGather::SetCamera(nullptr);
}

vtkMTimeType vtkViewGather::GetMTime()
{
  const vtkMTimeType own = this->Superclass::GetMTime();
  return this->Camera ? std::max(own, this->Camera->GetMTime()) : own;
}

int vtkViewGather::FillInputPortInformation(int, vtkInformation* info)
{
  info->Set(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), "vtkTransportSolution");
  return 1;
}

int vtkViewGather::RequestInformation(
  vtkInformation*, vtkInformationVector**, vtkInformationVector* outputVector)
{
  vtkInformation* info = outputVector->GetInformationObject(0);
  const int extent[6] = { 0, this->Width - 1, 0, this->Height - 1, 0, 0 };
  info->Set(vtkStreamingDemandDrivenPipeline::WHOLE_EXTENT(), extent, 6);
  const double spacing[3] = { 1.0, 1.0, 1.0 };
  const double origin[3] = { 0.0, 0.0, 0.0 };
  info->Set(vtkDataObject::SPACING(), spacing, 3);
  info->Set(vtkDataObject::ORIGIN(), origin, 3);
  vtkDataObject::SetPointDataActiveScalarInfo(info, VTK_FLOAT, 3);
  return 1;
}

vantage::Camera vtkViewGather::CameraOf(vtkTransportSolution* solution) const
{
  const double aspect = static_cast<double>(this->Width) / this->Height;
  if (this->Camera)
  {
    return vantage::CameraFromVtk(this->Camera, aspect);
  }
  vantage::Camera camera = solution->GetView()->camera;
  if (!this->CameraName.empty())
  {
    vantage::Scene scene;
    scene.cameras = vantage::CamerasFromFieldData(solution->GetFieldData());
    camera = scene.FindCamera(this->CameraName);
  }
  camera.aspect = aspect;
  return camera;
}

void vtkViewGather::Gather(vtkTransportSolution* solution, vtkImageData* output)
{
  if (!solution || !solution->HasSolution())
  {
    throw vantage::InputError(
      "input: nothing was solved; connect port 3 of vtkImportanceDrivenShooting");
  }
  vantage::GatherSettings settings;
  settings.width = this->Width;
  settings.height = this->Height;
  settings.error = this->Error;
  settings.pixelCentres = this->PixelCentres;
  settings.seed = this->Seed;
  settings.Validate();
  const vantage::SolvedView& solved = *solution->GetView();
  const vantage::Camera camera = this->CameraOf(solution);
  if (solved.isForItsView && solved.LooksAlike(camera) && camera.aspect > solved.camera.aspect &&
      !solved.IsMadeFor(camera, this->Width, this->Height))
  {
    vtkWarningMacro(<< "view: " << this->Width << " x " << this->Height
                    << " pixels are wider than what was solved for; give Aspect " << camera.aspect
                    << " to vtkImportanceDrivenShooting");
  }
  const vantage::GatheredView view = solved.snapshot->Gather(camera, settings,
    [this](double done)
    {
      this->UpdateProgress(done);
      return this->GetAbortExecute() == 0;
    });
  if (this->GetAbortExecute() == 0)
  {
    output->ShallowCopy(vantage::ViewToImageData(view, camera, solved));
  }
}

int vtkViewGather::RequestData(
  vtkInformation*, vtkInformationVector** inputVector, vtkInformationVector* outputVector)
{
  vtkTransportSolution* solution = vtkTransportSolution::GetData(inputVector[0]);
  vtkImageData* output = vtkImageData::GetData(outputVector);
  output->Initialize(); // VTK keeps the scalars of the last picture
  try
  {
    tbb::task_arena arena(vtkSMPTools::GetEstimatedNumberOfThreads());
    arena.execute([&] { this->Gather(solution, output); });
    return 1;
  }
  catch (const std::exception& error)
  {
    vtkErrorMacro(<< error.what());
    return 0;
  }
}

void vtkViewGather::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  const auto print = [&](const char* name, const auto& value)
  { os << indent << name << ": " << value << "\n"; };
  os << indent << "Camera: " << (this->Camera ? "" : "(none)") << "\n";
  if (this->Camera)
  {
    this->Camera->PrintSelf(os, indent.GetNextIndent());
  }
  print("CameraName", this->CameraName);
  print("Width", this->Width);
  print("Height", this->Height);
  print("Error", this->Error);
  print("PixelCentres", this->PixelCentres ? "on" : "off");
  print("Seed", this->Seed);
}
