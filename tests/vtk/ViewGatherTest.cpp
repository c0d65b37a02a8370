#include "vtkViewGather.h"

#include "ErrorRecorder.h"
#include "SceneAdapter.h"
#include "TestScenes.h"
#include "core/Solver.h"
#include "vtkImportanceDrivenShooting.h"
#include "vtkRadianceToneMapping.h"
#include "vtkTransportSolution.h"

#include <vtkCallbackCommand.h>
#include <vtkCamera.h>
#include <vtkCell.h>
#include <vtkDataArray.h>
#include <vtkExecutive.h>
#include <vtkFieldData.h>
#include <vtkIdTypeArray.h>
#include <vtkImageData.h>
#include <vtkImageShrink3D.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkSMPTools.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <limits>
#include <sstream>

namespace vantage
{
namespace
{

constexpr int Width = 30;
constexpr int Height = 24; // the aspect ratio of the scene's camera

vtkSmartPointer<vtkImportanceDrivenShooting> MakeShooting()
{
  const auto shooting = vtkSmartPointer<vtkImportanceDrivenShooting>::New();
  shooting->SetInputData(SceneToPolyData(MakeLitBox()));
  shooting->SetCameraName("door");
  shooting->SetViewRays(1024);
  shooting->SetError(0.1);
  return shooting;
}

vtkSmartPointer<vtkViewGather> MakeGather(vtkImportanceDrivenShooting* shooting)
{
  const auto gather = vtkSmartPointer<vtkViewGather>::New();
  if (shooting)
  {
    gather->SetInputConnection(shooting->GetOutputPort(3));
  }
  gather->SetWidth(Width);
  gather->SetHeight(Height);
  gather->SetError(0.1);
  return gather;
}

std::vector<float> RadianceOf(vtkViewGather* gather)
{
  gather->Update();
  vtkDataArray* array = gather->GetOutput()->GetPointData()->GetArray("Radiance");
  std::vector<float> values;
  for (vtkIdType k = 0; array && k < array->GetNumberOfTuples(); ++k)
  {
    for (int c = 0; c < 3; ++c)
    {
      values.push_back(static_cast<float>(array->GetComponent(k, c)));
    }
  }
  return values;
}

TEST(ViewGather, DefaultsAreThoseOfTheCore)
{
  const vtkNew<vtkViewGather> gather;
  const GatherSettings settings;
  EXPECT_EQ(gather->GetWidth(), settings.width);
  EXPECT_EQ(gather->GetHeight(), settings.height);
  EXPECT_EQ(gather->GetError(), settings.error);
  EXPECT_EQ(gather->GetPixelCentres(), settings.pixelCentres);
  EXPECT_EQ(gather->GetSeed(), settings.seed);
}

TEST(ViewGather, ThePictureIsWhatTheCoreGathers)
{
  const auto shooting = MakeShooting();
  const auto gather = MakeGather(shooting);
  gather->SetSeed(3);
  const std::vector<float> found = RadianceOf(gather);
  int dimensions[3];
  gather->GetOutput()->GetDimensions(dimensions);
  EXPECT_EQ(dimensions[0], Width);
  EXPECT_EQ(dimensions[1], Height);
  EXPECT_EQ(dimensions[2], 1);

  GatherSettings settings;
  settings.width = Width;
  settings.height = Height;
  settings.error = 0.1;
  settings.seed = 3;
  Camera camera = MakeLitBox().FindCamera("door");
  camera.aspect = static_cast<double>(Width) / Height;
  const GatheredView view = shooting->GetSolver()->Gather(camera, settings);
  ASSERT_EQ(found.size(), 3 * view.radiance.pixels.size());
  for (std::size_t k = 0; k < view.radiance.pixels.size(); ++k)
  {
    for (int c = 0; c < 3; ++c)
    {
      ASSERT_EQ(found[3 * k + c], static_cast<float>(view.radiance.pixels[k][c])) << k;
    }
  }
  vtkDataArray* irradiance = gather->GetOutput()->GetPointData()->GetArray("Irradiance");
  ASSERT_NE(irradiance, nullptr);
  EXPECT_EQ(irradiance->GetComponent(100, 2), static_cast<float>(view.irradiance.pixels[100].z));
  vtkDataArray* error = gather->GetOutput()->GetFieldData()->GetArray("ErrorEstimate");
  ASSERT_NE(error, nullptr);
  const double solved = shooting->GetSolver()->History().back().errorEstimate;
  EXPECT_DOUBLE_EQ(error->GetTuple1(0), std::hypot(solved, view.report.errorEstimate));
  vtkDataArray* ofGather = gather->GetOutput()->GetFieldData()->GetArray("GatherErrorEstimate");
  ASSERT_NE(ofGather, nullptr);
  EXPECT_EQ(ofGather->GetTuple1(0), view.report.errorEstimate);
}

/// The messages of one more picture, and whether it says how good it is as a whole.
std::pair<std::string, bool> WarningsAndEstimateOf(vtkViewGather* gather)
{
  ErrorRecorder recorder(gather);
  gather->Update();
  vtkFieldData* fields = gather->GetOutput()->GetFieldData();
  EXPECT_TRUE(fields->HasArray("GatherErrorEstimate"));
  return { recorder.Take(), fields->HasArray("ErrorEstimate") != 0 };
}

TEST(ViewGather, AnErrorThatNobodyKnowsIsNotStated)
{
  const auto shooting = MakeShooting();
  const auto gather = MakeGather(shooting);
  EXPECT_EQ(WarningsAndEstimateOf(gather), std::make_pair(std::string(), true));
  gather->SetHeight(Height + 6); // narrower: part of the view
  EXPECT_EQ(WarningsAndEstimateOf(gather), std::make_pair(std::string(), false));
  gather->SetHeight(Height - 6);
  const auto [warning, isEstimated] = WarningsAndEstimateOf(gather);
  EXPECT_NE(warning.find("wider than what was solved for; give Aspect 1.66"), std::string::npos)
    << warning;
  EXPECT_FALSE(isEstimated);
  gather->SetHeight(Height);
  const vtkNew<vtkCamera> other;
  other->SetPosition(0.5, 0.5, 0.5);
  other->SetFocalPoint(0.5, 0.9, 0.5);
  other->SetViewUp(0.0, 0.0, 1.0);
  gather->SetCamera(other);
  EXPECT_EQ(WarningsAndEstimateOf(gather), std::make_pair(std::string(), false));

  shooting->SetMethod("importance-shooting"); // its estimate is of what is unshot
  gather->SetCamera(nullptr);
  EXPECT_EQ(WarningsAndEstimateOf(gather), std::make_pair(std::string(), false));
}

TEST(ViewGather, ItsProgressIsReportedAndItCanBeAborted)
{
  const auto shooting = MakeShooting();
  const auto gather = MakeGather(shooting);
  struct Watch
  {
    std::vector<double> progress;
    double abortAt = 2.0;
  } watch;
  const vtkNew<vtkCallbackCommand> observer;
  observer->SetClientData(&watch);
  observer->SetCallback(
    [](vtkObject* filter, unsigned long, void* data, void* value)
    {
      auto* seen = static_cast<Watch*>(data);
      seen->progress.push_back(*static_cast<double*>(value));
      if (seen->progress.back() >= seen->abortAt)
      {
        vtkAlgorithm::SafeDownCast(filter)->AbortExecuteOn();
      }
    });
  gather->AddObserver(vtkCommand::ProgressEvent, observer);
  const std::vector<float> whole = RadianceOf(gather);
  EXPECT_FALSE(whole.empty());
  EXPECT_GE(watch.progress.size(), 3u);
  EXPECT_TRUE(std::is_sorted(watch.progress.begin(), watch.progress.end()));
  EXPECT_EQ(watch.progress.back(), 1.0);
  watch.abortAt = 0.3;
  gather->Modified();
  EXPECT_TRUE(RadianceOf(gather).empty());
  watch.abortAt = 2.0;
  gather->AbortExecuteOff();
  gather->Modified();
  EXPECT_EQ(RadianceOf(gather), whole);
}

TEST(ViewGather, FiltersOfImagesTakeThePicture)
{
  const auto shooting = MakeShooting();
  const auto gather = MakeGather(shooting);
  const vtkNew<vtkImageShrink3D> shrink;
  shrink->SetInputConnection(gather->GetOutputPort());
  shrink->SetShrinkFactors(2, 2, 1);
  const ErrorRecorder recorder(shrink->GetExecutive());
  shrink->Update();
  vtkImageData* small = shrink->GetOutput();
  EXPECT_EQ(small->GetDimensions()[0], Width / 2);
  EXPECT_EQ(small->GetScalarType(), VTK_FLOAT);
  ASSERT_EQ(small->GetNumberOfScalarComponents(), 3);
  vtkImageData* picture = gather->GetOutput();
  double mean = 0.0;
  for (const auto& [x, y] : { std::pair(0, 0), std::pair(1, 0), std::pair(0, 1), std::pair(1, 1) })
  {
    mean += 0.25 * picture->GetScalarComponentAsDouble(2 + x, 4 + y, 0, 1);
  }
  EXPECT_NEAR(small->GetScalarComponentAsDouble(1, 2, 0, 1), mean, 1e-6 * mean); // floats
  EXPECT_EQ(small->GetSpacing()[0], 2.0);

  const vtkNew<vtkRadianceToneMapping> mapping;
  mapping->SetInputConnection(gather->GetOutputPort());
  shrink->SetInputConnection(mapping->GetOutputPort());
  shrink->Update();
  EXPECT_EQ(shrink->GetOutput()->GetScalarType(), VTK_UNSIGNED_CHAR);
  EXPECT_EQ(shrink->GetOutput()->GetNumberOfScalarComponents(), 3);
  EXPECT_GT(shrink->GetOutput()->GetScalarComponentAsDouble(1, 2, 0, 0), 0.0);
}

TEST(ViewGather, ElementIdsAndDepthsAreOfTheCellThatAPixelSees)
{
  const auto shooting = MakeShooting();
  const auto gather = MakeGather(shooting);
  gather->Update();
  vtkPolyData* elements = shooting->GetOutput();
  vtkPointData* pixels = gather->GetOutput()->GetPointData();
  Camera camera = MakeLitBox().FindCamera("door");
  camera.aspect = static_cast<double>(Width) / Height;
  const ImagePlane plane(camera);
  int named = 0;
  for (int y = 0; y < Height; ++y)
  {
    for (int x = 0; x < Width; ++x)
    {
      const vtkIdType pixel = y * Width + x;
      const auto cell = static_cast<vtkIdType>(pixels->GetArray("ElementId")->GetTuple1(pixel));
      if (cell < 0)
      {
        continue;
      }
      ++named;
      const Vec3 direction =
        glm::normalize(plane.Direction((2 * x + 1.0) / Width - 1.0, (2 * y + 1.0) / Height - 1.0));
      Vec3 point = plane.eye + pixels->GetArray("Depth")->GetTuple1(pixel) * direction;
      double closest[3], local[3], squared = 0.0, weights[16];
      int subId = 0;
      elements->GetCell(cell)->EvaluatePosition(&point.x, closest, subId, local, squared, weights);
      EXPECT_LT(squared, 1e-10) << "pixel " << pixel; // depths are single precision
    }
  }
  EXPECT_GT(named, Width * Height / 2);
}

TEST(ViewGather, NothingIsSeenWhereNothingIs)
{
  const auto shooting = MakeShooting();
  const auto gather = MakeGather(shooting);
  const vtkNew<vtkCamera> away;
  away->SetPosition(100.0, 0.0, 0.0);
  away->SetFocalPoint(200.0, 0.0, 0.0);
  away->SetViewUp(0.0, 0.0, 1.0);
  gather->SetCamera(away);
  gather->Update();
  vtkPointData* pixels = gather->GetOutput()->GetPointData();
  EXPECT_EQ(pixels->GetArray("ElementId")->GetRange()[1], -1.0);
  EXPECT_EQ(pixels->GetArray("Depth")->GetTuple1(0), std::numeric_limits<double>::infinity());
  EXPECT_EQ(pixels->GetArray("Radiance")->GetRange(0)[1], 0.0);
}

TEST(ViewGather, TheCameraIsTheOneThatIsAskedFor)
{
  const auto shooting = MakeShooting();
  const auto gather = MakeGather(shooting);
  const std::vector<float> own = RadianceOf(gather);
  gather->SetCameraName("door");
  EXPECT_EQ(RadianceOf(gather), own);
  const vtkNew<vtkCamera> camera;
  const Camera door = MakeLitBox().FindCamera("door");
  camera->SetPosition(&door.eye.x);
  camera->SetFocalPoint(&door.lookAt.x);
  camera->SetViewUp(&door.up.x);
  camera->SetViewAngle(door.fieldOfView);
  gather->SetCamera(camera);
  EXPECT_EQ(RadianceOf(gather), own);
  camera->SetViewAngle(0.5 * door.fieldOfView); // executes again
  EXPECT_NE(RadianceOf(gather), own);
}

TEST(ViewGather, ACopyOutlivesItsSource)
{
  auto shooting = MakeShooting();
  const std::vector<float> expected = RadianceOf(MakeGather(shooting));
  const vtkNew<vtkTransportSolution> shallow, deep;
  shallow->ShallowCopy(shooting->GetOutputDataObject(3));
  deep->DeepCopy(shooting->GetOutputDataObject(3));
  EXPECT_GT(deep->GetActualMemorySize(), 0u);

  // Another execution puts another solution into the pipeline and leaves the copies alone.
  shooting->SetInputData(
    []
    {
      Scene scene = MakeLitBox();
      for (Material& material : scene.materials)
      {
        material.emission *= 2.0;
      }
      return SceneToPolyData(scene);
    }());
  EXPECT_NE(RadianceOf(MakeGather(shooting)), expected);
  const auto pictureOf = [](vtkTransportSolution* solution)
  {
    const auto gather = MakeGather(nullptr);
    gather->SetInputDataObject(solution);
    return RadianceOf(gather);
  };
  EXPECT_EQ(pictureOf(shallow), expected);
  shooting = nullptr;
  EXPECT_EQ(pictureOf(deep), expected);
  EXPECT_EQ(pictureOf(shallow), expected);

  shallow->Initialize();
  EXPECT_FALSE(shallow->HasSolution());
  EXPECT_EQ(pictureOf(deep), expected);
}

TEST(ViewGather, TheNumberOfThreadsChangesNothing)
{
  const auto pictureWith = [](int threads)
  {
    vtkSMPTools::Initialize(threads);
    return RadianceOf(MakeGather(MakeShooting()));
  };
  const std::vector<float> expected = pictureWith(1);
  EXPECT_EQ(pictureWith(2), expected);
  EXPECT_EQ(pictureWith(4), expected);
  vtkSMPTools::Initialize(0);
}

TEST(ViewGather, EveryMistakeIsAnErrorThatNamesIt)
{
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const std::vector<std::pair<std::string, std::function<void(vtkViewGather*)>>> mistakes{
    { "width is 0", [](vtkViewGather* g) { g->SetWidth(0); } },
    { "height is 40000", [](vtkViewGather* g) { g->SetHeight(40000); } },
    { "error is 0", [](vtkViewGather* g) { g->SetError(0.0); } },
    { "error is nan", [nan](vtkViewGather* g) { g->SetError(nan); } },
    { "window", [](vtkViewGather* g) { g->SetCameraName("window"); } },
    { "nothing was solved", [](vtkViewGather* g)
      { g->SetInputDataObject(vtkSmartPointer<vtkTransportSolution>::New()); } },
  };
  for (const auto& [message, makeMistake] : mistakes)
  {
    SCOPED_TRACE(message);
    const auto gather = MakeGather(MakeShooting());
    gather->Update(); // of a good picture nothing is left
    ErrorRecorder recorder(gather);
    const ErrorRecorder executive(gather->GetExecutive());
    makeMistake(gather);
    gather->Update();
    const std::string text = recorder.Take();
    EXPECT_NE(text.find(message), std::string::npos) << text;
    EXPECT_EQ(gather->GetOutput()->GetPointData()->GetNumberOfArrays(), 0);
  }
}

TEST(ViewGather, PrintSelfNamesEveryParameter)
{
  const auto shooting = MakeShooting();
  const auto gather = MakeGather(shooting);
  gather->Update();
  std::ostringstream text;
  gather->Print(text);
  for (const char* name : { "Camera: (none)", "CameraName:", "Width: 30", "Height: 24",
         "Error: 0.1", "PixelCentres: off", "Seed: 1" })
  {
    EXPECT_NE(text.str().find(name), std::string::npos) << name;
  }
  std::ostringstream solution;
  shooting->GetOutputDataObject(3)->Print(solution);
  for (const char* name : { "Elements:", "ErrorEstimate:", "CameraName: door", "ViewAngle:" })
  {
    EXPECT_NE(solution.str().find(name), std::string::npos) << name;
  }
}

} // namespace
} // namespace vantage
