#include "SolutionAdapter.h"

#include <vtkCellData.h>
#include <vtkDataArray.h>
#include <vtkFieldData.h>
#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkTable.h>
#include <vtkVariant.h>

#include <gtest/gtest.h>

namespace vantage
{
namespace
{

Color CellColor(vtkPolyData* data, const char* name, vtkIdType cell)
{
  Color color;
  data->GetCellData()->GetArray(name)->GetTuple(cell, &color.x);
  return color;
}

double CellValue(vtkPolyData* data, const char* name, vtkIdType cell)
{
  return data->GetCellData()->GetArray(name)->GetTuple1(cell);
}

/// A triangle and a quadrilateral that share an edge, with a different number everywhere.
ElementSolution MakeSolution()
{
  ElementSolution solution;
  solution.surface.points = { { 0, 0, 0 }, { 1, 0, 0 }, { 1, 1, 0 }, { 0, 1, 0 }, { 0.5, 2, 0 } };
  solution.surface.indices = { 0, 1, 2, 3, 3, 2, 4 };
  solution.surface.offsets = { 0, 4, 7 };
  solution.surface.elements = { 5, 6 };
  solution.radiance = { Color(1, 2, 3), Color(3, 4, 5) };
  solution.unshotRadiance = { Color(4), Color(5) };
  solution.importance = { Color(6), Color(7) };
  solution.unshotImportance = { Color(8), Color(9) };
  solution.viewImportance = { 10, 11 };
  solution.albedo = { Color(.12), Color(.13) };
  solution.emission = { Color(14), Color(15) };
  solution.patch = { 16, 17 };
  solution.scenePolygon = { 18, 19 };
  solution.side = { Side::Front, Side::Back };
  solution.level = { 20, 21 };
  return solution;
}

TEST(SolutionAdapter, EveryFieldOfTheElementsIsACellArray)
{
  const auto elements = ElementsToPolyData(MakeSolution());
  ASSERT_EQ(elements->GetNumberOfPolys(), 2);
  EXPECT_EQ(elements->GetCell(0)->GetNumberOfPoints(), 4);
  EXPECT_EQ(elements->GetCell(1)->GetNumberOfPoints(), 3);
  EXPECT_EQ(elements->GetCell(1)->GetPointId(2), 4);
  EXPECT_EQ(elements->GetCellData()->GetNumberOfArrays(), 11);
  EXPECT_EQ(CellColor(elements, "Radiance", 0), Color(1, 2, 3));
  EXPECT_EQ(CellColor(elements, "UnshotRadiance", 1), Color(5));
  EXPECT_EQ(CellColor(elements, "Importance", 1), Color(7));
  EXPECT_EQ(CellColor(elements, "UnshotImportance", 1), Color(9));
  EXPECT_EQ(CellValue(elements, "ViewImportance", 1), 11);
  EXPECT_EQ(CellColor(elements, "Albedo", 1), Color(.13));
  EXPECT_EQ(CellColor(elements, "Emission", 1), Color(15));
  EXPECT_EQ(CellValue(elements, "PatchId", 1), 17);
  EXPECT_EQ(CellValue(elements, "InputCellId", 1), 19);
  EXPECT_EQ(CellValue(elements, "Side", 1), 1);
  EXPECT_EQ(CellValue(elements, "Level", 1), 21);
}

TEST(SolutionAdapter, PointRadianceIsThatOfThePoints)
{
  ElementSolution solution = MakeSolution();
  for (int i = 0; i < 5; ++i)
  {
    solution.pointRadiance.push_back(Color(i, 10 * i, 100 * i));
  }
  const auto elements = ElementsToPolyData(solution);
  vtkDataArray* radiance = elements->GetPointData()->GetArray("Radiance");
  ASSERT_EQ(radiance->GetNumberOfTuples(), 5);
  for (int i = 0; i < 5; ++i)
  {
    EXPECT_EQ(radiance->GetComponent(i, 2), 100.0 * i);
  }
  EXPECT_EQ(elements->GetFieldData()->GetArray("ErrorEstimate"), nullptr);
}

TEST(SolutionAdapter, IrradianceIsThereWhereItIsKnown)
{
  ElementSolution solution = MakeSolution();
  solution.irradiance = { Color(1, 2, 3), Color(4, 5, 6) };
  solution.pointIrradiance.assign(5, Color(7));
  const auto elements = ElementsToPolyData(solution);
  EXPECT_EQ(CellColor(elements, "Irradiance", 1), Color(4, 5, 6));
  EXPECT_EQ(elements->GetPointData()->GetArray("Irradiance")->GetComponent(4, 0), 7.0);
  const auto others = ElementsToPolyData(MakeSolution());
  EXPECT_EQ(others->GetCellData()->GetArray("Irradiance"), nullptr);
  EXPECT_EQ(others->GetPointData()->GetArray("Irradiance"), nullptr);
}

TEST(SolutionAdapter, GatheredElementsStateTheirError)
{
  GatheredElements gathered;
  gathered.elements = MakeSolution();
  gathered.errorEstimate = 0.04;
  const auto elements = ElementsToPolyData(gathered, 0.03);
  EXPECT_DOUBLE_EQ(elements->GetFieldData()->GetArray("ErrorEstimate")->GetTuple1(0), 0.05);
  EXPECT_EQ(elements->GetNumberOfCells(), 2);
}

TEST(SolutionAdapter, AnInteractionIsALineFromShooterToReceiver)
{
  InteractionRecord record{};
  record.shooterCentre = Vec3(1, 2, 3);
  record.receiverCentre = Vec3(4, 5, 6);
  record.shooter = 7;
  record.receiver = 8;
  record.shooterLevel = 9;
  record.receiverLevel = 10;
  record.formFactor = 0.25;
  record.visibility = 0.5;
  record.shotFlux = 11;
  record.contribution = 12;
  record.step = 13;
  const auto links = InteractionsToPolyData({ InteractionRecord{}, record });
  ASSERT_EQ(links->GetNumberOfLines(), 2);
  Vec3 from, to;
  links->GetPoint(links->GetCell(1)->GetPointId(0), &from.x);
  links->GetPoint(links->GetCell(1)->GetPointId(1), &to.x);
  EXPECT_EQ(from, record.shooterCentre);
  EXPECT_EQ(to, record.receiverCentre);
  EXPECT_EQ(CellValue(links, "Shooter", 1), 7);
  EXPECT_EQ(CellValue(links, "Receiver", 1), 8);
  EXPECT_EQ(CellValue(links, "ShooterLevel", 1), 9);
  EXPECT_EQ(CellValue(links, "ReceiverLevel", 1), 10);
  EXPECT_EQ(CellValue(links, "FormFactor", 1), 0.25);
  EXPECT_EQ(CellValue(links, "Visibility", 1), 0.5);
  EXPECT_EQ(CellValue(links, "ShotFlux", 1), 11);
  EXPECT_EQ(CellValue(links, "Contribution", 1), 12);
  EXPECT_EQ(CellValue(links, "Step", 1), 13);
}

TEST(SolutionAdapter, ClustersHaveNoPatch)
{
  InteractionRecord record{};
  record.shooter = 7;
  record.receiver = None;
  record.receiverLevel = InteractionRecord::ClusterLevel;
  const auto links = InteractionsToPolyData({ record });
  EXPECT_EQ(CellValue(links, "Shooter", 0), 7);
  EXPECT_EQ(CellValue(links, "Receiver", 0), -1);
  EXPECT_EQ(CellValue(links, "ReceiverLevel", 0), -1);
}

TEST(SolutionAdapter, HistoryHasARowForEachStep)
{
  StepReport report;
  report.step = 1;
  report.phase = "radiance";
  report.viewFlux = 2;
  report.unshotViewFlux = 3;
  report.unshotPower = 4;
  report.errorEstimate = 5;
  report.elements = 6;
  report.interactions = 7;
  report.work.surfacePairs = 8;
  report.work.pairRays = 9;
  report.seconds = 10;
  StepReport other = report;
  other.patch = 11;
  const auto table = HistoryToTable({ report, other });
  ASSERT_EQ(table->GetNumberOfRows(), 2);
  const auto at = [&](const char* column) { return table->GetValueByName(0, column).ToDouble(); };
  EXPECT_EQ(table->GetValueByName(0, "Phase").ToString(), "radiance");
  EXPECT_EQ(at("Patch"), -1);
  EXPECT_EQ(table->GetValueByName(1, "Patch").ToInt(), 11);
  EXPECT_EQ(at("Step"), 1);
  EXPECT_EQ(at("ViewFlux"), 2);
  EXPECT_EQ(at("UnshotViewFlux"), 3);
  EXPECT_EQ(at("UnshotPower"), 4);
  EXPECT_EQ(at("ErrorEstimate"), 5);
  EXPECT_EQ(at("Elements"), 6);
  EXPECT_EQ(at("Interactions"), 7);
  EXPECT_EQ(at("Evaluations"), 8);
  EXPECT_EQ(at("Rays"), 9);
  EXPECT_EQ(at("Seconds"), 10);
}

TEST(SolutionAdapter, NothingGivesEmptyOutputsWithAllArrays)
{
  EXPECT_EQ(ElementsToPolyData({})->GetCellData()->GetNumberOfArrays(), 11);
  EXPECT_EQ(InteractionsToPolyData({})->GetCellData()->GetNumberOfArrays(), 9);
  EXPECT_EQ(HistoryToTable({})->GetNumberOfColumns(), 21);
}

TEST(SolutionAdapter, ImageRowsRunFromBottomToTop)
{
  Image image(2, 3);
  image.At(1, 0) = Color(0.5, 1.0, 2.0);
  image.At(0, 2) = Color(7.0);
  const auto imageData = ImageToImageData(image);
  int dimensions[3];
  imageData->GetDimensions(dimensions);
  EXPECT_EQ(dimensions[0], 2);
  EXPECT_EQ(dimensions[1], 3);
  vtkDataArray* radiance = imageData->GetPointData()->GetArray("Radiance");
  EXPECT_EQ(radiance->GetDataType(), VTK_FLOAT);
  int bottomRight[3] = { 1, 0, 0 };
  EXPECT_EQ(radiance->GetComponent(imageData->ComputePointId(bottomRight), 2), 2.0);
  int topLeft[3] = { 0, 2, 0 };
  EXPECT_EQ(radiance->GetComponent(imageData->ComputePointId(topLeft), 0), 7.0);
}

} // namespace
} // namespace vantage
