#include "plates/SolutionPipeline.h"

#include "CameraAdapter.h"
#include "vtkImportanceDrivenShooting.h"
#include "vtkTransportSceneReader.h"

#include <vtkCamera.h>
#include <vtkCommand.h>
#include <vtkExecutive.h>
#include <vtkPolyData.h>

namespace vantage
{

namespace
{

/// What an algorithm has to say when it fails. Its executive says that it failed, and warnings are
/// the solver's, which the command prints: neither is to reach the screen.
class MessageRecorder : public vtkCommand
{
public:
  static MessageRecorder* New() { return new MessageRecorder; }

  void Execute(vtkObject* caller, unsigned long event, void* text) override
  {
    if (event == vtkCommand::ErrorEvent && caller->IsA("vtkAlgorithm") && this->Error.empty())
    {
      // "ERROR: In FILE, line N\nCLASS (ADDRESS): MESSAGE"
      const std::string message = static_cast<const char*>(text);
      const std::string beforeMessage = "): ";
      const auto found = message.find(beforeMessage);
      this->Error =
        found == std::string::npos ? message : message.substr(found + beforeMessage.size());
    }
  }

  std::string Error;
};

void UpdateOrThrow(vtkAlgorithm* algorithm)
{
  vtkNew<MessageRecorder> recorder;
  vtkObject* const speakers[] = { algorithm, algorithm->GetExecutive() };
  for (vtkObject* speaker : speakers)
  {
    speaker->AddObserver(vtkCommand::ErrorEvent, recorder);
    speaker->AddObserver(vtkCommand::WarningEvent, recorder);
  }
  const int areWarningsOn = vtkObject::GetGlobalWarningDisplay();
  vtkObject::GlobalWarningDisplayOn(); // else VTK makes no messages at all
  algorithm->Update();
  vtkObject::SetGlobalWarningDisplay(areWarningsOn);
  for (vtkObject* speaker : speakers)
  {
    speaker->RemoveObserver(recorder);
  }
  if (!recorder->Error.empty())
  {
    throw Error(recorder->Error);
  }
}

StepReport LastReport(vtkImportanceDrivenShooting* shooting)
{
  const Solver* solver = shooting->GetSolver();
  return solver && !solver->History().empty() ? solver->History().back() : StepReport();
}

vtkSmartPointer<vtkPolyData> CopyOf(vtkDataObject* output)
{
  auto copy = vtkSmartPointer<vtkPolyData>::New();
  copy->ShallowCopy(output);
  return copy;
}

} // namespace

SolutionPipeline::SolutionPipeline(const std::string& scene, Method method)
{
  this->Reader->SetFileName(scene.c_str());
  UpdateOrThrow(this->Reader);
  this->Shooting->SetInputConnection(this->Reader->GetOutputPort());
  this->Shooting->SetMethod(NameOf(method).c_str());
}

SolutionPipeline::~SolutionPipeline() = default;

void SolutionPipeline::SetCamera(const Camera& camera)
{
  this->Before = LastReport(this->Shooting);
  vtkNew<vtkCamera> view;
  CameraToVtk(camera, view);
  this->Shooting->SetCamera(view);
  this->Shooting->SetAspect(camera.aspect);
}

SolutionState SolutionPipeline::SolveSteps(std::uint64_t steps)
{
  this->Shooting->SetSteps(static_cast<vtkIdType>(steps));
  this->Shooting->SetError(0.0);
  return this->Solve();
}

SolutionState SolutionPipeline::SolveError(double error)
{
  this->Shooting->SetSteps(VTK_ID_MAX);
  this->Shooting->SetError(error);
  return this->Solve();
}

SolutionState SolutionPipeline::Solve()
{
  UpdateOrThrow(this->Shooting);
  const StepReport now = LastReport(this->Shooting);
  SolutionState state;
  state.elements = CopyOf(this->Shooting->GetOutputDataObject(0));
  state.interactions = CopyOf(this->Shooting->GetOutputDataObject(1));
  state.steps = now.step - this->Before.step;
  state.evaluations = now.work.Evaluations() - this->Before.work.Evaluations();
  state.rays = now.work.Rays() - this->Before.work.Rays();
  state.seconds = now.seconds - this->Before.seconds;
  return state;
}

const Solver& SolutionPipeline::GetSolver() const
{
  return *this->Shooting->GetSolver();
}

} // namespace vantage
