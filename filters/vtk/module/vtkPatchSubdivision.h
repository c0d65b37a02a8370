#pragma once

#include "vtkPolyDataAlgorithm.h"
#include "vtkVantageFiltersModule.h"

/// Cleans polygons as people make them and cuts them into patches of a given size.
///
/// Input: vtkPolyData with polygons. Vertex and line cells are ignored, triangle strips are an
/// error. Vertices closer than 1e-9 of the diagonal are welded; degenerate and repeated polygons
/// are dropped, with a warning that counts them; polygons that are not flat, not convex or have
/// more than four corners are triangulated.
///
/// Output: vtkPolyData with flat convex patches, each from a triangle or a quadrilateral that was
/// quartered until no edge is longer than MaximumEdgeLength. Neighbours in one plane share points,
/// and where one is finer than the other its edge midpoints are corners of both: there are no
/// cracks, and patches may have more than four corners. Points are doubled at creases and where
/// materials (the arrays of vtkTransportSceneReader) differ. Sides stay as they are.
///
/// | cell array | type | components | content                                                  |
/// |------------|------|------------|----------------------------------------------------------|
/// | PatchId    | id   | 1          | flat triangle or quadrilateral it was cut from           |
///
/// Identifiers are not negative and unique, but not without gaps: two polygons that lie back to
/// back are 2 k and 2 k + 1, other polygons leave one of the two numbers unused.
///
/// The input's cell arrays are copied from the polygon a patch was cut from; field data are kept;
/// point data are dropped.
///
/// Errors: MaximumEdgeLength not above zero or not a number, or so small that more than 2^27
/// patches would result; no polygon with an area.
///
/// Cost: O(n log n) in the number n of patches.
class VTKVANTAGEFILTERS_EXPORT vtkPatchSubdivision : public vtkPolyDataAlgorithm
{
public:
  static vtkPatchSubdivision* New();
  vtkTypeMacro(vtkPatchSubdivision, vtkPolyDataAlgorithm)
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /// Longest edge a patch may have, scene units, > 0. Default: VTK_DOUBLE_MAX, which cuts nothing
  /// and only cleans.
  vtkSetMacro(MaximumEdgeLength, double);
  vtkGetMacro(MaximumEdgeLength, double);
  ///@}

protected:
  vtkPatchSubdivision() = default;
  ~vtkPatchSubdivision() override = default;

  int RequestData(vtkInformation*, vtkInformationVector**, vtkInformationVector*) override;

private:
  vtkPatchSubdivision(const vtkPatchSubdivision&) = delete;
  void operator=(const vtkPatchSubdivision&) = delete;

  void WarnOfDroppedPolygons(vtkIdType degenerate, vtkIdType repeated);

  double MaximumEdgeLength = VTK_DOUBLE_MAX;
};
