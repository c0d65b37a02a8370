#include "vtkImportanceDrivenShooting.h"

#include "SceneAdapter.h"
#include "TestScenes.h"
#include "core/Solver.h"

#include <vtkCell.h>
#include <vtkFieldData.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkStaticCellLocator.h>
#include <vtkTriangleFilter.h>

#include <gtest/gtest.h>

namespace vantage
{
namespace
{

/// Radiance of the triangles that rays through an image meet, interpolated as a renderer does.
std::vector<Color> PlainRender(vtkPolyData* elements, const Camera& camera, int width, int height)
{
  vtkNew<vtkTriangleFilter> triangles;
  triangles->SetInputData(elements);
  triangles->Update();
  vtkPolyData* mesh = triangles->GetOutput();
  vtkNew<vtkStaticCellLocator> locator;
  locator->SetDataSet(mesh);
  locator->BuildLocator();
  vtkDataArray* radiance = mesh->GetPointData()->GetArray("Radiance");
  const ImagePlane plane(camera);
  std::vector<Color> pixels;
  for (int k = 0; k < width * height; ++k)
  {
    const Vec3 to = plane.eye + 10.0 * plane.Direction(2.0 * (k % width + 0.5) / width - 1.0,
                                         2.0 * (k / width + 0.5) / height - 1.0);
    double t, x[3], local[3];
    int subId;
    vtkIdType cell = -1;
    Color color(0.0);
    if (locator->IntersectWithLine(&plane.eye.x, &to.x, 1e-9, t, x, local, subId, cell))
    {
      const double weights[3] = { 1.0 - local[0] - local[1], local[0], local[1] };
      for (int corner = 0; corner < 3; ++corner)
      {
        Color value;
        radiance->GetTuple(mesh->GetCell(cell)->GetPointId(corner), &value.x);
        color += weights[corner] * value;
      }
    }
    pixels.push_back(color);
  }
  return pixels;
}

TEST(GatheredElements, APlainRenderOfGatheredPointsIsAsGoodAsAPicture)
{
  // One-sided: there is one triangle in each place.
  Scene scene = MakeLitBox();
  for (Material& material : scene.materials)
  {
    material.twoSided = false;
  }
  vtkNew<vtkImportanceDrivenShooting> filter;
  filter->SetInputData(SceneToPolyData(scene));
  filter->SetCameraName("door");
  filter->SetError(0.02);
  filter->Update();
  const vtkIdType cells = filter->GetOutput(0)->GetNumberOfCells();
  vtkDataArray* estimate = filter->GetOutput(0)->GetFieldData()->GetArray("ErrorEstimate");
  ASSERT_NE(estimate, nullptr);
  EXPECT_GT(estimate->GetTuple1(0), filter->GetSolver()->History().back().errorEstimate);
  EXPECT_LE(estimate->GetTuple1(0), 0.02);

  GatherSettings settings;
  settings.width = 50;
  settings.height = 40;
  settings.pixelCentres = true;
  settings.error = 0.002;
  const Camera camera = scene.FindCamera("door");
  const Image picture = filter->GetSolver()->Gather(camera, settings).radiance;
  Image plain(settings.width, settings.height);
  const auto error = [&]
  {
    plain.pixels = PlainRender(filter->GetOutput(0), camera, settings.width, settings.height);
    return Compare(plain, picture).relativeL1;
  };
  const double gathered = error();
  EXPECT_LT(gathered, 0.02);

  filter->GatherPointsOff();
  filter->Update();
  EXPECT_LT(2 * filter->GetOutput(0)->GetNumberOfCells(), cells);
  EXPECT_EQ(filter->GetOutput(0)->GetFieldData()->GetArray("ErrorEstimate"), nullptr);
  EXPECT_GT(error(), 2.0 * gathered);
}

} // namespace
} // namespace vantage
