#include "SceneAdapter.h"

#include "TestScenes.h"
#include "core/Error.h"

#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkDoubleArray.h>
#include <vtkFieldData.h>
#include <vtkFloatArray.h>
#include <vtkIdTypeArray.h>
#include <vtkIntArray.h>
#include <vtkNew.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkStringArray.h>

#include <gtest/gtest.h>

#include <limits>

namespace vantage
{
namespace
{

void ExpectEqual(const Scene& a, const Scene& b)
{
  EXPECT_EQ(a.vertices, b.vertices);
  EXPECT_EQ(a.indices, b.indices);
  EXPECT_EQ(a.offsets, b.offsets);
  EXPECT_EQ(a.materialOfPolygon, b.materialOfPolygon);
  ASSERT_EQ(a.materials.size(), b.materials.size());
  for (std::size_t m = 0; m < a.materials.size(); ++m)
  {
    SCOPED_TRACE(m);
    EXPECT_EQ(a.materials[m].name, b.materials[m].name);
    EXPECT_EQ(a.materials[m].albedo, b.materials[m].albedo);
    EXPECT_EQ(a.materials[m].emission, b.materials[m].emission);
    EXPECT_EQ(a.materials[m].specular, b.materials[m].specular);
    EXPECT_EQ(a.materials[m].shininess, b.materials[m].shininess);
    EXPECT_EQ(a.materials[m].twoSided, b.materials[m].twoSided);
  }
  EXPECT_EQ(a.cameras.size(), b.cameras.size());
}

/// `count` unit squares one above the other, without any arrays.
vtkSmartPointer<vtkPolyData> MakeSquares(int count)
{
  Scene scene;
  scene.materials.resize(1);
  for (int k = 0; k < count; ++k)
  {
    const double z = k;
    scene.AddPolygon({ { 0, 0, z }, { 1, 0, z }, { 1, 1, z }, { 0, 1, z } }, 0);
  }
  const auto squares = SceneToPolyData(scene);
  squares->GetCellData()->Initialize();
  squares->GetFieldData()->Initialize();
  return squares;
}

template <typename ArrayType>
void AddCellArray(
  vtkPolyData* polygons, const char* name, int components, const std::vector<double>& values)
{
  vtkNew<ArrayType> array;
  array->SetName(name);
  array->SetNumberOfComponents(components);
  for (const double value : values)
  {
    array->InsertNextValue(static_cast<typename ArrayType::ValueType>(value));
  }
  polygons->GetCellData()->AddArray(array);
}

TEST(SceneAdapter, ASceneComesBackBitForBit)
{
  Scene scene = MakeLitBox();
  scene.vertices[3] = Vec3(1.0 / 3.0, 1e-300, -0.1);
  scene.materials[0].specular = Color(0.1, 0.2, 0.3);
  scene.materials[0].shininess = 12.5;
  // Equal to material 0 but for its name: only MaterialId keeps the two apart.
  scene.materials.push_back(scene.materials[0]);
  scene.materials.back().name = "";
  scene.materialOfPolygon[4] = 3;
  ExpectEqual(PolyDataToScene(SceneToPolyData(scene)), scene);
}

TEST(SceneAdapter, MaterialsKeepTheirOrderWhateverIsUsedFirst)
{
  Scene scene = MakeLitBox();
  scene.materialOfPolygon = { 2, 1, 0, 1, 2, 0, 0 };
  ExpectEqual(PolyDataToScene(SceneToPolyData(scene)), scene);
}

TEST(SceneAdapter, ConstantsStandInForArraysThatAreMissing)
{
  const Scene scene = PolyDataToScene(MakeSquares(2));
  ASSERT_EQ(scene.materials.size(), 1u);
  EXPECT_EQ(scene.materials[0].albedo, Color(0.5));
  EXPECT_EQ(scene.materials[0].emission, Color(0.0));
  EXPECT_EQ(scene.materials[0].specular, Color(0.0));
  EXPECT_EQ(scene.materials[0].shininess, 0.0);
  EXPECT_TRUE(scene.materials[0].twoSided);
  EXPECT_EQ(scene.materialOfPolygon, (std::vector<std::uint32_t>{ 0, 0 }));
  EXPECT_TRUE(scene.cameras.empty());
}

TEST(SceneAdapter, OneComponentIsGreyAndAnyNumericTypeIsRead)
{
  const auto squares = MakeSquares(2);
  AddCellArray<vtkFloatArray>(squares, "Albedo", 1, { 0.25, 0.75 });
  AddCellArray<vtkIntArray>(squares, "Emission", 3, { 0, 0, 0, 1, 2, 3 });
  const Scene scene = PolyDataToScene(squares);
  ASSERT_EQ(scene.materials.size(), 2u);
  EXPECT_EQ(scene.materials[0].albedo, Color(0.25));
  EXPECT_EQ(scene.materials[1].albedo, Color(0.75));
  EXPECT_EQ(scene.materials[1].emission, Color(1, 2, 3));
  EXPECT_EQ(scene.materials[1].name, "cell 1");
}

TEST(SceneAdapter, CellsThatAgreeShareAMaterial)
{
  const auto squares = MakeSquares(4);
  AddCellArray<vtkDoubleArray>(squares, "Albedo", 1, { 0.25, 0.75, 0.25, 0.75 });
  EXPECT_EQ(PolyDataToScene(squares).materialOfPolygon, (std::vector<std::uint32_t>{ 0, 1, 0, 1 }));
  AddCellArray<vtkIntArray>(squares, "MaterialId", 1, { 9, 5, 7, 5 });
  EXPECT_EQ(PolyDataToScene(squares).materialOfPolygon, (std::vector<std::uint32_t>{ 2, 0, 1, 0 }));
}

TEST(SceneAdapter, VertexAndLineCellsAreIgnoredButCounted)
{
  const auto squares = MakeSquares(2);
  vtkNew<vtkCellArray> vertices, lines;
  vertices->InsertNextCell({ 0 });
  lines->InsertNextCell({ 0, 1 });
  squares->SetVerts(vertices);
  squares->SetLines(lines);
  AddCellArray<vtkDoubleArray>(squares, "Albedo", 1, { 0.9, 0.8, 0.25, 0.75 });
  const Scene scene = PolyDataToScene(squares);
  ASSERT_EQ(scene.PolygonCount(), 2u);
  EXPECT_EQ(scene.materials[scene.materialOfPolygon[0]].albedo, Color(0.25));
  EXPECT_EQ(scene.materials[scene.materialOfPolygon[1]].albedo, Color(0.75));
}

TEST(SceneAdapter, TriangleStripsAreAnError)
{
  const auto squares = MakeSquares(1);
  vtkNew<vtkCellArray> strips;
  strips->InsertNextCell({ 0, 1, 3, 2 });
  squares->SetStrips(strips);
  EXPECT_THROW(PolyDataToScene(squares), InputError);
}

TEST(SceneAdapter, ArraysOfAWrongShapeAreAnError)
{
  const auto tooFewComponents = MakeSquares(2);
  AddCellArray<vtkDoubleArray>(tooFewComponents, "Albedo", 2, { 0, 0, 0, 0 });
  EXPECT_THROW(PolyDataToScene(tooFewComponents), InputError);

  const auto tooManyComponents = MakeSquares(2);
  AddCellArray<vtkDoubleArray>(tooManyComponents, "Shininess", 3, { 0, 0, 0, 0, 0, 0 });
  EXPECT_THROW(PolyDataToScene(tooManyComponents), InputError);

  const auto tooFewTuples = MakeSquares(2);
  AddCellArray<vtkDoubleArray>(tooFewTuples, "Emission", 3, { 0, 0, 0 });
  EXPECT_THROW(PolyDataToScene(tooFewTuples), InputError);

  const auto notNumbers = MakeSquares(2);
  vtkNew<vtkStringArray> words;
  words->SetName("Albedo");
  words->SetNumberOfValues(2);
  notNumbers->GetCellData()->AddArray(words);
  EXPECT_THROW(PolyDataToScene(notNumbers), InputError);
}

TEST(SceneAdapter, NumbersThatAreNotFiniteAreAnErrorThatNamesTheCell)
{
  for (const double bad :
    { std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity() })
  {
    const auto squares = MakeSquares(2);
    AddCellArray<vtkDoubleArray>(squares, "Emission", 3, { 0, 0, 0, 0, bad, 0 });
    try
    {
      PolyDataToScene(squares);
      FAIL() << "no error for " << bad;
    }
    catch (const InputError& error)
    {
      EXPECT_NE(std::string(error.what()).find("Emission"), std::string::npos);
      EXPECT_NE(std::string(error.what()).find("cell 1"), std::string::npos);
    }
  }
}

TEST(SceneAdapter, CornersAndOffsetsOutOfRangeAreAnError)
{
  // Cut down to 32 bits, the last one would be a point that there is.
  for (const vtkIdType bad : { vtkIdType(-1), vtkIdType(4), (vtkIdType(1) << 32) + 1 })
  {
    const auto square = MakeSquares(1);
    vtkNew<vtkCellArray> cells;
    cells->InsertNextCell({ 0, 1, bad });
    square->SetPolys(cells);
    EXPECT_THROW(PolyDataToScene(square), InputError) << bad;
  }
  for (const vtkIdType bad : { vtkIdType(-1), vtkIdType(2), vtkIdType(7) })
  {
    const auto square = MakeSquares(1);
    vtkNew<vtkIdTypeArray> offsets, corners;
    for (const vtkIdType offset : { vtkIdType(0), vtkIdType(3), bad })
    {
      offsets->InsertNextValue(offset);
    }
    for (vtkIdType k = 0; k < 6; ++k)
    {
      corners->InsertNextValue(k % 4);
    }
    vtkNew<vtkCellArray> cells;
    cells->SetData(offsets, corners);
    square->SetPolys(cells);
    EXPECT_THROW(PolyDataToScene(square), InputError) << bad;
  }
}

TEST(SceneAdapter, EmptyPolyDataAreASceneThatIsNotValid)
{
  vtkNew<vtkPolyData> nothing;
  const Scene scene = PolyDataToScene(nothing);
  EXPECT_EQ(scene.PolygonCount(), 0u);
  EXPECT_THROW(scene.Validate(), InputError);
}

} // namespace
} // namespace vantage
