#include "plates/ElementPicture.h"

#include "CameraAdapter.h"
#include "vtkRadianceToneMapping.h"

#include <algorithm>
#include <limits>
#include <set>
#include <vtkActor.h>
#include <vtkCamera.h>
#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkDoubleArray.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkPolyDataMapper.h>
#include <vtkProperty.h>
#include <vtkRenderer.h>

namespace vantage
{

namespace
{

std::size_t PatchOfElement(vtkPolyData* elements, vtkIdType element)
{
  return static_cast<std::size_t>(
    elements->GetCellData()->GetArray("PatchId")->GetComponent(element, 0));
}

bool IsPositive(vtkDataArray* colors, vtkIdType tuple)
{
  return colors->GetComponent(tuple, 0) > 0.0 || colors->GetComponent(tuple, 1) > 0.0 ||
         colors->GetComponent(tuple, 2) > 0.0;
}

/// Corners of the elements that are shown, some of them several times.
std::vector<Vec3> PointsOf(vtkPolyData* elements, const std::vector<bool>& shown)
{
  std::vector<Vec3> points;
  for (vtkIdType element = 0; element < elements->GetNumberOfCells(); ++element)
  {
    if (shown[PatchOfElement(elements, element)])
    {
      vtkIdType count = 0;
      const vtkIdType* corners = nullptr;
      elements->GetCellPoints(element, count, corners);
      for (vtkIdType corner = 0; corner < count; ++corner)
      {
        const double* p = elements->GetPoint(corners[corner]);
        points.emplace_back(p[0], p[1], p[2]);
      }
    }
  }
  return points;
}

/// Each polygon as triangles around the mean of its corners. A graphics card interpolates inside
/// triangles only: on a quadrilateral cut along a diagonal the cut would show, and an element with
/// a finer neighbour has more than four corners.
vtkSmartPointer<vtkPolyData> FanElements(vtkPolyData* elements, const std::vector<bool>& shown)
{
  vtkDataArray* radiance = elements->GetPointData()->GetArray("Radiance");
  vtkNew<vtkPoints> points;
  points->DeepCopy(elements->GetPoints());
  vtkNew<vtkDoubleArray> colors;
  colors->DeepCopy(radiance);
  colors->SetName("Radiance");
  vtkNew<vtkCellArray> triangles;
  vtkCellArray* polygons = elements->GetPolys();
  for (vtkIdType element = 0; element < polygons->GetNumberOfCells(); ++element)
  {
    if (!shown[PatchOfElement(elements, element)])
    {
      continue;
    }
    vtkIdType count = 0;
    const vtkIdType* corners = nullptr;
    polygons->GetCellAtId(element, count, corners);
    double centre[3] = {};
    double color[3] = {};
    for (vtkIdType corner = 0; corner < count; ++corner)
    {
      for (int k = 0; k < 3; ++k)
      {
        centre[k] += elements->GetPoint(corners[corner])[k] / static_cast<double>(count);
        color[k] += radiance->GetComponent(corners[corner], k) / static_cast<double>(count);
      }
    }
    const vtkIdType middle = points->InsertNextPoint(centre);
    colors->InsertNextTuple(color);
    for (vtkIdType corner = 0; corner < count; ++corner)
    {
      triangles->InsertNextCell({ middle, corners[corner], corners[(corner + 1) % count] });
    }
  }
  const auto fans = vtkSmartPointer<vtkPolyData>::New();
  fans->SetPoints(points);
  fans->SetPolys(triangles);
  fans->GetPointData()->AddArray(colors);
  return fans;
}

} // namespace

std::vector<bool> PatchesWorthShowing(vtkPolyData* elements)
{
  vtkDataArray* radiance = elements->GetCellData()->GetArray("Radiance");
  vtkDataArray* emission = elements->GetCellData()->GetArray("Emission");
  vtkDataArray* polygon = elements->GetCellData()->GetArray("InputCellId");
  const auto polygonOf = [&](vtkIdType element)
  { return static_cast<vtkIdType>(polygon->GetComponent(element, 0)); };

  std::set<vtkIdType> lamps;
  for (vtkIdType element = 0; element < elements->GetNumberOfCells(); ++element)
  {
    if (IsPositive(emission, element))
    {
      lamps.insert(polygonOf(element));
    }
  }
  std::vector<bool> shown;
  for (vtkIdType element = 0; element < elements->GetNumberOfCells(); ++element)
  {
    const std::size_t patch = PatchOfElement(elements, element);
    shown.resize(std::max(shown.size(), patch + 1));
    const bool isLampBack = lamps.count(polygonOf(element)) != 0 && !IsPositive(emission, element);
    shown[patch] = shown[patch] || (IsPositive(radiance, element) && !isLampBack);
  }
  return shown;
}

Camera FitCamera(const Camera& camera, vtkPolyData* elements, const std::vector<bool>& shown)
{
  // The eye must lie inside of the four planes of the view frustum when these are moved up against
  // the points. With the planes of an axis, e right or up and f forward, slope s:
  //   e . (p - eye) <= s f . (p - eye)  and  -e . (p - eye) <= s f . (p - eye)  for all p.
  constexpr double Filled = 0.96; // of the image
  const ImagePlane plane(camera);
  const Vec3 axes[] = { plane.right, plane.up };
  Vec3 eye(0.0);
  double depth = std::numeric_limits<double>::infinity();
  for (const Vec3& axis : axes)
  {
    const Vec3 e = glm::normalize(axis);
    const double slope = Filled * glm::length(axis);
    double high = -std::numeric_limits<double>::infinity();
    double low = high;
    for (const Vec3& p : PointsOf(elements, shown))
    {
      high = std::max(high, glm::dot(e, p) - slope * glm::dot(plane.forward, p));
      low = std::max(low, -glm::dot(e, p) - slope * glm::dot(plane.forward, p));
    }
    eye += 0.5 * (high - low) * e;
    depth = std::min(depth, -0.5 * (high + low) / slope);
  }
  Camera fitted = camera;
  fitted.eye = eye + depth * plane.forward;
  fitted.lookAt = fitted.eye + plane.forward * glm::length(camera.lookAt - camera.eye);
  return fitted;
}

vtkSmartPointer<vtkRenderer> DrawElements(
  vtkPolyData* elements, const std::vector<bool>& shown, const Camera& camera, double exposure)
{
  vtkNew<vtkRadianceToneMapping> toneMapping;
  toneMapping->SetInputData(FanElements(elements, shown));
  toneMapping->AutomaticExposureOff();
  toneMapping->SetExposure(exposure);

  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputConnection(toneMapping->GetOutputPort());
  vtkNew<vtkActor> actor;
  actor->SetMapper(mapper);
  actor->GetProperty()->LightingOff(); // the light is in the colours
  actor->GetProperty()->BackfaceCullingOn();

  const auto renderer = vtkSmartPointer<vtkRenderer>::New();
  renderer->SetBackground(PageGrey, PageGrey, PageGrey);
  renderer->AddActor(actor);
  CameraToVtk(camera, renderer->GetActiveCamera());
  renderer->ResetCameraClippingRange();
  return renderer;
}

} // namespace vantage
