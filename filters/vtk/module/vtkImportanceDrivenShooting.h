#pragma once

#include "vtkPolyDataAlgorithm.h"
#include "vtkVantageFiltersModule.h"

#include <memory>
#include <string>

class vtkCamera;

namespace vantage
{
class Solver;
struct ElementSolution;
} // namespace vantage

/// Solves the light of a scene for one view: radiance and importance travel over the same
/// interactions.
///
/// Goal-oriented, the default, makes interactions between clusters, patches and elements on demand
/// and refines, in each step, those with the largest part in the error of the view. The methods of
/// the paper shoot on a fixed graph: importance-shooting propagates in every step what is largest
/// of (unshot radiance) x (throughput) x (importance of the receiver). Light that the view does not
/// need is left for later, or for good. On the same graph importance-gathering gathers it where it
/// changes the view most (Smits et al. 1992). The solution continues where the last execution
/// stopped, and an interaction, once computed, is kept when the camera moves or the lights change.
///
/// Input: vtkPolyData with polygons (others are ignored; triangle strips are an error). Two cell
/// arrays are chosen with SetInputArrayToProcess: 0 is the albedo ("Albedo" unless chosen; 3
/// components or 1 for grey; 0.5 when there is no such array), 1 the emitted radiance of the front
/// side, W m^-2 sr^-1 ("Emission"; 0). An array that was chosen by another name must be there. The
/// cell arrays TwoSided and MaterialId and the cameras in field data are used as
/// vtkTransportSceneReader writes them. All surfaces are computed as diffuse: that Specular is left
/// out is warned of. Polygons with equal values are one material.
///
/// The view: a vtkCamera (SetCamera), else the camera of the input that CameraName names, else
/// EyePosition, FocalPoint, ViewUp and ViewAngle. A vtkCamera has no aspect ratio: Aspect gives it.
///
/// Output port 0, vtkPolyData: the elements. Doubles unless said otherwise. The back of a one-sided
/// polygon has none, nor has the inside of a closed body without a lamp: no light gets there.
///
/// | cell array       | components | unit         | content                                      |
/// |------------------|------------|--------------|----------------------------------------------|
/// | Radiance         | 3          | W m^-2 sr^-1 | leaving the element, emission included       |
/// | Irradiance       | 3          | W m^-2       | arriving; of goal-oriented only              |
/// | UnshotRadiance   | 3          | W m^-2 sr^-1 | its part that is not yet propagated          |
/// | Importance       | 3          | sr m^-2      | what light here means for the view           |
/// | UnshotImportance | 3          | sr m^-2      | part of albedo x importance not propagated   |
/// | ViewImportance   | 1          | sr m^-2      | importance straight from the eye             |
/// | Albedo           | 3          | 1            | of the input                                 |
/// | Emission         | 3          | W m^-2 sr^-1 | of the input, on the side that emits         |
/// | PatchId          | 1 (id)     |              | one side of one flat polygon                 |
/// | InputCellId      | 1 (id)     |              | the polygon it comes from, among polygons    |
/// | Side             | 1 (uchar)  |              | 0 front, 1 back                              |
/// | Level            | 1 (int)    |              | subdivisions below the patch                 |
///
/// Point array: Radiance (3), for smooth shading. Goal-oriented gathers it, on elements that are
/// split further where the view sees light that varies, so that shadows have their edges in a plain
/// render too, and Irradiance (3) with it; the field array ErrorEstimate (1) then is the relative
/// L1 error of the picture that the points give. Else it is the mean of the elements around a
/// point, as it is where the view does not see a point. Field data of the input are passed on.
///
/// Output port 1, vtkPolyData: a line for each interaction, with the cell arrays Shooter, Receiver
/// (PatchId of the ends; -1: a cluster of patches), ShooterLevel, ReceiverLevel (-1 of a cluster),
/// FormFactor (sr: pi times the classical one, visibility included), Visibility (visible fraction),
/// ShotFlux (W, both directions), Contribution (W m^-2, of the shot flux to the view flux) and Step
/// (in which it was made).
///
/// Output port 2, vtkTable: a row for each step, with the columns Step, Phase (string), Patch (-1:
/// none), ViewFlux, UnshotViewFlux (W m^-2), UnshotPower (W), ErrorEstimate, Elements,
/// Interactions, Evaluations, Rays and Seconds, and a column for each counter of work.
///
/// Output port 3, vtkTransportSolution: the solution, from which vtkViewGather makes pictures.
///
/// The outputs hold copies: they stay valid when the filter is gone.
///
/// Stopping: at the first of Steps, Error, TimeLimit that is met, or when nothing is left to do.
/// Progress is reported, and AbortExecute looked at, after each step; what was done until then is
/// in the output, its points not gathered. Works on as many threads as vtkSMPTools; the result does
/// not depend on their number.
///
/// What a change costs: more Steps, another Error or TimeLimit continue. Another view keeps
/// radiance and interactions. Other albedos and emissions keep the interactions, as long as the
/// same polygons share materials (give them MaterialId to be sure). Fewer Steps than were done, any
/// other parameter and other polygons start anew.
///
/// Errors: values out of range, unknown names, a scene that is not valid, and light that grows
/// without end (albedo 1 in a closed scene).
///
/// Reference: Ph. Bekaert and Y. D. Willems, A progressive importance-driven rendering algorithm
/// (1995).
class VTKVANTAGEFILTERS_EXPORT vtkImportanceDrivenShooting : public vtkPolyDataAlgorithm
{
public:
  static vtkImportanceDrivenShooting* New();
  vtkTypeMacro(vtkImportanceDrivenShooting, vtkPolyDataAlgorithm)
  void PrintSelf(ostream& os, vtkIndent indent) override;

  /// Includes the camera.
  vtkMTimeType GetMTime() override;

  /// What is solved after Update(), for what the outputs do not tell, such as images. Belongs to
  /// the filter; null when it has not executed yet.
  const vantage::Solver* GetSolver() const;

  ///@{
  /// The view. When the camera changes the filter executes again. Default: none.
  virtual void SetCamera(vtkCamera*);
  vtkGetObjectMacro(Camera, vtkCamera);
  ///@}

  ///@{
  /// The view when there is no Camera: name of one in the input's field data; its own aspect ratio
  /// is used. Default: empty, use the numbers below.
  vtkSetStdStringFromCharMacro(CameraName);
  vtkGetCharFromStdStringMacro(CameraName);
  ///@}

  ///@{
  /// The view when there are neither Camera nor CameraName: position of the eye, scene units.
  /// Default: (0, 0, 0).
  vtkSetVector3Macro(EyePosition, double);
  vtkGetVector3Macro(EyePosition, double);
  ///@}

  ///@{
  /// Point in the middle of the image. Default: (0, 0, -1).
  vtkSetVector3Macro(FocalPoint, double);
  vtkGetVector3Macro(FocalPoint, double);
  ///@}

  ///@{
  /// Upward direction. Default: (0, 1, 0).
  vtkSetVector3Macro(ViewUp, double);
  vtkGetVector3Macro(ViewUp, double);
  ///@}

  ///@{
  /// Vertical angle of view, degrees, in (0, 180). Default: 45.
  vtkSetMacro(ViewAngle, double);
  vtkGetMacro(ViewAngle, double);
  ///@}

  ///@{
  /// Width / height of the image, > 0; also used with Camera. Default: 1.
  vtkSetMacro(Aspect, double);
  vtkGetMacro(Aspect, double);
  ///@}

  ///@{
  /// "goal-oriented", "importance-shooting", "progressive-shooting", "basic-shooting",
  /// "gauss-seidel" or "importance-gathering". Default: "goal-oriented".
  vtkSetStdStringFromCharMacro(Method);
  vtkGetCharFromStdStringMacro(Method);
  ///@}

  ///@{
  /// What a step shoots: one "interaction", or all of one "patch". Default: "patch".
  vtkSetStdStringFromCharMacro(Granularity);
  vtkGetCharFromStdStringMacro(Granularity);
  ///@}

  ///@{
  /// Steps to have been done in all since the scene, the view or a setting changed, >= 0. A larger
  /// number continues, one below what was done starts anew. Default: VTK_ID_MAX, no limit.
  vtkSetMacro(Steps, vtkIdType);
  vtkGetMacro(Steps, vtkIdType);
  ///@}

  ///@{
  /// Stop at this error, >= 0. Goal-oriented: relative L1 error of a gathered picture, as
  /// estimated, of which the gather (vtkViewGather) may take its part. Others: the part of the view
  /// flux (of the power, for methods without importance) that is unshot; 0 goes on to round-off. A
  /// larger value does not undo what is done. Default: 0.01.
  vtkSetMacro(Error, double);
  vtkGetMacro(Error, double);
  ///@}

  ///@{
  /// Longest time one execution may take to shoot, seconds, > 0; the next one continues. The result
  /// then depends on the speed of the machine. Default: infinity.
  vtkSetMacro(TimeLimit, double);
  vtkGetMacro(TimeLimit, double);
  ///@}

  ///@{
  /// What decides whether an interaction is fine enough: "F", the form factor alone, or "BF", the
  /// form factor weighted by the power to be carried. Default: "BF".
  vtkSetStdStringFromCharMacro(RefinementOracle);
  vtkGetCharFromStdStringMacro(RefinementOracle);
  ///@}

  ///@{
  /// Largest classical form factor an interaction may have without being refined, (0, 1].
  /// Default: 0.1.
  vtkSetMacro(FormFactorTolerance, double);
  vtkGetMacro(FormFactorTolerance, double);
  ///@}

  ///@{
  /// BF: an interaction about to carry less than this part of the power of the strongest emitter is
  /// not refined, >= 0. Default: 3e-4.
  vtkSetMacro(PowerTolerance, double);
  vtkGetMacro(PowerTolerance, double);
  ///@}

  ///@{
  /// BF: the same for direct light that is partly visible, >= 0. Default: 1e-4.
  vtkSetMacro(ShadowTolerance, double);
  vtkGetMacro(ShadowTolerance, double);
  ///@}

  ///@{
  /// Elements are not split below this edge length, relative to the square root of the mean polygon
  /// area, > 0. Default: 0.05.
  vtkSetMacro(MinimumElementSize, double);
  vtkGetMacro(MinimumElementSize, double);
  ///@}

  ///@{
  /// Most subdivisions of a patch, 0 .. 20. Default: 10.
  vtkSetMacro(MaximumLevel, int);
  vtkGetMacro(MaximumLevel, int);
  ///@}

  ///@{
  /// Of form factors: "default" (relative error 1e-5 unoccluded) or "reference" (1e-8).
  /// Default: "default".
  vtkSetStdStringFromCharMacro(Accuracy);
  vtkGetCharFromStdStringMacro(Accuracy);
  ///@}

  ///@{
  /// Rays for a pair of elements that is partly visible, 1 .. 1024. Default: 16.
  vtkSetMacro(VisibilityRays, unsigned int);
  vtkGetMacro(VisibilityRays, unsigned int);
  ///@}

  ///@{
  /// Rays cast through the image to find what the eye sees, >= 1. Default: 16384.
  vtkSetMacro(ViewRays, unsigned int);
  vtkGetMacro(ViewRays, unsigned int);
  ///@}

  ///@{
  /// Methods without importance: shoot direct light of all emitters first, and subdivide at shadow
  /// boundaries. Default: on.
  vtkSetMacro(InitialPhase, bool);
  vtkGetMacro(InitialPhase, bool);
  vtkBooleanMacro(InitialPhase, bool);
  ///@}

  ///@{
  /// Goal-oriented: refine for the view; off, for all surfaces alike. Default: on.
  vtkSetMacro(Importance, bool);
  vtkGetMacro(Importance, bool);
  vtkBooleanMacro(Importance, bool);
  ///@}

  ///@{
  /// Goal-oriented: split the elements of port 0 where the view sees light that varies, and gather
  /// the light of their points, to Error (1 % where that is 0). Takes about as long as a picture
  /// does; off, port 0 has the elements as they were solved on. Default: on.
  vtkSetMacro(GatherPoints, bool);
  vtkGetMacro(GatherPoints, bool);
  vtkBooleanMacro(GatherPoints, bool);
  ///@}

  ///@{
  /// Of the random numbers; the same seed gives the same result. Default: 1.
  vtkSetMacro(Seed, vtkTypeUInt64);
  vtkGetMacro(Seed, vtkTypeUInt64);
  ///@}

protected:
  vtkImportanceDrivenShooting();
  ~vtkImportanceDrivenShooting() override;

  int FillOutputPortInformation(int port, vtkInformation* info) override;
  vtkTypeBool ProcessRequest(
    vtkInformation*, vtkInformationVector**, vtkInformationVector*) override;
  int RequestData(vtkInformation*, vtkInformationVector**, vtkInformationVector*) override;

private:
  vtkImportanceDrivenShooting(const vtkImportanceDrivenShooting&) = delete;
  void operator=(const vtkImportanceDrivenShooting&) = delete;

  void Solve(vtkPolyData* input);
  vantage::ElementSolution ShowElements(vtkPolyData* elements);
  vtkDataArray* ChosenArray(int index, const char* usualName, vtkPolyData* input);

  vtkCamera* Camera = nullptr;
  std::string CameraName;
  double EyePosition[3];
  double FocalPoint[3];
  double ViewUp[3];
  double ViewAngle;
  double Aspect;
  std::string Method;
  std::string Granularity;
  vtkIdType Steps;
  double Error;
  double TimeLimit;
  std::string RefinementOracle;
  double FormFactorTolerance;
  double PowerTolerance;
  double ShadowTolerance;
  double MinimumElementSize;
  int MaximumLevel;
  std::string Accuracy = "default";
  unsigned int VisibilityRays;
  unsigned int ViewRays;
  bool InitialPhase;
  bool Importance;
  bool GatherPoints = true;
  vtkTypeUInt64 Seed;

  struct Implementation;
  std::unique_ptr<Implementation> Impl;
};
