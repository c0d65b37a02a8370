#include "SceneAdapter.h"

#include "ArrayAdapter.h"
#include "CameraAdapter.h"
#include "core/Error.h"

#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkFieldData.h>
#include <vtkIdList.h>
#include <vtkIntArray.h>
#include <vtkPolyData.h>
#include <vtkStringArray.h>
#include <vtkUnsignedCharArray.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numeric>

namespace vantage
{

namespace
{

/// All that tells materials apart: identifier, sidedness, then the numbers of Material.
using MaterialKey = std::array<double, 12>;

vtkDataArray* FindNumbers(vtkCellData* cellData, const char* name)
{
  vtkDataArray* array = cellData->GetArray(name);
  if (!array && cellData->HasArray(name) != 0)
  {
    throw InputError(
      std::string("cell array ") + name + " must hold numbers; convert or remove it");
  }
  return array;
}

/// \param components how many the values have that are to be filled, 1 or 3
void CheckShape(vtkDataArray* array, vtkIdType cells, int components)
{
  if (!array)
  {
    return;
  }
  const char* name = array->GetName() ? array->GetName() : "(without a name)";
  const int found = array->GetNumberOfComponents();
  if (found != components && found != 1)
  {
    throw InputError(std::string("cell array ") + name + " has " + std::to_string(found) +
                     " components; give " + (components == 1 ? "1" : "3, or 1 for grey"));
  }
  if (array->GetNumberOfTuples() != cells)
  {
    throw InputError(std::string("cell array ") + name + " has " +
                     std::to_string(array->GetNumberOfTuples()) + " tuples for " +
                     std::to_string(cells) + " cells; give one each");
  }
}

void CheckShapes(const MaterialArrays& arrays, vtkIdType cells)
{
  CheckShape(arrays.albedo, cells, 3);
  CheckShape(arrays.emission, cells, 3);
  CheckShape(arrays.specular, cells, 3);
  CheckShape(arrays.shininess, cells, 1);
  CheckShape(arrays.twoSided, cells, 1);
  CheckShape(arrays.materialId, cells, 1);
}

/// Appends the values of one cell to a key: its tuple, grey spread over all channels, or the
/// constant when there is no array.
double* Fill(double* out, int count, vtkDataArray* array, vtkIdType cell, const double* constant)
{
  for (int k = 0; k < count; ++k)
  {
    if (!array)
    {
      *out++ = constant[k];
      continue;
    }
    const double value = array->GetComponent(cell, array->GetNumberOfComponents() > 1 ? k : 0);
    if (!std::isfinite(value))
    {
      throw InputError(std::string("cell array ") +
                       (array->GetName() ? array->GetName() : "(without a name)") +
                       ": the value of cell " + std::to_string(cell) + " is not a finite number");
    }
    *out++ = value;
  }
  return out;
}

MaterialKey KeyOf(const MaterialArrays& arrays, vtkIdType cell)
{
  const Material constant;
  const double id = 0.0;
  const double twoSided = constant.twoSided ? 1.0 : 0.0;
  MaterialKey key;
  double* out = key.data();
  out = Fill(out, 1, arrays.materialId, cell, &id);
  out = Fill(out, 1, arrays.twoSided, cell, &twoSided);
  out = Fill(out, 3, arrays.albedo, cell, &constant.albedo.x);
  out = Fill(out, 3, arrays.emission, cell, &constant.emission.x);
  out = Fill(out, 3, arrays.specular, cell, &constant.specular.x);
  Fill(out, 1, arrays.shininess, cell, &constant.shininess);
  return key;
}

Material MaterialOf(const MaterialKey& key, vtkStringArray* names, bool hasIds, vtkIdType firstCell)
{
  const double id = key[0];
  const bool named =
    names != nullptr && hasIds && id >= 0.0 && id < static_cast<double>(names->GetNumberOfValues());
  Material material;
  material.name = named ? static_cast<std::string>(names->GetValue(static_cast<vtkIdType>(id)))
                        : "cell " + std::to_string(firstCell);
  material.twoSided = key[1] != 0.0;
  material.albedo = Color(key[2], key[3], key[4]);
  material.emission = Color(key[5], key[6], key[7]);
  material.specular = Color(key[8], key[9], key[10]);
  material.shininess = key[11];
  return material;
}

/// Fills materials and materialOfPolygon.
void ReadMaterials(vtkPolyData* polygons, const MaterialArrays& arrays, Scene& scene)
{
  const auto firstCell = static_cast<vtkIdType>(FirstPolygonCell(polygons));
  std::map<MaterialKey, std::uint32_t> known;
  std::vector<std::pair<MaterialKey, vtkIdType>> found; // with the first cell of each
  for (vtkIdType p = 0; p < polygons->GetNumberOfPolys(); ++p)
  {
    const MaterialKey key = KeyOf(arrays, firstCell + p);
    const auto [entry, isNew] = known.emplace(key, static_cast<std::uint32_t>(found.size()));
    if (isNew)
    {
      found.emplace_back(key, firstCell + p);
    }
    scene.materialOfPolygon.push_back(entry->second);
  }

  std::vector<std::uint32_t> order(found.size());
  std::iota(order.begin(), order.end(), 0u);
  std::stable_sort(order.begin(), order.end(),
    [&](std::uint32_t a, std::uint32_t b) { return found[a].first[0] < found[b].first[0]; });
  auto* names =
    vtkStringArray::SafeDownCast(polygons->GetFieldData()->GetAbstractArray("MaterialName"));
  std::vector<std::uint32_t> place(found.size());
  for (const std::uint32_t f : order)
  {
    place[f] = static_cast<std::uint32_t>(scene.materials.size());
    scene.materials.push_back(
      MaterialOf(found[f].first, names, arrays.materialId != nullptr, found[f].second));
  }
  for (std::uint32_t& material : scene.materialOfPolygon)
  {
    material = place[material];
  }
}

/// Arrays that a program puts together may say anything.
void CheckCells(vtkCellArray* cells)
{
  const vtkIdType corners = cells->GetNumberOfConnectivityIds();
  vtkIdType last = 0;
  for (vtkIdType c = 0; c <= cells->GetNumberOfCells(); ++c)
  {
    const vtkIdType offset = cells->IsStorage64Bit() ? cells->GetOffsetsArray64()->GetValue(c)
                                                     : cells->GetOffsetsArray32()->GetValue(c);
    if (offset < last || offset > corners)
    {
      throw InputError("polygons: the offset of cell " + std::to_string(c) + " is " +
                       std::to_string(offset) + "; give ascending ones up to " +
                       std::to_string(corners) + ", the number of corners");
    }
    last = offset;
  }
}

void ReadPolygons(vtkPolyData* polygons, Scene& scene)
{
  CheckCells(polygons->GetPolys());
  scene.vertices.resize(static_cast<std::size_t>(polygons->GetNumberOfPoints()));
  for (std::size_t v = 0; v < scene.vertices.size(); ++v)
  {
    polygons->GetPoint(static_cast<vtkIdType>(v), &scene.vertices[v].x);
  }
  vtkNew<vtkIdList> corners;
  for (vtkIdType p = 0; p < polygons->GetNumberOfPolys(); ++p)
  {
    polygons->GetPolys()->GetCellAtId(p, corners);
    for (const vtkIdType corner : *corners)
    {
      if (corner < 0 || corner >= polygons->GetNumberOfPoints())
      {
        throw InputError("polygon " + std::to_string(p) + ": point " + std::to_string(corner) +
                         " is out of range; there are " +
                         std::to_string(polygons->GetNumberOfPoints()));
      }
      scene.indices.push_back(static_cast<std::uint32_t>(corner));
    }
    scene.offsets.push_back(static_cast<std::uint32_t>(scene.indices.size()));
  }
}

/// A cell array with the value of each polygon's material.
template <typename Function>
vtkSmartPointer<vtkDoubleArray> ColorsOfPolygons(
  const char* name, const Scene& scene, const Function& colorOf)
{
  std::vector<Color> values;
  values.reserve(scene.PolygonCount());
  for (const std::uint32_t material : scene.materialOfPolygon)
  {
    values.push_back(colorOf(scene.materials[material]));
  }
  return ColorsToArray(name, values);
}

void WriteMaterials(const Scene& scene, vtkPolyData* polygons)
{
  const std::size_t count = scene.PolygonCount();
  const auto materialOf = [&](std::size_t p) -> const Material&
  { return scene.materials[scene.materialOfPolygon[p]]; };
  vtkCellData* cellData = polygons->GetCellData();
  cellData->AddArray(ColorsOfPolygons("Albedo", scene, [](const Material& m) { return m.albedo; }));
  cellData->AddArray(
    ColorsOfPolygons("Emission", scene, [](const Material& m) { return m.emission; }));
  cellData->AddArray(
    ColorsOfPolygons("Specular", scene, [](const Material& m) { return m.specular; }));
  cellData->AddArray(MakeArray<vtkDoubleArray>(
    "Shininess", count, [&](std::size_t p) { return materialOf(p).shininess; }));
  cellData->AddArray(MakeArray<vtkUnsignedCharArray>(
    "TwoSided", count, [&](std::size_t p) { return materialOf(p).twoSided ? 1 : 0; }));
  cellData->AddArray(MakeArray<vtkIntArray>(
    "MaterialId", count, [&](std::size_t p) { return scene.materialOfPolygon[p]; }));

  vtkNew<vtkStringArray> names;
  names->SetName("MaterialName");
  for (const Material& material : scene.materials)
  {
    names->InsertNextValue(material.name);
  }
  polygons->GetFieldData()->AddArray(names);
}

} // namespace

MaterialArrays FindMaterialArrays(vtkPolyData* polygons)
{
  vtkCellData* cellData = polygons->GetCellData();
  MaterialArrays arrays;
  arrays.albedo = FindNumbers(cellData, "Albedo");
  arrays.emission = FindNumbers(cellData, "Emission");
  arrays.specular = FindNumbers(cellData, "Specular");
  arrays.shininess = FindNumbers(cellData, "Shininess");
  arrays.twoSided = FindNumbers(cellData, "TwoSided");
  arrays.materialId = FindNumbers(cellData, "MaterialId");
  return arrays;
}

std::size_t FirstPolygonCell(vtkPolyData* polygons)
{
  return static_cast<std::size_t>(polygons->GetNumberOfVerts() + polygons->GetNumberOfLines());
}

vtkSmartPointer<vtkPolyData> SceneToPolyData(const Scene& scene)
{
  auto polygons = vtkSmartPointer<vtkPolyData>::New();
  polygons->SetPoints(VerticesToPoints(scene.vertices));
  polygons->SetPolys(PolygonsToCells(scene.indices, scene.offsets));
  WriteMaterials(scene, polygons);
  CamerasToFieldData(scene.cameras, polygons->GetFieldData());
  return polygons;
}

Scene PolyDataToScene(vtkPolyData* polygons, const MaterialArrays& arrays)
{
  if (polygons->GetNumberOfStrips() > 0)
  {
    throw InputError("polygons: triangle strips are not read; pass them through "
                     "vtkTriangleFilter first");
  }
  CheckShapes(arrays, polygons->GetNumberOfCells());
  Scene scene;
  ReadPolygons(polygons, scene);
  ReadMaterials(polygons, arrays, scene);
  scene.cameras = CamerasFromFieldData(polygons->GetFieldData());
  return scene;
}

Scene PolyDataToScene(vtkPolyData* polygons)
{
  return PolyDataToScene(polygons, FindMaterialArrays(polygons));
}

} // namespace vantage
