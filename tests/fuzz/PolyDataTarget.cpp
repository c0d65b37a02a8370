#include "SceneAdapter.h"
#include "fuzz/Target.h"

#include <vtkAbstractArray.h>
#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkDataArray.h>
#include <vtkFieldData.h>
#include <vtkIdTypeArray.h>
#include <vtkNew.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkStringArray.h>

#include <array>
#include <cstring>
#include <limits>

namespace vantage::fuzz
{

namespace
{

/// Bytes as choices, one after the other; zeros when they have run out.
class Choices
{
public:
  explicit Choices(const std::string& bytes)
    : Bytes(bytes)
  {
  }

  int Below(int count)
  {
    const int byte =
      this->Place < this->Bytes.size() ? static_cast<unsigned char>(this->Bytes[this->Place]) : 0;
    ++this->Place;
    return byte % count;
  }

  template <typename T>
  T Raw()
  {
    std::array<char, sizeof(T)> raw;
    for (char& byte : raw)
    {
      byte = static_cast<char>(this->Below(256));
    }
    T value;
    std::memcpy(&value, raw.data(), sizeof(T));
    return value;
  }

  /// Mostly a small one, now and then one of those that hurt.
  double Number()
  {
    using Limits = std::numeric_limits<double>;
    const int byte = this->Below(256);
    switch (byte)
    {
      case 255:
        return Limits::quiet_NaN();
      case 254:
        return Limits::infinity();
      case 253:
        return Limits::denorm_min();
      case 252:
        return -Limits::max();
      case 251:
        return this->Raw<double>();
      default:
        return (byte - 64) / 64.0;
    }
  }

  vtkIdType Index()
  {
    const int byte = this->Below(256);
    return byte == 255 ? this->Raw<vtkIdType>() : byte - 1;
  }

private:
  const std::string& Bytes;
  std::size_t Place = 0;
};

vtkSmartPointer<vtkPoints> MakePoints(Choices& choices)
{
  auto points = vtkSmartPointer<vtkPoints>::New();
  points->SetDataType(choices.Below(2) == 0 ? VTK_DOUBLE : VTK_FLOAT);
  const int count = choices.Below(20);
  for (int i = 0; i < count; ++i)
  {
    const double x = choices.Number();
    const double y = choices.Number();
    points->InsertNextPoint(x, y, choices.Number());
  }
  return points;
}

/// Well-formed cells with any indices, or, now and then, offsets that say anything.
vtkSmartPointer<vtkCellArray> MakeCells(Choices& choices)
{
  auto cells = vtkSmartPointer<vtkCellArray>::New();
  const bool isWellFormed = choices.Below(8) != 7;
  vtkNew<vtkIdTypeArray> offsets;
  vtkNew<vtkIdTypeArray> corners;
  const int count = choices.Below(6);
  for (int c = 0; c < count; ++c)
  {
    const int size = choices.Below(8);
    offsets->InsertNextValue(isWellFormed ? corners->GetNumberOfValues() : choices.Index());
    for (int k = 0; k < size; ++k)
    {
      corners->InsertNextValue(choices.Index());
    }
  }
  offsets->InsertNextValue(isWellFormed ? corners->GetNumberOfValues() : choices.Index());
  cells->SetData(offsets, corners);
  return cells;
}

/// An array of any type and shape, mostly with as many tuples as asked for.
vtkSmartPointer<vtkAbstractArray> MakeArray(Choices& choices, const char* name, vtkIdType tuples)
{
  constexpr int Types[] = { VTK_DOUBLE, VTK_FLOAT, VTK_INT, VTK_UNSIGNED_CHAR, VTK_ID_TYPE, VTK_BIT,
    VTK_STRING, VTK_VARIANT };
  auto array =
    vtkSmartPointer<vtkAbstractArray>::Take(vtkAbstractArray::CreateArray(Types[choices.Below(8)]));
  array->SetName(name);
  array->SetNumberOfComponents(1 + choices.Below(4));
  array->SetNumberOfTuples(choices.Below(8) == 7 ? choices.Below(16) : tuples);
  for (vtkIdType v = 0; v < array->GetNumberOfValues(); ++v)
  {
    const double number = choices.Number();
    const bool isWhole = array->GetDataType() != VTK_DOUBLE && array->GetDataType() != VTK_FLOAT;
    array->SetVariantValue(v, isWhole && !(std::abs(number) < 100.0) ? 7.0 : number);
  }
  return array;
}

void AddCellArrays(Choices& choices, vtkPolyData* polygons)
{
  constexpr const char* Names[] = { "Albedo", "Emission", "Specular", "Shininess", "TwoSided",
    "MaterialId", "Other", nullptr };
  const int count = choices.Below(8);
  for (int a = 0; a < count; ++a)
  {
    const char* name = Names[choices.Below(8)];
    polygons->GetCellData()->AddArray(MakeArray(choices, name, polygons->GetNumberOfCells()));
  }
}

void AddFieldArrays(Choices& choices, vtkPolyData* polygons)
{
  constexpr const char* Names[] = { "CameraEye", "CameraLookAt", "CameraUp", "CameraFieldOfView",
    "CameraAspect", "CameraName", "MaterialName" };
  const int cameras = choices.Below(4);
  if (cameras > 0)
  {
    vtkNew<vtkStringArray> names;
    names->SetName("CameraName");
    names->SetNumberOfValues(cameras);
    polygons->GetFieldData()->AddArray(names);
  }
  const int count = choices.Below(8);
  for (int a = 0; a < count; ++a)
  {
    const char* name = Names[choices.Below(7)];
    polygons->GetFieldData()->AddArray(MakeArray(choices, name, cameras));
  }
}

} // namespace

/// The bytes choose a vtkPolyData: points, cells and arrays of any size, type and value. A scene
/// that is made of it and is valid comes back from the adapter.
void ReadBytes(const std::string& bytes)
{
  Choices choices(bytes);
  vtkNew<vtkPolyData> polygons;
  polygons->SetPoints(MakePoints(choices));
  polygons->SetPolys(MakeCells(choices));
  if (choices.Below(4) == 3)
  {
    polygons->SetVerts(MakeCells(choices));
    polygons->SetLines(MakeCells(choices));
    polygons->SetStrips(MakeCells(choices));
  }
  AddCellArrays(choices, polygons);
  AddFieldArrays(choices, polygons);
  Scene scene;
  const auto read = [&]
  {
    scene = PolyDataToScene(polygons);
    scene.Validate();
  };
  if (IsRead(read))
  {
    RequireSame(PolyDataToScene(SceneToPolyData(scene)), scene);
  }
}

} // namespace vantage::fuzz
