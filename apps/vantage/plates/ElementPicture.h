#pragma once

#include "core/scene/Camera.h"

#include <vtkSmartPointer.h>

#include <vector>

class vtkPolyData;
class vtkRenderer;

/// \file ElementPicture.h
/// The elements of a solution, drawn with interpolated radiance by VTK.

namespace vantage
{

/// For each PatchId, whether a picture from outside shows it. Sides that no light reaches, such as
/// the outsides of a building, and the backs of lamps would only hide what is behind them.
std::vector<bool> PatchesWorthShowing(vtkPolyData* elements);

/// Moves a camera, without turning it, until all that is shown just fits into its image.
Camera FitCamera(const Camera& camera, vtkPolyData* elements, const std::vector<bool>& shown);

/// Port 0 of vtkImportanceDrivenShooting seen by a camera: elements of the patches in `shown` that
/// face it, tone-mapped by vtkRadianceToneMapping with radiance times 2^exposure.
vtkSmartPointer<vtkRenderer> DrawElements(
  vtkPolyData* elements, const std::vector<bool>& shown, const Camera& camera, double exposure);

/// Shade of grey behind a picture of elements, 0 .. 1.
inline constexpr double PageGrey = 0.93;

} // namespace vantage
