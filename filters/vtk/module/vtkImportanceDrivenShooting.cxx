#include "vtkImportanceDrivenShooting.h"

#include "CameraAdapter.h"
#include "SceneAdapter.h"
#include "SolutionAdapter.h"
#include "SolvedView.h"
#include "SolverSession.h"
#include "vtkTransportSolution.h"

#include <vtkCamera.h>
#include <vtkCellData.h>
#include <vtkDataArray.h>
#include <vtkDemandDrivenPipeline.h>
#include <vtkFieldData.h>
#include <vtkInformation.h>
#include <vtkInformationVector.h>
#include <vtkObjectFactory.h>
#include <vtkPolyData.h>
#include <vtkSMPTools.h>
#include <vtkTable.h>

#include <tbb/task_arena.h>

#include <algorithm>
#include <limits>

vtkStandardNewMacro(vtkImportanceDrivenShooting);
vtkCxxSetObjectMacro(vtkImportanceDrivenShooting, Camera, vtkCamera);

namespace
{

/// Of the points of the elements, where no error is asked for.
constexpr double DefaultGatherError = 0.01;

vantage::Accuracy AccuracyFromName(const std::string& name)
{
  if (name != "default" && name != "reference")
  {
    throw vantage::UnknownNameError("accuracy", name, "default, reference");
  }
  return name == "default" ? vantage::Accuracy::Default : vantage::Accuracy::Reference;
}

vantage::SolverSettings SettingsOf(vtkImportanceDrivenShooting* filter)
{
  vantage::SolverSettings settings;
  settings.method = vantage::MethodFromName(filter->GetMethod());
  settings.granularity = vantage::GranularityFromName(filter->GetGranularity());
  settings.refinement.oracle = vantage::RefinementOracleFromName(filter->GetRefinementOracle());
  settings.refinement.formFactorTolerance = filter->GetFormFactorTolerance();
  settings.refinement.powerTolerance = filter->GetPowerTolerance();
  settings.refinement.shadowTolerance = filter->GetShadowTolerance();
  settings.refinement.minimumElementSize = filter->GetMinimumElementSize();
  settings.refinement.maximumLevel = filter->GetMaximumLevel();
  settings.accuracy = AccuracyFromName(filter->GetAccuracy());
  settings.visibilityRays = filter->GetVisibilityRays();
  settings.viewRays = filter->GetViewRays();
  settings.initialPhase = filter->GetInitialPhase();
  settings.importance = filter->GetImportance();
  settings.seed = filter->GetSeed();
  return settings;
}

std::uint64_t StepLimitOf(vtkImportanceDrivenShooting* filter)
{
  if (filter->GetSteps() < 0)
  {
    throw vantage::InputError(
      "Steps is " + std::to_string(filter->GetSteps()) + "; give 0 or more");
  }
  return static_cast<std::uint64_t>(filter->GetSteps());
}

vantage::Camera CameraOf(vtkImportanceDrivenShooting* filter, const vantage::Scene& scene)
{
  if (filter->GetCamera())
  {
    return vantage::CameraFromVtk(filter->GetCamera(), filter->GetAspect());
  }
  const std::string name = filter->GetCameraName();
  if (!name.empty())
  {
    return scene.FindCamera(name);
  }
  vantage::Camera camera;
  filter->GetEyePosition(&camera.eye.x);
  filter->GetFocalPoint(&camera.lookAt.x);
  filter->GetViewUp(&camera.up.x);
  camera.fieldOfView = filter->GetViewAngle();
  camera.aspect = filter->GetAspect();
  return camera;
}

} // namespace

struct vtkImportanceDrivenShooting::Implementation
{
  vantage::SolverSession session;
};

vtkImportanceDrivenShooting::vtkImportanceDrivenShooting()
  : Impl(std::make_unique<Implementation>())
{
  const vantage::Camera camera;
  std::copy_n(&camera.eye.x, 3, this->EyePosition);
  std::copy_n(&camera.lookAt.x, 3, this->FocalPoint);
  std::copy_n(&camera.up.x, 3, this->ViewUp);
  this->ViewAngle = camera.fieldOfView;
  this->Aspect = camera.aspect;

  const vantage::Budget budget;
  this->Steps = VTK_ID_MAX;
  this->Error = 0.01;
  this->TimeLimit = budget.seconds;

  const vantage::SolverSettings settings;
  this->Method = vantage::NameOf(settings.method);
  this->Granularity = vantage::NameOf(settings.granularity);
  this->RefinementOracle = vantage::NameOf(settings.refinement.oracle);
  this->FormFactorTolerance = settings.refinement.formFactorTolerance;
  this->PowerTolerance = settings.refinement.powerTolerance;
  this->ShadowTolerance = settings.refinement.shadowTolerance;
  this->MinimumElementSize = settings.refinement.minimumElementSize;
  this->MaximumLevel = settings.refinement.maximumLevel;
  this->VisibilityRays = settings.visibilityRays;
  this->ViewRays = settings.viewRays;
  this->InitialPhase = settings.initialPhase;
  this->Importance = settings.importance;
  this->Seed = settings.seed;

  this->SetNumberOfOutputPorts(4);
  this->SetInputArrayToProcess(0, 0, 0, vtkDataObject::FIELD_ASSOCIATION_CELLS, "Albedo");
  this->SetInputArrayToProcess(1, 0, 0, vtkDataObject::FIELD_ASSOCIATION_CELLS, "Emission");
}

vtkImportanceDrivenShooting::~vtkImportanceDrivenShooting()
{
  vtkImportanceDrivenShooting::SetCamera(nullptr);
}

vtkMTimeType vtkImportanceDrivenShooting::GetMTime()
{
  const vtkMTimeType own = this->Superclass::GetMTime();
  return this->Camera ? std::max(own, this->Camera->GetMTime()) : own;
}

const vantage::Solver* vtkImportanceDrivenShooting::GetSolver() const
{
  return this->Impl->session.Find();
}

int vtkImportanceDrivenShooting::FillOutputPortInformation(int port, vtkInformation* info)
{
  constexpr const char* types[] = { "vtkPolyData", "vtkPolyData", "vtkTable",
    "vtkTransportSolution" };
  info->Set(vtkDataObject::DATA_TYPE_NAME(), types[port]);
  return 1;
}

vtkTypeBool vtkImportanceDrivenShooting::ProcessRequest(
  vtkInformation* request, vtkInformationVector** inputVector, vtkInformationVector* outputVector)
{
  // VTK's executive makes the types of data that VTK has; the solution is not among them.
  if (request->Has(vtkDemandDrivenPipeline::REQUEST_DATA_OBJECT()) &&
      !vtkTransportSolution::GetData(outputVector, 3))
  {
    vtkNew<vtkTransportSolution> solution;
    outputVector->GetInformationObject(3)->Set(vtkDataObject::DATA_OBJECT(), solution);
  }
  return this->Superclass::ProcessRequest(request, inputVector, outputVector);
}

vtkDataArray* vtkImportanceDrivenShooting::ChosenArray(
  int index, const char* usualName, vtkPolyData* input)
{
  int association = vtkDataObject::FIELD_ASSOCIATION_CELLS;
  vtkDataArray* array = this->GetInputArrayToProcess(index, input, association);
  if (array && association != vtkDataObject::FIELD_ASSOCIATION_CELLS)
  {
    throw vantage::InputError(std::string(usualName) +
                              ": the array that was chosen belongs to points; choose a cell array");
  }
  const char* name = this->GetInputArrayInformation(index)->Get(vtkDataObject::FIELD_NAME());
  if (array == nullptr && name != nullptr && std::string(name) != usualName)
  {
    throw vantage::InputError(std::string(usualName) + ": the input has no array of numbers " +
                              name + "; choose another with SetInputArrayToProcess");
  }
  return array;
}

void vtkImportanceDrivenShooting::Solve(vtkPolyData* input)
{
  vantage::MaterialArrays arrays = vantage::FindMaterialArrays(input);
  arrays.albedo = this->ChosenArray(0, "Albedo", input);
  arrays.emission = this->ChosenArray(1, "Emission", input);
  vantage::Scene scene = vantage::PolyDataToScene(input, arrays);
  const vantage::Camera camera = CameraOf(this, scene);
  const std::uint64_t steps = StepLimitOf(this);

  vantage::SolverSession& session = this->Impl->session;
  vantage::Solver& solver = session.Prepare(std::move(scene), SettingsOf(this), camera, steps);
  if (session.HasChanged())
  {
    for (const std::string& warning : solver.Warnings())
    {
      vtkWarningMacro(<< warning);
    }
  }

  vantage::Budget budget;
  budget.steps = this->Steps == VTK_ID_MAX ? budget.steps : steps - session.StepsDone();
  budget.seconds = this->TimeLimit;
  budget.error = this->Error;
  const vantage::StepReport before =
    solver.History().empty() ? vantage::StepReport() : solver.History().back();
  const vantage::RunEnd end = solver.Run(budget,
    [&](const vantage::StepReport& report)
    {
      this->UpdateProgress(vantage::FractionDone(budget, before, report));
      return this->GetAbortExecute() == 0;
    });
  if (end == vantage::RunEnd::Exhausted)
  {
    vtkWarningMacro(<< "solution: its error stays at " << solver.History().back().errorEstimate
                    << ", as elements are as small as they may be; set a smaller "
                       "MinimumElementSize, a larger MaximumLevel, or a larger Error");
  }
}

/// Fills output port 0; returns what it shows.
vantage::ElementSolution vtkImportanceDrivenShooting::ShowElements(vtkPolyData* elements)
{
  const vantage::SolverSession& session = this->Impl->session;
  const vantage::Solver& solver = session.Current();
  const bool isGathered = solver.Settings().method == vantage::Method::GoalOriented &&
                          this->GatherPoints && this->GetAbortExecute() == 0;
  if (!isGathered)
  {
    vantage::ElementSolution solved = solver.Elements();
    elements->ShallowCopy(vantage::ElementsToPolyData(solved));
    return solved;
  }
  const double error = this->Error > 0.0 ? std::min(this->Error, 1.0) : DefaultGatherError;
  vantage::GatheredElements gathered = solver.GatherElements(session.CurrentCamera(), error);
  const double errorOfSolution = solver.History().empty() ? std::numeric_limits<double>::infinity()
                                                          : solver.History().back().errorEstimate;
  elements->ShallowCopy(vantage::ElementsToPolyData(gathered, errorOfSolution));
  return std::move(gathered.elements);
}

int vtkImportanceDrivenShooting::RequestData(
  vtkInformation*, vtkInformationVector** inputVector, vtkInformationVector* outputVector)
{
  vtkPolyData* input = vtkPolyData::GetData(inputVector[0]);
  vtkPolyData* elements = vtkPolyData::GetData(outputVector, 0);
  vtkPolyData* interactions = vtkPolyData::GetData(outputVector, 1);
  vtkTable* history = vtkTable::GetData(outputVector, 2);
  vtkTransportSolution* solution = vtkTransportSolution::GetData(outputVector, 3);
  vantage::SolverSession& session = this->Impl->session;
  try
  {
    tbb::task_arena arena(vtkSMPTools::GetEstimatedNumberOfThreads());
    vantage::ElementSolution shown;
    arena.execute(
      [&]
      {
        this->Solve(input);
        shown = this->ShowElements(elements);
      });
    const vantage::Solver& solver = session.Current();
    elements->GetFieldData()->PassData(input->GetFieldData());
    interactions->ShallowCopy(vantage::InteractionsToPolyData(solver.Interactions()));
    history->ShallowCopy(vantage::HistoryToTable(solver.History()));
    solution->SetView(vantage::ViewOf(solver, shown, session.CurrentCamera()));
    solution->GetFieldData()->PassData(input->GetFieldData());
    return 1;
  }
  catch (const vantage::Error& error)
  {
    // Found before anything was done: what is solved so far is still good.
    vtkErrorMacro(<< error.what());
    return 0;
  }
  catch (const std::exception& error)
  {
    session.Reset();
    vtkErrorMacro(<< error.what());
    return 0;
  }
}

void vtkImportanceDrivenShooting::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  const auto print = [&](const char* name, const auto& value)
  { os << indent << name << ": " << value << "\n"; };
  const auto printVector = [&](const char* name, const double* v)
  { os << indent << name << ": (" << v[0] << ", " << v[1] << ", " << v[2] << ")\n"; };
  os << indent << "Camera: " << (this->Camera ? "" : "(none)") << "\n";
  if (this->Camera)
  {
    this->Camera->PrintSelf(os, indent.GetNextIndent());
  }
  print("CameraName", this->CameraName);
  printVector("EyePosition", this->EyePosition);
  printVector("FocalPoint", this->FocalPoint);
  printVector("ViewUp", this->ViewUp);
  print("ViewAngle", this->ViewAngle);
  print("Aspect", this->Aspect);
  print("Method", this->Method);
  print("Granularity", this->Granularity);
  print("Steps", this->Steps);
  print("Error", this->Error);
  print("TimeLimit", this->TimeLimit);
  print("RefinementOracle", this->RefinementOracle);
  print("FormFactorTolerance", this->FormFactorTolerance);
  print("PowerTolerance", this->PowerTolerance);
  print("ShadowTolerance", this->ShadowTolerance);
  print("MinimumElementSize", this->MinimumElementSize);
  print("MaximumLevel", this->MaximumLevel);
  print("Accuracy", this->Accuracy);
  print("VisibilityRays", this->VisibilityRays);
  print("ViewRays", this->ViewRays);
  print("InitialPhase", this->InitialPhase ? "on" : "off");
  print("Importance", this->Importance ? "on" : "off");
  print("GatherPoints", this->GatherPoints ? "on" : "off");
  print("Seed", this->Seed);
}
