#include "vtkTransportSceneReader.h"

#include "ErrorRecorder.h"
#include "SceneAdapter.h"
#include "TestScenes.h"
#include "io/ObjFile.h"

#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkDataArray.h>
#include <vtkDoubleArray.h>
#include <vtkExecutive.h>
#include <vtkFieldData.h>
#include <vtkIntArray.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkXMLPolyDataWriter.h>

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

namespace vantage
{
namespace
{

/// A file of this test alone.
std::string PathOf(const std::string& name)
{
  return testing::TempDir() + "/" + testing::UnitTest::GetInstance()->current_test_info()->name() +
         "-" + name;
}

void WriteVtp(vtkPolyData* data, const std::string& path)
{
  vtkNew<vtkXMLPolyDataWriter> writer;
  writer->SetFileName(path.c_str());
  writer->SetInputData(data);
  ASSERT_EQ(writer->Write(), 1);
}

void ExpectEqual(const Scene& a, const Scene& b)
{
  EXPECT_EQ(a.vertices, b.vertices);
  EXPECT_EQ(a.indices, b.indices);
  EXPECT_EQ(a.offsets, b.offsets);
  EXPECT_EQ(a.materialOfPolygon, b.materialOfPolygon);
  ASSERT_EQ(a.materials.size(), b.materials.size());
  for (std::size_t m = 0; m < a.materials.size(); ++m)
  {
    EXPECT_EQ(a.materials[m].name, b.materials[m].name);
    EXPECT_EQ(a.materials[m].albedo, b.materials[m].albedo);
    EXPECT_EQ(a.materials[m].emission, b.materials[m].emission);
    EXPECT_EQ(a.materials[m].twoSided, b.materials[m].twoSided);
  }
  ASSERT_EQ(a.cameras.size(), b.cameras.size());
  for (std::size_t c = 0; c < a.cameras.size(); ++c)
  {
    EXPECT_EQ(a.cameras[c].name, b.cameras[c].name);
    EXPECT_EQ(a.cameras[c].eye, b.cameras[c].eye);
    EXPECT_EQ(a.cameras[c].lookAt, b.cameras[c].lookAt);
    EXPECT_EQ(a.cameras[c].up, b.cameras[c].up);
    EXPECT_EQ(a.cameras[c].fieldOfView, b.cameras[c].fieldOfView);
    EXPECT_EQ(a.cameras[c].aspect, b.cameras[c].aspect);
  }
}

/// What the reader says when it is given a file that it cannot use.
std::string ErrorOf(const std::string& path)
{
  vtkNew<vtkTransportSceneReader> reader;
  ErrorRecorder recorder(reader);
  ErrorRecorder executive(reader->GetExecutive());
  reader->SetFileName(path.c_str());
  reader->Update();
  EXPECT_EQ(reader->GetOutput()->GetNumberOfCells(), 0);
  return recorder.Take();
}

TEST(TransportSceneReader, VtpGivesTheSceneBackBitForBit)
{
  Scene scene = MakeLitBox();
  scene.vertices[0] = Vec3(1.0 / 3.0, -0.1, 1e-300);
  scene.cameras.push_back(scene.cameras[0]);
  scene.cameras.back().name = "window";
  scene.cameras.back().eye.x = 0.2;
  const std::string path = PathOf("scene.vtp");
  WriteVtp(SceneToPolyData(scene), path);

  vtkNew<vtkTransportSceneReader> reader;
  reader->SetFileName(path.c_str());
  reader->Update();
  ExpectEqual(PolyDataToScene(reader->GetOutput()), scene);
}

TEST(TransportSceneReader, ObjGivesTheScene)
{
  const Scene scene = MakeLitBox();
  const std::string path = PathOf("scene.obj");
  WriteObj(scene, path);
  vtkNew<vtkTransportSceneReader> reader;
  reader->SetFileName(path.c_str());
  reader->Update();
  ExpectEqual(PolyDataToScene(reader->GetOutput()), ReadObj(path));
  EXPECT_EQ(reader->GetOutput()->GetNumberOfPolys(), 7);
}

TEST(TransportSceneReader, ArraysAreAddedAndOthersKept)
{
  const auto polygons = SceneToPolyData(MakeLitBox());
  polygons->GetCellData()->Initialize();
  polygons->GetFieldData()->Initialize();
  vtkNew<vtkCellArray> lines;
  lines->InsertNextCell({ 0, 1 });
  polygons->SetLines(lines);
  vtkNew<vtkIntArray> cells;
  cells->SetName("Number");
  for (int k = 0; k < 8; ++k)
  {
    cells->InsertNextValue(k);
  }
  polygons->GetCellData()->AddArray(cells);
  vtkNew<vtkDoubleArray> points;
  points->SetName("Temperature");
  points->SetNumberOfTuples(polygons->GetNumberOfPoints());
  points->Fill(20.5);
  polygons->GetPointData()->AddArray(points);
  vtkNew<vtkIntArray> field;
  field->SetName("Year");
  field->InsertNextValue(1995);
  polygons->GetFieldData()->AddArray(field);
  const std::string path = PathOf("plain.vtp");
  WriteVtp(polygons, path);

  vtkNew<vtkTransportSceneReader> reader;
  reader->SetFileName(path.c_str());
  reader->Update();
  vtkPolyData* output = reader->GetOutput();
  ASSERT_EQ(output->GetNumberOfCells(), 7);
  for (const char* name :
    { "Albedo", "Emission", "Specular", "Shininess", "TwoSided", "MaterialId" })
  {
    SCOPED_TRACE(name);
    ASSERT_TRUE(output->GetCellData()->HasArray(name));
    EXPECT_EQ(output->GetCellData()->GetArray(name)->GetNumberOfTuples(), 7);
  }
  EXPECT_EQ(output->GetCellData()->GetArray("Albedo")->GetTuple3(6)[2], 0.5);
  // The line, cell 0 of the file, is gone.
  EXPECT_EQ(output->GetCellData()->GetArray("Number")->GetTuple1(0), 1);
  EXPECT_EQ(output->GetCellData()->GetArray("Number")->GetTuple1(6), 7);
  EXPECT_EQ(output->GetPointData()->GetArray("Temperature")->GetTuple1(3), 20.5);
  EXPECT_EQ(output->GetFieldData()->GetArray("Year")->GetTuple1(0), 1995);
}

TEST(TransportSceneReader, FilesThatCannotBeUsedAreErrors)
{
  EXPECT_NE(ErrorOf("").find("FileName is empty"), std::string::npos);
  EXPECT_NE(ErrorOf(PathOf("missing.vtp")).find("no such file"), std::string::npos);

  const std::string wrongSuffix = PathOf("scene.stl");
  std::ofstream(wrongSuffix) << "solid\n";
  EXPECT_NE(ErrorOf(wrongSuffix).find(".obj, .vtp"), std::string::npos);

  const std::string notXml = PathOf("broken.vtp");
  std::ofstream(notXml) << "this is not XML\n";
  EXPECT_NE(ErrorOf(notXml).find("not a readable VTK polygon file"), std::string::npos);

  const std::string cut = PathOf("cut.vtp");
  WriteVtp(SceneToPolyData(MakeLitBox()), cut);
  std::filesystem::resize_file(cut, std::filesystem::file_size(cut) / 2);
  EXPECT_NE(ErrorOf(cut).find("not a readable VTK polygon file"), std::string::npos);

  const std::string notObj = PathOf("broken.obj");
  std::ofstream(notObj) << "v 0 0 zero\n";
  EXPECT_NE(ErrorOf(notObj).find("broken.obj:1:"), std::string::npos);
}

TEST(TransportSceneReader, AFileWithAnInvalidSceneIsAnError)
{
  Scene scene = MakeLitBox();
  scene.materials[1].albedo.y = 1.5;
  const std::string path = PathOf("bright.vtp");
  WriteVtp(SceneToPolyData(scene), path);
  EXPECT_NE(ErrorOf(path).find("bright.vtp: material 'floor': albedo"), std::string::npos);
}

} // namespace
} // namespace vantage
