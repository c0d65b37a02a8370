#pragma once

#include "vtkPolyDataAlgorithm.h"
#include "vtkVantageFiltersModule.h"

#include <string>

/// Reads a scene to be lit: polygons, what they are made of, and cameras.
///
/// Input: none; the file FileName names. The suffix chooses the format:
/// - .obj, with its .mtl: Kd albedo, Ke emitted radiance, Ks and Ns a normalised Phong lobe;
/// - .vtp: polygons with any of the cell arrays below; the others are added with their defaults.
///
/// Output: vtkPolyData; the front of a polygon is the side its vertices run counter-clockwise on.
///
/// | cell array | type   | components | content                                   | default  |
/// |------------|--------|------------|-------------------------------------------|----------|
/// | Albedo     | double | 3          | reflected / incident flux, in [0, 1]      | 0.5      |
/// | Emission   | double | 3          | radiance of the front side, W m^-2 sr^-1  | 0        |
/// | Specular   | double | 3          | reflectance of a Phong lobe, in [0, 1]    | 0        |
/// | Shininess  | double | 1          | exponent of that lobe                     | 0        |
/// | TwoSided   | uchar  | 1          | 0: the back neither reflects nor emits    | 1        |
/// | MaterialId | int    | 1          | index of the material                     | by value |
///
/// Field data: the string array MaterialName, one value for each MaterialId; and of cameras, tuple
/// k belonging to camera k: CameraName (string), CameraEye, CameraLookAt, CameraUp (3 doubles
/// each), CameraFieldOfView (vertical, degrees) and CameraAspect (width / height). Other arrays of
/// a .vtp file are kept; its vertices and lines are dropped, triangle strips are an error.
///
/// Writing the output with vtkXMLPolyDataWriter and reading it again gives the same scene, bit for
/// bit, unless the writer is set to ASCII.
///
/// Errors: no or unknown FileName, unknown suffix, a file that cannot be read, and a scene that is
/// not valid (no polygons, albedo outside [0, 1], negative emission, numbers that are not finite).
class VTKVANTAGEFILTERS_EXPORT vtkTransportSceneReader : public vtkPolyDataAlgorithm
{
public:
  static vtkTransportSceneReader* New();
  vtkTypeMacro(vtkTransportSceneReader, vtkPolyDataAlgorithm)
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /// File to read, .obj or .vtp. Default: empty, which is an error.
  vtkSetStdStringFromCharMacro(FileName);
  vtkGetCharFromStdStringMacro(FileName);
  ///@}

protected:
  vtkTransportSceneReader();
  ~vtkTransportSceneReader() override;

  int RequestData(vtkInformation*, vtkInformationVector**, vtkInformationVector*) override;

private:
  vtkTransportSceneReader(const vtkTransportSceneReader&) = delete;
  void operator=(const vtkTransportSceneReader&) = delete;

  std::string FileName;
};
