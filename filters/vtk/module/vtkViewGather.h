#pragma once

#include "vtkImageAlgorithm.h"
#include "vtkVantageFiltersModule.h"

#include <memory>
#include <string>

class vtkCamera;
class vtkTransportSolution;

namespace vantage
{
struct Camera;
}

/// The picture of a solved scene, gathered once more at every pixel.
///
/// Light straight from the lamps is computed at the points that the pixels see, without noise, so
/// shadows have the sharpness they have; what other surfaces reflect is gathered at some of the
/// points and interpolated. The picture is therefore much better than the elements are, at any
/// resolution, and no display is needed.
///
/// Input: the vtkTransportSolution on port 3 of vtkImportanceDrivenShooting. A solution is a data
/// object of its own because arrays on the elements cannot carry what a gather needs; see there.
/// It may also be set with SetInputData: a copy stays valid whatever becomes of its source.
///
/// The view: a vtkCamera (SetCamera), else the camera of the scene that CameraName names, else the
/// one that the solution was made for. Its aspect ratio is that of the image. A goal-oriented
/// solution is fine only where the camera looks that it was made for, so give its aspect ratio to
/// the shooting filter, too.
///
/// Output: vtkImageData of Width x Height x 1, row 0 at the bottom, with the point arrays
///
/// | array      | components | type  | content                                                   |
/// |------------|------------|-------|-----------------------------------------------------------|
/// | Radiance   | 3          | float | mean over the pixel, W m^-2 sr^-1; the active scalars     |
/// | Irradiance | 3          | float | of the surfaces that it sees, W m^-2, mean over the pixel |
/// | ElementId  | 1          | id    | cell of port 0 that the pixel's centre sees; -1: none     |
/// | Depth      | 1          | float | its distance from the eye, scene units; infinite: nothing |
///
/// and the field arrays GatherErrorEstimate (1 double), the relative L1 error that the gather adds
/// to that of the solution, and ErrorEstimate (1), that of the picture as a whole. There is none of
/// the latter where it is not known: goal-oriented alone estimates it, and of the view only that it
/// was made for. A picture of that view that is wider than what was solved for is warned of.
///
/// Progress is reported, and AbortExecute looked at, between the phases of the gather; after an
/// abort the output is empty.
///
/// Works on as many threads as vtkSMPTools; the result does not depend on their number.
///
/// Errors: nothing solved yet, unknown camera, values out of range. The output is empty then.
class VTKVANTAGEFILTERS_EXPORT vtkViewGather : public vtkImageAlgorithm
{
public:
  static vtkViewGather* New();
  vtkTypeMacro(vtkViewGather, vtkImageAlgorithm)
  void PrintSelf(ostream& os, vtkIndent indent) override;

  /// Includes the camera.
  vtkMTimeType GetMTime() override;

  ///@{
  /// The view. When the camera changes the filter executes again. Default: none.
  virtual void SetCamera(vtkCamera*);
  vtkGetObjectMacro(Camera, vtkCamera);
  ///@}

  ///@{
  /// The view when there is no Camera: name of one of the scene's. Default: empty, the view that
  /// the solution was made for.
  vtkSetStdStringFromCharMacro(CameraName);
  vtkGetCharFromStdStringMacro(CameraName);
  ///@}

  ///@{
  /// Pixels, 1 .. 32768. Default: 512.
  vtkSetMacro(Width, int);
  vtkGetMacro(Width, int);
  ///@}

  ///@{
  /// Pixels, 1 .. 32768. Default: 512.
  vtkSetMacro(Height, int);
  vtkGetMacro(Height, int);
  ///@}

  ///@{
  /// Relative L1 error that the gather may add to that of the solution, 0.0005 .. 1. Default: 0.01.
  vtkSetMacro(Error, double);
  vtkGetMacro(Error, double);
  ///@}

  ///@{
  /// What the centre of each pixel sees, else the mean over the pixel. Default: off.
  vtkSetMacro(PixelCentres, bool);
  vtkGetMacro(PixelCentres, bool);
  vtkBooleanMacro(PixelCentres, bool);
  ///@}

  ///@{
  /// Of the directions of the gather; the same seed gives the same picture. Default: 1.
  vtkSetMacro(Seed, vtkTypeUInt64);
  vtkGetMacro(Seed, vtkTypeUInt64);
  ///@}

protected:
  vtkViewGather();
  ~vtkViewGather() override;

  int FillInputPortInformation(int port, vtkInformation* info) override;
  int RequestInformation(vtkInformation*, vtkInformationVector**, vtkInformationVector*) override;
  int RequestData(vtkInformation*, vtkInformationVector**, vtkInformationVector*) override;

private:
  vtkViewGather(const vtkViewGather&) = delete;
  void operator=(const vtkViewGather&) = delete;

  vantage::Camera CameraOf(vtkTransportSolution* solution) const;
  void Gather(vtkTransportSolution* solution, vtkImageData* output);

  vtkCamera* Camera = nullptr;
  std::string CameraName;
  int Width;
  int Height;
  double Error;
  bool PixelCentres;
  vtkTypeUInt64 Seed;
};
