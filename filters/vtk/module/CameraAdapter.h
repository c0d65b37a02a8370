#pragma once

#include "core/scene/Camera.h"
#include "vtkVantageFiltersModule.h"

#include <vector>

class vtkCamera;
class vtkFieldData;

/// \file CameraAdapter.h
/// Cameras of the core as vtkCamera, and as field data that travels with polygons:
///
/// | field array       | type   | components | content                               |
/// |-------------------|--------|------------|---------------------------------------|
/// | CameraName        | string | 1          | unique names to choose by             |
/// | CameraEye         | double | 3          | position, scene units                 |
/// | CameraLookAt      | double | 3          | point in the middle of the image      |
/// | CameraUp          | double | 3          | upward direction                      |
/// | CameraFieldOfView | double | 1          | vertical, degrees, in (0, 180)        |
/// | CameraAspect      | double | 1          | width / height of the image, above 0  |
///
/// Tuple k of each array belongs to camera k.

namespace vantage
{

/// Writes the six arrays, replacing those that are there; none for an empty list.
VTKVANTAGEFILTERS_EXPORT void CamerasToFieldData(
  const std::vector<Camera>& cameras, vtkFieldData* fieldData);

/// Reads them back, bit for bit; an empty list when there is no CameraName.
/// \throw InputError when another of the arrays is missing or has not one tuple a camera.
VTKVANTAGEFILTERS_EXPORT std::vector<Camera> CamerasFromFieldData(vtkFieldData* fieldData);

/// What a vtkCamera sees in an image of the given width / height. A horizontal view angle is turned
/// into the vertical one. Clipping planes, view shear and window centre are ignored.
/// \throw InputError for a parallel projection.
VTKVANTAGEFILTERS_EXPORT Camera CameraFromVtk(vtkCamera* camera, double aspect);

/// Makes a vtkCamera look like the core's; its clipping range is left alone.
VTKVANTAGEFILTERS_EXPORT void CameraToVtk(const Camera& camera, vtkCamera* target);

} // namespace vantage
