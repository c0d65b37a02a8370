#pragma once

#include "core/scene/Scene.h"
#include "vtkVantageFiltersModule.h"

#include <vtkSmartPointer.h>

class vtkDataArray;
class vtkPolyData;

/// \file SceneAdapter.h
/// Scenes of the core as vtkPolyData. Polygon p of the scene is the p-th cell of `Polys`; its front
/// is the side the vertices run counter-clockwise on. What a surface is made of is cell data:
///
/// | cell array | components | content                                          | when absent |
/// |------------|------------|--------------------------------------------------|-------------|
/// | Albedo     | 3 (or 1)   | reflected / incident flux, in [0, 1]             | 0.5         |
/// | Emission   | 3 (or 1)   | radiance of the front side, W m^-2 sr^-1, >= 0   | 0           |
/// | Specular   | 3 (or 1)   | reflectance of a Phong lobe, in [0, 1]           | 0           |
/// | Shininess  | 1          | exponent of that lobe, >= 0                      | 0           |
/// | TwoSided   | 1          | 0: the back neither reflects nor emits           | 1           |
/// | MaterialId | 1          | which material; tells equal ones apart           | 0           |
///
/// An array of one component where three are usual is grey. Any numeric type is read; double is
/// written. Field data: the string array MaterialName (name of material MaterialId) and the cameras
/// as in CameraAdapter.h.

namespace vantage
{

/// The cell arrays to make materials from; null where a constant is to be used.
struct MaterialArrays
{
  vtkDataArray* albedo = nullptr;
  vtkDataArray* emission = nullptr;
  vtkDataArray* specular = nullptr;
  vtkDataArray* shininess = nullptr;
  vtkDataArray* twoSided = nullptr;
  vtkDataArray* materialId = nullptr;
};

/// The arrays of these names. \throw InputError when one of them does not hold numbers.
VTKVANTAGEFILTERS_EXPORT MaterialArrays FindMaterialArrays(vtkPolyData* polygons);

/// All of the scene that the table above can hold; O(size).
VTKVANTAGEFILTERS_EXPORT vtkSmartPointer<vtkPolyData> SceneToPolyData(const Scene& scene);

/// The scene of the polygons. Cells that agree in all arrays share a material; materials are
/// ordered by MaterialId, then by first use, so that a scene whose materials are all used comes
/// back from SceneToPolyData() bit for bit. A material without a name is called after its first
/// cell. Vertex and line cells are ignored. The scene is not validated otherwise: call
/// Scene::Validate(). O(n log(materials)). \throw InputError for triangle strips, for cells whose
/// offsets or points are out of range, and for arrays
/// with a wrong number of tuples or components, NaN or infinite numbers.
VTKVANTAGEFILTERS_EXPORT Scene PolyDataToScene(vtkPolyData* polygons, const MaterialArrays& arrays);

/// The same with the arrays of the usual names.
VTKVANTAGEFILTERS_EXPORT Scene PolyDataToScene(vtkPolyData* polygons);

/// Id of the first polygon among all cells: VTK counts vertices and lines before.
VTKVANTAGEFILTERS_EXPORT std::size_t FirstPolygonCell(vtkPolyData* polygons);

} // namespace vantage
