#include "vtkImportanceDrivenShooting.h"

#include "CameraAdapter.h"
#include "ErrorRecorder.h"
#include "SceneAdapter.h"
#include "TestScenes.h"
#include "core/Solver.h"

#include <vtkCallbackCommand.h>
#include <vtkCamera.h>
#include <vtkCellData.h>
#include <vtkDoubleArray.h>
#include <vtkExecutive.h>
#include <vtkFieldData.h>
#include <vtkInformation.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkSMPTools.h>
#include <vtkTable.h>
#include <vtkVariant.h>

#include <gtest/gtest.h>

#include <limits>
#include <sstream>

namespace vantage
{
namespace
{

constexpr vtkIdType Enough = 8; // patch steps, of which some carry radiance

/// A filter on the lit box that takes no time: patch steps on a fixed graph of interactions.
vtkSmartPointer<vtkImportanceDrivenShooting> MakeFilter()
{
  const auto filter = vtkSmartPointer<vtkImportanceDrivenShooting>::New();
  filter->SetInputData(SceneToPolyData(MakeLitBox()));
  filter->SetCameraName("door");
  filter->SetMethod("importance-shooting");
  filter->SetViewRays(1024);
  filter->SetMaximumLevel(1);
  filter->SetSteps(Enough);
  return filter;
}

vtkPolyData* ElementsOf(vtkImportanceDrivenShooting* filter)
{
  return filter->GetOutput(0);
}

vtkTable* HistoryOf(vtkImportanceDrivenShooting* filter)
{
  return vtkTable::SafeDownCast(filter->GetOutputDataObject(2));
}

double LastOf(vtkTable* history, const char* column)
{
  return history->GetValueByName(history->GetNumberOfRows() - 1, column).ToDouble();
}

std::vector<Color> CellColors(vtkPolyData* data, const char* name)
{
  vtkDataArray* array = data->GetCellData()->GetArray(name);
  std::vector<Color> colors(static_cast<std::size_t>(array->GetNumberOfTuples()));
  for (std::size_t k = 0; k < colors.size(); ++k)
  {
    array->GetTuple(static_cast<vtkIdType>(k), &colors[k].x);
  }
  return colors;
}

/// A copy of the input with other values in one cell array: each component times `factor`.
vtkSmartPointer<vtkPolyData> Scaled(vtkPolyData* input, const char* name, double factor)
{
  const auto copy = vtkSmartPointer<vtkPolyData>::New();
  copy->DeepCopy(input);
  vtkDataArray* array = copy->GetCellData()->GetArray(name);
  for (vtkIdType t = 0; t < array->GetNumberOfTuples(); ++t)
  {
    for (int c = 0; c < array->GetNumberOfComponents(); ++c)
    {
      array->SetComponent(t, c, factor * array->GetComponent(t, c));
    }
  }
  return copy;
}

TEST(ImportanceDrivenShooting, DefaultsAreThoseOfTheCore)
{
  vtkNew<vtkImportanceDrivenShooting> filter;
  const SolverSettings settings;
  const Budget budget;
  const Camera camera;
  EXPECT_EQ(filter->GetMethod(), NameOf(settings.method));
  EXPECT_EQ(filter->GetGranularity(), NameOf(settings.granularity));
  EXPECT_EQ(filter->GetRefinementOracle(), NameOf(settings.refinement.oracle));
  EXPECT_EQ(filter->GetFormFactorTolerance(), settings.refinement.formFactorTolerance);
  EXPECT_EQ(filter->GetPowerTolerance(), settings.refinement.powerTolerance);
  EXPECT_EQ(filter->GetShadowTolerance(), settings.refinement.shadowTolerance);
  EXPECT_EQ(filter->GetMinimumElementSize(), settings.refinement.minimumElementSize);
  EXPECT_EQ(filter->GetMaximumLevel(), settings.refinement.maximumLevel);
  EXPECT_STREQ(filter->GetAccuracy(), "default");
  EXPECT_EQ(filter->GetVisibilityRays(), settings.visibilityRays);
  EXPECT_EQ(filter->GetViewRays(), settings.viewRays);
  EXPECT_EQ(filter->GetInitialPhase(), settings.initialPhase);
  EXPECT_EQ(filter->GetImportance(), settings.importance);
  EXPECT_EQ(filter->GetSeed(), settings.seed);
  EXPECT_EQ(filter->GetError(), 0.01);
  EXPECT_EQ(filter->GetTimeLimit(), budget.seconds);
  EXPECT_EQ(filter->GetSteps(), VTK_ID_MAX);
  EXPECT_EQ(filter->GetViewAngle(), camera.fieldOfView);
  EXPECT_EQ(filter->GetAspect(), camera.aspect);
}

TEST(ImportanceDrivenShooting, TheOutputIsWhatTheCoreSolves)
{
  const auto filter = MakeFilter();
  filter->SetMethod("progressive-shooting");
  filter->SetGranularity("interaction");
  filter->SetRefinementOracle("F");
  filter->SetFormFactorTolerance(0.3);
  filter->SetVisibilityRays(8);
  filter->SetSeed(5);
  filter->Update();

  SolverSettings settings;
  settings.method = Method::ProgressiveShooting;
  settings.granularity = Granularity::Interaction;
  settings.refinement.oracle = RefinementOracle::F;
  settings.refinement.formFactorTolerance = 0.3;
  settings.refinement.maximumLevel = 1;
  settings.visibilityRays = 8;
  settings.viewRays = 1024;
  settings.seed = 5;
  Solver solver(MakeLitBox(), settings);
  solver.SetCamera(MakeLitBox().cameras[0]);
  Budget budget;
  budget.steps = Enough;
  solver.Run(budget);

  const ElementSolution elements = solver.Elements();
  EXPECT_EQ(CellColors(ElementsOf(filter), "Radiance"), elements.radiance);
  EXPECT_EQ(CellColors(ElementsOf(filter), "UnshotRadiance"), elements.unshotRadiance);
  EXPECT_EQ(
    filter->GetOutput(1)->GetNumberOfLines(), static_cast<vtkIdType>(solver.Interactions().size()));
  EXPECT_EQ(HistoryOf(filter)->GetNumberOfRows(), static_cast<vtkIdType>(solver.History().size()));
  EXPECT_EQ(LastOf(HistoryOf(filter), "ViewFlux"), solver.History().back().viewFlux);
  EXPECT_TRUE(ElementsOf(filter)->GetPointData()->HasArray("Radiance"));
  EXPECT_TRUE(ElementsOf(filter)->GetFieldData()->HasArray("CameraName"));
}

TEST(ImportanceDrivenShooting, RunsToTheErrorThatIsAskedFor)
{
  const auto filter = MakeFilter();
  filter->SetSteps(VTK_ID_MAX);
  filter->SetError(0.01);
  filter->Update();
  EXPECT_LE(LastOf(HistoryOf(filter), "ErrorEstimate"), 0.01);
  const vtkIdType rows = HistoryOf(filter)->GetNumberOfRows();
  EXPECT_GT(rows, 1);
  filter->SetError(0.001); // continues
  filter->Update();
  EXPECT_LE(LastOf(HistoryOf(filter), "ErrorEstimate"), 0.001);
  EXPECT_GT(HistoryOf(filter)->GetNumberOfRows(), rows);
}

TEST(ImportanceDrivenShooting, AnErrorThatCannotBeReachedEndsWithAWarning)
{
  const auto filter = MakeFilter();
  ErrorRecorder recorder(filter);
  filter->SetMethod("goal-oriented");
  filter->SetMaximumLevel(1);
  filter->SetSteps(VTK_ID_MAX);
  filter->SetError(0.001);
  filter->Update();
  EXPECT_GT(LastOf(HistoryOf(filter), "ErrorEstimate"), 0.001);
  EXPECT_NE(recorder.Take().find("MinimumElementSize"), std::string::npos);
}

TEST(ImportanceDrivenShooting, WithoutLightOrViewThereIsNothingToDo)
{
  for (const std::string& method : vantage::MethodNames())
  {
    SCOPED_TRACE(method);
    const auto filter = MakeFilter();
    ErrorRecorder recorder(filter);
    filter->SetMethod(method.c_str());
    const vtkSmartPointer<vtkPolyData> lit =
      vtkPolyData::SafeDownCast(filter->GetInputDataObject(0, 0));
    filter->SetInputData(Scaled(lit, "Emission", 0.0));
    filter->Update();
    EXPECT_NE(recorder.Take().find("nothing in it emits light"), std::string::npos);
    EXPECT_EQ(ElementsOf(filter)->GetCellData()->GetArray("Radiance")->GetRange(-1)[1], 0.0);
    filter->SetInputData(lit);
    filter->SetCameraName("");
    filter->SetEyePosition(10.0, 10.0, 10.0);
    filter->SetFocalPoint(20.0, 20.0, 20.0);
    filter->Update();
    EXPECT_NE(recorder.Take().find("it sees nothing"), std::string::npos);
  }
}

TEST(ImportanceDrivenShooting, GoalOrientedRunsToItsErrorAndContinues)
{
  const auto filter = MakeFilter();
  filter->SetMethod("goal-oriented");
  filter->SetMaximumLevel(10);
  filter->SetSteps(VTK_ID_MAX);
  filter->SetError(0.1);
  filter->Update();
  const vtkIdType rows = HistoryOf(filter)->GetNumberOfRows();
  EXPECT_LE(LastOf(HistoryOf(filter), "ErrorEstimate"), 0.1);
  EXPECT_GT(LastOf(HistoryOf(filter), "ClusterPairs"), 0);
  filter->SetError(0.01);
  filter->Update();
  EXPECT_LE(LastOf(HistoryOf(filter), "ErrorEstimate"), 0.01);
  EXPECT_GT(HistoryOf(filter)->GetNumberOfRows(), rows);
}

TEST(ImportanceDrivenShooting, MoreStepsContinue)
{
  const auto filter = MakeFilter();
  filter->Update();
  vtkNew<vtkTable> before;
  before->DeepCopy(HistoryOf(filter));
  filter->SetSteps(2 * Enough);
  filter->Update();
  vtkTable* after = HistoryOf(filter);
  ASSERT_EQ(before->GetNumberOfRows(), Enough);
  ASSERT_EQ(after->GetNumberOfRows(), 2 * Enough);
  for (vtkIdType row = 0; row < Enough; ++row)
  {
    for (vtkIdType column = 0; column < before->GetNumberOfColumns(); ++column)
    {
      // Seconds included: the rows have not been computed again.
      EXPECT_EQ(after->GetValue(row, column), before->GetValue(row, column));
    }
  }

  filter->SetSteps(Enough - 1); // starts anew
  filter->Update();
  EXPECT_EQ(HistoryOf(filter)->GetNumberOfRows(), Enough - 1);
  EXPECT_NE(HistoryOf(filter)->GetValueByName(0, "Seconds"), before->GetValueByName(0, "Seconds"));
}

TEST(ImportanceDrivenShooting, AMovedCameraKeepsInteractions)
{
  const auto filter = MakeFilter();
  vtkNew<vtkCamera> camera;
  CameraToVtk(MakeLitBox().cameras[0], camera);
  filter->SetCamera(camera);
  filter->SetAspect(1.25);
  filter->Update();
  const vtkIdType links = filter->GetOutput(1)->GetNumberOfLines();
  const double evaluations = LastOf(HistoryOf(filter), "Evaluations");
  const double flux = LastOf(HistoryOf(filter), "ViewFlux");
  ASSERT_GT(links, 0);

  camera->SetPosition(0.2, 0.1, 0.5); // its time stamp alone executes the filter again
  filter->Update();
  vtkTable* history = HistoryOf(filter);
  EXPECT_EQ(history->GetNumberOfRows(), 2 * Enough); // as many for the new view
  EXPECT_GE(filter->GetOutput(1)->GetNumberOfLines(), links);
  EXPECT_GE(history->GetValueByName(Enough, "Evaluations").ToDouble(), evaluations);
  EXPECT_NE(LastOf(history, "ViewFlux"), flux);

  const vtkMTimeType executed = filter->GetOutput(0)->GetMTime();
  camera->SetClippingRange(0.01, 50.0); // what renderers do: executes, but nothing is redone
  filter->Update();
  EXPECT_GT(filter->GetOutput(0)->GetMTime(), executed);
  EXPECT_EQ(HistoryOf(filter)->GetNumberOfRows(), 2 * Enough);
}

TEST(ImportanceDrivenShooting, OtherLightsKeepInteractions)
{
  const auto filter = MakeFilter();
  filter->Update();
  const double evaluations = LastOf(HistoryOf(filter), "Evaluations");
  const auto input = vtkSmartPointer<vtkPolyData>(vtkPolyData::SafeDownCast(filter->GetInput()));
  for (const char* name : { "Emission", "Albedo" })
  {
    SCOPED_TRACE(name);
    const vtkIdType rows = HistoryOf(filter)->GetNumberOfRows();
    filter->SetInputData(Scaled(input, name, 0.5));
    filter->Update();
    EXPECT_EQ(HistoryOf(filter)->GetNumberOfRows(), rows + Enough);
    EXPECT_GE(HistoryOf(filter)->GetValueByName(rows, "Evaluations").ToDouble(), evaluations);
  }
  const auto moved = Scaled(input, "Albedo", 1.0);
  moved->GetPoints()->SetPoint(0, -0.1, 0.0, 0.0);
  filter->SetInputData(moved);
  filter->Update();
  EXPECT_EQ(HistoryOf(filter)->GetNumberOfRows(), Enough); // another shape starts anew
}

TEST(ImportanceDrivenShooting, ArraysAreChosenByName)
{
  const auto filter = MakeFilter();
  filter->Update();
  const std::vector<Color> radiance = CellColors(ElementsOf(filter), "Radiance");
  const auto renamed = vtkSmartPointer<vtkPolyData>::New();
  renamed->DeepCopy(filter->GetInput());
  renamed->GetCellData()->GetArray("Albedo")->SetName("Reflectance");
  renamed->GetCellData()->GetArray("Emission")->SetName("Light");

  const auto other = MakeFilter();
  other->SetInputData(renamed);
  other->SetInputArrayToProcess(0, 0, 0, vtkDataObject::FIELD_ASSOCIATION_CELLS, "Reflectance");
  other->SetInputArrayToProcess(1, 0, 0, vtkDataObject::FIELD_ASSOCIATION_CELLS, "Light");
  other->Update();
  EXPECT_EQ(CellColors(ElementsOf(other), "Radiance"), radiance);
}

TEST(ImportanceDrivenShooting, ConstantsStandInForArraysThatAreMissing)
{
  const auto filter = MakeFilter();
  ErrorRecorder recorder(filter);
  vtkPolyData::SafeDownCast(filter->GetInput())->GetCellData()->Initialize();
  filter->Modified();
  filter->Update();
  EXPECT_NE(recorder.Take().find("nothing in it emits light"), std::string::npos);
  for (const Color& albedo : CellColors(ElementsOf(filter), "Albedo"))
  {
    EXPECT_EQ(albedo, Color(0.5));
  }
}

TEST(ImportanceDrivenShooting, OutputsOutliveTheFilter)
{
  auto filter = MakeFilter();
  filter->Update();
  const vtkSmartPointer<vtkPolyData> elements = filter->GetOutput(0);
  const vtkSmartPointer<vtkPolyData> links = filter->GetOutput(1);
  const vtkSmartPointer<vtkTable> history = HistoryOf(filter);
  const std::vector<Color> radiance = CellColors(elements, "Radiance");
  filter = nullptr;
  EXPECT_EQ(CellColors(elements, "Radiance"), radiance);
  EXPECT_GT(links->GetNumberOfLines(), 0);
  EXPECT_EQ(history->GetNumberOfRows(), Enough);
}

TEST(ImportanceDrivenShooting, ResultsOfEarlierExecutionsStayAsTheyWere)
{
  const auto filter = MakeFilter();
  filter->Update();
  vtkNew<vtkPolyData> kept;
  kept->ShallowCopy(filter->GetOutput(0));
  const std::vector<Color> radiance = CellColors(kept, "Radiance");
  filter->SetSteps(3 * Enough);
  filter->Update();
  EXPECT_EQ(CellColors(kept, "Radiance"), radiance);
  EXPECT_NE(CellColors(filter->GetOutput(0), "Radiance"), radiance);
}

TEST(ImportanceDrivenShooting, AbortKeepsWhatIsDoneAndTheNextExecutionContinues)
{
  const auto filter = MakeFilter();
  vtkNew<vtkCallbackCommand> abort;
  int calls = 0;
  abort->SetClientData(&calls);
  abort->SetCallback(
    [](vtkObject* caller, unsigned long, void* count, void*)
    {
      if (++*static_cast<int*>(count) == 3)
      {
        vtkAlgorithm::SafeDownCast(caller)->SetAbortExecute(1);
      }
    });
  const unsigned long tag = filter->AddObserver(vtkCommand::ProgressEvent, abort);
  filter->Update();
  EXPECT_EQ(HistoryOf(filter)->GetNumberOfRows(), 2); // the first call came before any step
  EXPECT_GT(ElementsOf(filter)->GetNumberOfCells(), 0);
  filter->RemoveObserver(tag);
  filter->Modified();
  filter->Update();
  EXPECT_EQ(HistoryOf(filter)->GetNumberOfRows(), Enough);

  const auto whole = MakeFilter();
  whole->Update();
  EXPECT_EQ(CellColors(ElementsOf(filter), "Radiance"), CellColors(ElementsOf(whole), "Radiance"));
}

TEST(ImportanceDrivenShooting, AnAbortIsNotFollowedByAGather)
{
  const auto filter = MakeFilter();
  filter->SetMethod("goal-oriented");
  filter->SetMaximumLevel(10);
  vtkNew<vtkCallbackCommand> abort;
  abort->SetCallback([](vtkObject* caller, unsigned long, void*, void*)
    { vtkAlgorithm::SafeDownCast(caller)->AbortExecuteOn(); });
  const unsigned long tag = filter->AddObserver(vtkCommand::ProgressEvent, abort);
  filter->Update();
  EXPECT_FALSE(ElementsOf(filter)->GetFieldData()->HasArray("ErrorEstimate"));
  filter->RemoveObserver(tag);
  filter->Modified();
  filter->Update();
  EXPECT_TRUE(ElementsOf(filter)->GetFieldData()->HasArray("ErrorEstimate"));
}

TEST(ImportanceDrivenShooting, ProgressRunsFromZeroToOne)
{
  const auto filter = MakeFilter();
  vtkNew<vtkCallbackCommand> observer;
  std::vector<double> progress;
  observer->SetClientData(&progress);
  observer->SetCallback([](vtkObject*, unsigned long, void* list, void* value)
    { static_cast<std::vector<double>*>(list)->push_back(*static_cast<double*>(value)); });
  filter->AddObserver(vtkCommand::ProgressEvent, observer);
  filter->Update();
  ASSERT_GE(progress.size(), static_cast<std::size_t>(Enough));
  for (std::size_t k = 0; k < progress.size(); ++k)
  {
    EXPECT_GE(progress[k], k == 0 ? 0.0 : progress[k - 1]);
    EXPECT_LE(progress[k], 1.0);
  }
  EXPECT_EQ(progress.back(), 1.0);
}

TEST(ImportanceDrivenShooting, TheNumberOfThreadsDoesNotMatter)
{
  const auto many = MakeFilter();
  many->Update();
  const auto one = MakeFilter();
  vtkSMPTools::Initialize(1);
  one->Update();
  vtkSMPTools::Initialize(0);
  EXPECT_EQ(CellColors(ElementsOf(one), "Radiance"), CellColors(ElementsOf(many), "Radiance"));
}

using Mistake = std::pair<const char*, void (*)(vtkImportanceDrivenShooting*)>;

TEST(ImportanceDrivenShooting, EveryMistakeIsAnErrorThatNamesIt)
{
  constexpr double NaN = std::numeric_limits<double>::quiet_NaN();
  using Filter = vtkImportanceDrivenShooting;
  const Mistake mistakes[] = {
    { "unknown method 'radiosity'", [](Filter* f) { f->SetMethod("radiosity"); } },
    { "unknown granularity 'photon'", [](Filter* f) { f->SetGranularity("photon"); } },
    { "'BFA'", [](Filter* f) { f->SetRefinementOracle("BFA"); } },
    { "unknown accuracy 'best'", [](Filter* f) { f->SetAccuracy("best"); } },
    { "unknown camera 'window'", [](Filter* f) { f->SetCameraName("window"); } },
    { "Steps is -1", [](Filter* f) { f->SetSteps(-1); } },
    { "error", [](Filter* f) { f->SetError(-0.1); } },
    { "error", [](Filter* f) { f->SetError(NaN); } },
    { "seconds", [](Filter* f) { f->SetTimeLimit(0.0); } },
    { "formFactorTolerance", [](Filter* f) { f->SetFormFactorTolerance(0.0); } },
    { "powerTolerance", [](Filter* f) { f->SetPowerTolerance(NaN); } },
    { "shadowTolerance", [](Filter* f) { f->SetShadowTolerance(-1.0); } },
    { "minimumElementSize", [](Filter* f) { f->SetMinimumElementSize(0.0); } },
    { "maximumLevel", [](Filter* f) { f->SetMaximumLevel(-1); } },
    { "visibilityRays", [](Filter* f) { f->SetVisibilityRays(0); } },
    { "viewRays", [](Filter* f) { f->SetViewRays(0); } },
    { "field of view",
      [](Filter* f)
      {
        f->SetCameraName("");
        f->SetViewAngle(180.0);
      } },
    { "aspect",
      [](Filter* f)
      {
        f->SetCameraName("");
        f->SetAspect(NaN);
      } },
    { "no array of numbers Colour", [](Filter* f)
      { f->SetInputArrayToProcess(0, 0, 0, vtkDataObject::FIELD_ASSOCIATION_CELLS, "Colour"); } },
    { "albedo", [](Filter* f)
      { f->SetInputData(Scaled(vtkPolyData::SafeDownCast(f->GetInput()), "Albedo", 3.0)); } },
    { "no polygons",
      [](Filter* f)
      {
        f->SetCameraName("");
        f->SetInputData(vtkNew<vtkPolyData>());
      } },
  };
  for (const auto& [message, makeMistake] : mistakes)
  {
    SCOPED_TRACE(message);
    const auto filter = MakeFilter();
    ErrorRecorder recorder(filter);
    ErrorRecorder executive(filter->GetExecutive());
    makeMistake(filter);
    filter->Update();
    const std::string text = recorder.Take();
    EXPECT_NE(text.find(message), std::string::npos) << text;
    EXPECT_EQ(filter->GetOutput(0)->GetNumberOfCells(), 0);
  }
}

TEST(ImportanceDrivenShooting, AMistakeDoesNotCostTheSolution)
{
  const auto filter = MakeFilter();
  ErrorRecorder recorder(filter);
  ErrorRecorder executive(filter->GetExecutive());
  filter->Update();
  const vtkVariant seconds = HistoryOf(filter)->GetValueByName(0, "Seconds");
  filter->SetMethod("radiosity");
  filter->Update();
  EXPECT_NE(recorder.Take(), "");
  filter->SetMethod("importance-shooting");
  filter->Update();
  EXPECT_EQ(recorder.Take(), "");
  ASSERT_EQ(HistoryOf(filter)->GetNumberOfRows(), Enough);
  EXPECT_EQ(HistoryOf(filter)->GetValueByName(0, "Seconds"), seconds);
}

TEST(ImportanceDrivenShooting, PrintSelfNamesEveryParameter)
{
  const auto filter = MakeFilter();
  vtkNew<vtkCamera> camera;
  filter->SetCamera(camera);
  std::ostringstream text;
  filter->Print(text);
  for (const char* name : { "Camera:", "CameraName: door", "EyePosition:", "FocalPoint:", "ViewUp:",
         "ViewAngle:", "Aspect:", "Method: importance-shooting", "Granularity: patch", "Steps: 8",
         "Error:", "TimeLimit:", "RefinementOracle: BF", "FormFactorTolerance:", "PowerTolerance:",
         "ShadowTolerance:", "MinimumElementSize:", "MaximumLevel: 1", "Accuracy: default",
         "VisibilityRays:", "ViewRays: 1024", "InitialPhase: on", "Importance: on",
         "GatherPoints: on", "Seed: 1" })
  {
    EXPECT_NE(text.str().find(name), std::string::npos) << name;
  }
}

} // namespace
} // namespace vantage
