#include "vtkPatchSubdivision.h"

#include "ErrorRecorder.h"
#include "SceneAdapter.h"
#include "TestScenes.h"
#include "core/math/Polygon.h"

#include <vtkCell.h>
#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkDataArray.h>
#include <vtkExecutive.h>
#include <vtkFieldData.h>
#include <vtkIntArray.h>
#include <vtkNew.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <set>
#include <vector>

namespace vantage
{
namespace
{

/// The corners of a cell.
Polygon ShapeOf(vtkPolyData* data, vtkIdType cell)
{
  Polygon shape;
  vtkPoints* points = data->GetCell(cell)->GetPoints();
  for (vtkIdType k = 0; k < points->GetNumberOfPoints(); ++k)
  {
    Vec3 p;
    points->GetPoint(k, &p.x);
    shape.Add(p);
  }
  return shape;
}

double TotalArea(vtkPolyData* data)
{
  double sum = 0.0;
  for (vtkIdType c = 0; c < data->GetNumberOfCells(); ++c)
  {
    sum += Area(ShapeOf(data, c));
  }
  return sum;
}

double LongestEdge(vtkPolyData* data)
{
  double longest = 0.0;
  for (vtkIdType c = 0; c < data->GetNumberOfCells(); ++c)
  {
    vtkPoints* points = data->GetCell(c)->GetPoints();
    const vtkIdType count = points->GetNumberOfPoints();
    for (vtkIdType k = 0; k < count; ++k)
    {
      Vec3 a, b;
      points->GetPoint(k, &a.x);
      points->GetPoint((k + 1) % count, &b.x);
      longest = std::max(longest, glm::distance(a, b));
    }
  }
  return longest;
}

void AddCellArray(vtkPolyData* data, const char* name, const std::vector<int>& values)
{
  vtkNew<vtkIntArray> array;
  array->SetName(name);
  for (const int value : values)
  {
    array->InsertNextValue(value);
  }
  data->GetCellData()->AddArray(array);
}

vtkIdType CellCountOfMaterial(vtkPolyData* data, int material)
{
  vtkIdType count = 0;
  for (vtkIdType c = 0; c < data->GetNumberOfCells(); ++c)
  {
    count += data->GetCellData()->GetArray("MaterialId")->GetTuple1(c) == material ? 1 : 0;
  }
  return count;
}

TEST(PatchSubdivision, WithoutLimitOnlyCleans)
{
  vtkNew<vtkPatchSubdivision> filter;
  EXPECT_EQ(filter->GetMaximumEdgeLength(), VTK_DOUBLE_MAX);
  filter->SetInputData(SceneToPolyData(MakeLitBox()));
  filter->Update();
  EXPECT_EQ(filter->GetOutput()->GetNumberOfPolys(), 7);
  EXPECT_NEAR(TotalArea(filter->GetOutput()), 6.16, 1e-14); // round-off
}

TEST(PatchSubdivision, NoEdgeIsLongerThanTheLimit)
{
  for (const double limit : { 1.0, 0.5, 0.3, 0.07 })
  {
    SCOPED_TRACE(limit);
    vtkNew<vtkPatchSubdivision> filter;
    filter->SetInputData(SceneToPolyData(MakeLitBox()));
    filter->SetMaximumEdgeLength(limit);
    filter->Update();
    EXPECT_LE(LongestEdge(filter->GetOutput()), limit);
    EXPECT_GT(LongestEdge(filter->GetOutput()), limit / 2);   // and not cut once too often
    EXPECT_NEAR(TotalArea(filter->GetOutput()), 6.16, 1e-12); // round-off of up to 2000 areas
  }
}

TEST(PatchSubdivision, CellArraysAreThoseOfTheSource)
{
  const auto input = SceneToPolyData(MakeLitBox());
  input->GetCellData()->Initialize();
  // A cell before the polygons shifts their identifiers.
  vtkNew<vtkCellArray> lines;
  lines->InsertNextCell({ 0, 1 });
  input->SetLines(lines);
  AddCellArray(input, "MaterialId", { -1, 0, 1, 2, 3, 4, 5, 6 });
  AddCellArray(input, "Height", { -1, 0, 10, 0, 0, 0, 0, 9 }); // ten times the lowest corner's

  vtkNew<vtkPatchSubdivision> filter;
  filter->SetInputData(input);
  filter->SetMaximumEdgeLength(0.5);
  filter->Update();
  vtkPolyData* output = filter->GetOutput();
  // Six faces in four pieces; the lamp, 0.4 wide, in one.
  ASSERT_EQ(output->GetNumberOfPolys(), 25);
  std::set<double> patches;
  for (vtkIdType c = 0; c < output->GetNumberOfCells(); ++c)
  {
    const bool isCeiling = output->GetCell(c)->GetBounds()[4] == 1.0;
    const bool isLamp = output->GetCell(c)->GetBounds()[4] == 0.9;
    EXPECT_EQ(output->GetCellData()->GetArray("Height")->GetTuple1(c), isCeiling ? 10
                                                                       : isLamp  ? 9
                                                                                 : 0);
    patches.insert(output->GetCellData()->GetArray("PatchId")->GetTuple1(c));
  }
  EXPECT_EQ(patches.size(), 7u);
  EXPECT_GE(*patches.begin(), 0.0);
  EXPECT_EQ(CellCountOfMaterial(output, 6), 1);
  EXPECT_EQ(CellCountOfMaterial(output, 0), 4);
  EXPECT_TRUE(output->GetFieldData()->HasArray("CameraName"));
}

TEST(PatchSubdivision, FrontsStayFronts)
{
  vtkNew<vtkPatchSubdivision> filter;
  filter->SetInputData(SceneToPolyData(MakeLitBox()));
  filter->SetMaximumEdgeLength(0.25);
  filter->Update();
  const Vec3 inside(0.5, 0.5, 0.5);
  for (vtkIdType c = 0; c < filter->GetOutput()->GetNumberOfCells(); ++c)
  {
    const Polygon shape = ShapeOf(filter->GetOutput(), c);
    EXPECT_GT(glm::dot(UnitNormal(shape), inside - Centroid(shape)), 0.0);
  }
}

TEST(PatchSubdivision, NeighboursInAPlaneSharePoints)
{
  Scene scene;
  scene.materials.resize(1);
  // Two squares side by side, each with corners of its own.
  scene.AddPolygon({ { 0, 0, 0 }, { 1, 0, 0 }, { 1, 1, 0 }, { 0, 1, 0 } }, 0);
  scene.AddPolygon({ { 1, 0, 0 }, { 2, 0, 0 }, { 2, 1, 0 }, { 1, 1, 0 } }, 0);
  vtkNew<vtkPatchSubdivision> filter;
  filter->SetInputData(SceneToPolyData(scene));
  filter->Update();
  EXPECT_EQ(filter->GetOutput()->GetNumberOfPoints(), 6);
  filter->SetMaximumEdgeLength(0.5);
  filter->Update();
  EXPECT_EQ(filter->GetOutput()->GetNumberOfPoints(), 15); // 5 x 3
}

TEST(PatchSubdivision, WhatIsDroppedIsCounted)
{
  Scene scene = MakeLitBox();
  scene.AddPolygon({ { 0, 0, 0 }, { 1, 1, 1 }, { 2, 2, 2 } }, 0);
  vtkNew<vtkPatchSubdivision> filter;
  ErrorRecorder recorder(filter);
  filter->SetInputData(SceneToPolyData(scene));
  filter->Update();
  EXPECT_EQ(filter->GetOutput()->GetNumberOfPolys(), 7);
  EXPECT_NE(recorder.Take().find("dropped 1 polygons without area"), std::string::npos);
}

TEST(PatchSubdivision, ABadLimitIsAnErrorAndGivesNothing)
{
  vtkNew<vtkPatchSubdivision> filter;
  ErrorRecorder recorder(filter);
  ErrorRecorder executive(filter->GetExecutive());
  filter->SetInputData(SceneToPolyData(MakeLitBox()));
  for (const double bad : { 0.0, -1.0, std::numeric_limits<double>::quiet_NaN(), 1e-6 })
  {
    SCOPED_TRACE(bad);
    filter->SetMaximumEdgeLength(bad);
    filter->Update();
    EXPECT_NE(recorder.Take().find("MaximumEdgeLength"), std::string::npos);
    EXPECT_EQ(filter->GetOutput()->GetNumberOfCells(), 0);
  }
  filter->SetMaximumEdgeLength(1.0); // and it recovers
  filter->Update();
  EXPECT_EQ(recorder.Take(), "");
  EXPECT_EQ(filter->GetOutput()->GetNumberOfCells(), 7);
}

} // namespace
} // namespace vantage
