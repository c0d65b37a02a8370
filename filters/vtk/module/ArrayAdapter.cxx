#include "ArrayAdapter.h"

#include <vtkCellArray.h>

namespace vantage
{

vtkSmartPointer<vtkDoubleArray> ColorsToArray(const char* name, const std::vector<Color>& values)
{
  auto array = vtkSmartPointer<vtkDoubleArray>::New();
  array->SetName(name);
  array->SetNumberOfComponents(3);
  array->SetNumberOfTuples(static_cast<vtkIdType>(values.size()));
  for (std::size_t k = 0; k < values.size(); ++k)
  {
    array->SetTypedTuple(static_cast<vtkIdType>(k), &values[k].x);
  }
  return array;
}

vtkSmartPointer<vtkPoints> VerticesToPoints(const std::vector<Vec3>& vertices)
{
  auto points = vtkSmartPointer<vtkPoints>::New();
  points->SetDataTypeToDouble();
  points->SetNumberOfPoints(static_cast<vtkIdType>(vertices.size()));
  for (std::size_t k = 0; k < vertices.size(); ++k)
  {
    points->SetPoint(static_cast<vtkIdType>(k), &vertices[k].x);
  }
  return points;
}

vtkSmartPointer<vtkCellArray> PolygonsToCells(
  const std::vector<std::uint32_t>& indices, const std::vector<std::uint32_t>& offsets)
{
  auto cells = vtkSmartPointer<vtkCellArray>::New();
  cells->AllocateExact(
    static_cast<vtkIdType>(offsets.size() - 1), static_cast<vtkIdType>(indices.size()));
  for (std::size_t p = 0; p + 1 < offsets.size(); ++p)
  {
    cells->InsertNextCell(static_cast<int>(offsets[p + 1] - offsets[p]));
    for (std::uint32_t i = offsets[p]; i < offsets[p + 1]; ++i)
    {
      cells->InsertCellPoint(indices[i]);
    }
  }
  return cells;
}

} // namespace vantage
