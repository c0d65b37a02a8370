#include "CameraAdapter.h"

#include "core/Error.h"

#include <vtkCamera.h>
#include <vtkDoubleArray.h>
#include <vtkFieldData.h>
#include <vtkNew.h>

#include <gtest/gtest.h>

#include <cmath>

namespace vantage
{
namespace
{

Camera MakeCamera(const std::string& name, double shift)
{
  Camera camera;
  camera.name = name;
  camera.eye = Vec3(0.1 + shift, 1.0 / 3.0, 2.0);
  camera.lookAt = Vec3(1e-17, 7.0, -2.0 + shift);
  camera.up = Vec3(0.0, 0.6, 0.8);
  camera.fieldOfView = 33.3;
  camera.aspect = 16.0 / 9.0;
  return camera;
}

void ExpectEqual(const Camera& a, const Camera& b)
{
  EXPECT_EQ(a.name, b.name);
  EXPECT_EQ(a.eye, b.eye);
  EXPECT_EQ(a.lookAt, b.lookAt);
  EXPECT_EQ(a.up, b.up);
  EXPECT_EQ(a.fieldOfView, b.fieldOfView);
  EXPECT_EQ(a.aspect, b.aspect);
}

TEST(CameraAdapter, FieldDataGiveTheCamerasBack)
{
  const std::vector<Camera> cameras{ MakeCamera("view1", 0.0), MakeCamera("", 0.5) };
  vtkNew<vtkFieldData> fieldData;
  CamerasToFieldData(cameras, fieldData);
  const std::vector<Camera> read = CamerasFromFieldData(fieldData);
  ASSERT_EQ(read.size(), 2u);
  ExpectEqual(read[0], cameras[0]);
  ExpectEqual(read[1], cameras[1]);
}

TEST(CameraAdapter, AnEmptyListRemovesWhatWasThere)
{
  vtkNew<vtkFieldData> fieldData;
  CamerasToFieldData({ MakeCamera("view1", 0.0) }, fieldData);
  EXPECT_EQ(fieldData->GetNumberOfArrays(), 6);
  CamerasToFieldData({}, fieldData);
  EXPECT_EQ(fieldData->GetNumberOfArrays(), 0);
  EXPECT_TRUE(CamerasFromFieldData(fieldData).empty());
}

TEST(CameraAdapter, IncompleteFieldDataAreAnError)
{
  for (const char* name :
    { "CameraEye", "CameraLookAt", "CameraUp", "CameraFieldOfView", "CameraAspect" })
  {
    SCOPED_TRACE(name);
    vtkNew<vtkFieldData> fieldData;
    CamerasToFieldData({ MakeCamera("view1", 0.0), MakeCamera("view2", 1.0) }, fieldData);
    vtkNew<vtkDoubleArray> tooShort;
    tooShort->SetName(name);
    tooShort->SetNumberOfComponents(fieldData->GetArray(name)->GetNumberOfComponents());
    tooShort->SetNumberOfTuples(1);
    fieldData->AddArray(tooShort);
    EXPECT_THROW(CamerasFromFieldData(fieldData), InputError);
    fieldData->RemoveArray(name);
    EXPECT_THROW(CamerasFromFieldData(fieldData), InputError);
  }
}

TEST(CameraAdapter, VtkCameraSeesTheSame)
{
  const Camera camera = MakeCamera("", 0.25);
  vtkNew<vtkCamera> vtk;
  vtk->ParallelProjectionOn(); // to be switched off again
  CameraToVtk(camera, vtk);
  ExpectEqual(CameraFromVtk(vtk, camera.aspect), camera);
}

TEST(CameraAdapter, HorizontalViewAngleBecomesVertical)
{
  vtkNew<vtkCamera> vtk;
  vtk->UseHorizontalViewAngleOn();
  vtk->SetViewAngle(90.0);
  // Half the width is tan 45 deg = 1 at distance 1, so half the height is 1 / aspect.
  const Camera camera = CameraFromVtk(vtk, 2.0);
  EXPECT_NEAR(std::tan(camera.fieldOfView * Pi / 360.0), 0.5, 1e-15); // round-off
  EXPECT_EQ(camera.aspect, 2.0);
}

TEST(CameraAdapter, ParallelProjectionIsAnError)
{
  vtkNew<vtkCamera> vtk;
  vtk->ParallelProjectionOn();
  EXPECT_THROW(CameraFromVtk(vtk, 1.0), InputError);
}

} // namespace
} // namespace vantage
