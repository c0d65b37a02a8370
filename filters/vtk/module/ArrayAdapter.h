#pragma once

#include "core/math/Types.h"

#include <vtkDoubleArray.h>
#include <vtkNew.h>
#include <vtkPoints.h>
#include <vtkSmartPointer.h>

#include <cstdint>
#include <vector>

class vtkCellArray;

/// \file ArrayAdapter.h
/// Vectors of the core as arrays of VTK. Every function copies, so that what comes out lives on
/// its own.

namespace vantage
{

/// Three components a tuple, in double precision like the core.
vtkSmartPointer<vtkDoubleArray> ColorsToArray(const char* name, const std::vector<Color>& values);

/// Points in double precision.
vtkSmartPointer<vtkPoints> VerticesToPoints(const std::vector<Vec3>& vertices);

/// Polygons given as in Scene: polygon p has the vertices indices[offsets[p]] ..
/// indices[offsets[p + 1] - 1].
vtkSmartPointer<vtkCellArray> PolygonsToCells(
  const std::vector<std::uint32_t>& indices, const std::vector<std::uint32_t>& offsets);

/// One component a tuple: `valueOf(k)` for k = 0 .. count - 1.
template <typename ArrayType, typename Function>
vtkSmartPointer<ArrayType> MakeArray(const char* name, std::size_t count, const Function& valueOf)
{
  auto array = vtkSmartPointer<ArrayType>::New();
  array->SetName(name);
  array->SetNumberOfValues(static_cast<vtkIdType>(count));
  for (std::size_t k = 0; k < count; ++k)
  {
    array->SetValue(
      static_cast<vtkIdType>(k), static_cast<typename ArrayType::ValueType>(valueOf(k)));
  }
  return array;
}

} // namespace vantage
