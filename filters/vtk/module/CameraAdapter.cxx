#include "CameraAdapter.h"

#include "ArrayAdapter.h"
#include "core/Error.h"

#include <vtkCamera.h>
#include <vtkFieldData.h>
#include <vtkStringArray.h>

#include <cmath>
#include <string>

namespace vantage
{

namespace
{

vtkDataArray* RequireArray(
  vtkFieldData* fieldData, const char* name, vtkIdType cameras, int components)
{
  vtkDataArray* array = fieldData->GetArray(name);
  if (!array || array->GetNumberOfTuples() != cameras ||
      array->GetNumberOfComponents() != components)
  {
    throw InputError("field data: CameraName lists " + std::to_string(cameras) + " cameras, so " +
                     name + " must be numbers with as many tuples of " +
                     std::to_string(components) + "; mend it or remove CameraName");
  }
  return array;
}

Vec3 TupleOf(vtkDataArray* array, vtkIdType k)
{
  Vec3 value;
  array->GetTuple(k, &value.x);
  return value;
}

} // namespace

void CamerasToFieldData(const std::vector<Camera>& cameras, vtkFieldData* fieldData)
{
  for (const char* name :
    { "CameraName", "CameraEye", "CameraLookAt", "CameraUp", "CameraFieldOfView", "CameraAspect" })
  {
    fieldData->RemoveArray(name);
  }
  if (cameras.empty())
  {
    return;
  }
  vtkNew<vtkStringArray> names;
  names->SetName("CameraName");
  std::vector<Vec3> eyes, targets, ups;
  for (const Camera& camera : cameras)
  {
    names->InsertNextValue(camera.name);
    eyes.push_back(camera.eye);
    targets.push_back(camera.lookAt);
    ups.push_back(camera.up);
  }
  fieldData->AddArray(names);
  fieldData->AddArray(ColorsToArray("CameraEye", eyes));
  fieldData->AddArray(ColorsToArray("CameraLookAt", targets));
  fieldData->AddArray(ColorsToArray("CameraUp", ups));
  fieldData->AddArray(MakeArray<vtkDoubleArray>(
    "CameraFieldOfView", cameras.size(), [&](std::size_t k) { return cameras[k].fieldOfView; }));
  fieldData->AddArray(MakeArray<vtkDoubleArray>(
    "CameraAspect", cameras.size(), [&](std::size_t k) { return cameras[k].aspect; }));
}

std::vector<Camera> CamerasFromFieldData(vtkFieldData* fieldData)
{
  auto* names = vtkStringArray::SafeDownCast(fieldData->GetAbstractArray("CameraName"));
  if (!names)
  {
    return {};
  }
  const vtkIdType count = names->GetNumberOfValues();
  vtkDataArray* eyes = RequireArray(fieldData, "CameraEye", count, 3);
  vtkDataArray* targets = RequireArray(fieldData, "CameraLookAt", count, 3);
  vtkDataArray* ups = RequireArray(fieldData, "CameraUp", count, 3);
  vtkDataArray* fields = RequireArray(fieldData, "CameraFieldOfView", count, 1);
  vtkDataArray* aspects = RequireArray(fieldData, "CameraAspect", count, 1);
  std::vector<Camera> cameras(static_cast<std::size_t>(count));
  for (vtkIdType k = 0; k < count; ++k)
  {
    Camera& camera = cameras[static_cast<std::size_t>(k)];
    camera.name = names->GetValue(k);
    camera.eye = TupleOf(eyes, k);
    camera.lookAt = TupleOf(targets, k);
    camera.up = TupleOf(ups, k);
    camera.fieldOfView = fields->GetTuple1(k);
    camera.aspect = aspects->GetTuple1(k);
  }
  return cameras;
}

Camera CameraFromVtk(vtkCamera* source, double aspect)
{
  if (source->GetParallelProjection() != 0)
  {
    throw InputError("camera: a parallel projection has no eye that importance could leave from; "
                     "call ParallelProjectionOff()");
  }
  Camera camera;
  source->GetPosition(&camera.eye.x);
  source->GetFocalPoint(&camera.lookAt.x);
  source->GetViewUp(&camera.up.x);
  camera.fieldOfView = source->GetViewAngle();
  if (source->GetUseHorizontalViewAngle() != 0)
  {
    const double halfHeight = std::tan(camera.fieldOfView * Pi / 360.0) / aspect;
    camera.fieldOfView = std::atan(halfHeight) * 360.0 / Pi;
  }
  camera.aspect = aspect;
  return camera;
}

void CameraToVtk(const Camera& camera, vtkCamera* target)
{
  target->SetPosition(&camera.eye.x);
  target->SetFocalPoint(&camera.lookAt.x);
  target->SetViewUp(&camera.up.x);
  target->ParallelProjectionOff();
  target->UseHorizontalViewAngleOff();
  target->SetViewAngle(camera.fieldOfView);
}

} // namespace vantage
