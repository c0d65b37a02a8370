#pragma once

#include "vtkDataSetAlgorithm.h"
#include "vtkVantageFiltersModule.h"

#include <string>

/// Turns radiance into what a screen shows.
///
/// Input: any vtkDataSet (image, polygons, ...) with an array of linear radiance, W m^-2 sr^-1, as
/// point data, cell data or both: named ArrayName, 3 components (red, green, blue of Rec. 709) or 1
/// for grey.
///
/// Output: the input, and beside each such array `RGB`: 3 unsigned char, coded as sRGB, and made
/// the active scalars. When both point and cell data have the array they share one exposure, found
/// from the cells.
///
/// Photographic tone reproduction: after exposure, luminance L becomes L (1 + L / White^2) / (1 +
/// L). Automatic exposure takes the log-average luminance to 0.18; black and infinite values do not
/// count. What is not a number becomes black.
///
/// Errors: no such array, another number of components, Exposure not finite, White not above 0.
///
/// Reference: E. Reinhard, M. Stark, P. Shirley, J. Ferwerda, Photographic tone reproduction for
/// digital images (SIGGRAPH 2002).
class VTKVANTAGEFILTERS_EXPORT vtkRadianceToneMapping : public vtkDataSetAlgorithm
{
public:
  static vtkRadianceToneMapping* New();
  vtkTypeMacro(vtkRadianceToneMapping, vtkDataSetAlgorithm)
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /// Array to map. Default: "Radiance".
  vtkSetStdStringFromCharMacro(ArrayName);
  vtkGetCharFromStdStringMacro(ArrayName);
  ///@}

  ///@{
  /// Find the exposure from the radiance. Default: on.
  vtkSetMacro(AutomaticExposure, bool);
  vtkGetMacro(AutomaticExposure, bool);
  vtkBooleanMacro(AutomaticExposure, bool);
  ///@}

  ///@{
  /// Without AutomaticExposure: radiance is multiplied by 2^Exposure. Default: 0.
  vtkSetMacro(Exposure, double);
  vtkGetMacro(Exposure, double);
  ///@}

  ///@{
  /// Luminance, after exposure, that becomes pure white, > 0. Default: 2.
  vtkSetMacro(White, double);
  vtkGetMacro(White, double);
  ///@}

protected:
  vtkRadianceToneMapping();
  ~vtkRadianceToneMapping() override;

  int RequestInformation(vtkInformation*, vtkInformationVector**, vtkInformationVector*) override;
  int RequestData(vtkInformation*, vtkInformationVector**, vtkInformationVector*) override;

private:
  vtkRadianceToneMapping(const vtkRadianceToneMapping&) = delete;
  void operator=(const vtkRadianceToneMapping&) = delete;

  void MapArrays(vtkDataSet* output) const;

  std::string ArrayName = "Radiance";
  bool AutomaticExposure = true;
  double Exposure = 0.0;
  double White;
};
