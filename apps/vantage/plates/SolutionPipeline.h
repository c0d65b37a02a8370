#pragma once

#include "core/Solver.h"

#include <string>
#include <vtkNew.h>
#include <vtkSmartPointer.h>

class vtkAlgorithm;
class vtkImportanceDrivenShooting;
class vtkPolyData;
class vtkTransportSceneReader;

/// \file SolutionPipeline.h
/// vtkTransportSceneReader -> vtkImportanceDrivenShooting, solved further and further.

namespace vantage
{

/// Where a solution stands, to be drawn later.
struct SolutionState
{
  vtkSmartPointer<vtkPolyData> elements;     ///< port 0 of vtkImportanceDrivenShooting
  vtkSmartPointer<vtkPolyData> interactions; ///< port 1
  std::uint64_t steps = 0;                   ///< these four: since the camera was chosen
  std::uint64_t evaluations = 0;
  std::uint64_t rays = 0;
  double seconds = 0.0;
};

class SolutionPipeline
{
public:
  /// \throw Error when the scene cannot be read.
  SolutionPipeline(const std::string& scene, Method method);
  ~SolutionPipeline();

  /// Looks from there; keeps radiance and interactions.
  void SetCamera(const Camera& camera);

  /// Goes on until `steps` have been done since the camera was chosen, or until at most the part
  /// `error` is unshot. Steps of the initial phase do not count. \throw Error
  SolutionState SolveSteps(std::uint64_t steps);
  SolutionState SolveError(double error);

  /// Of the last solution. \pre there is one
  const Solver& GetSolver() const;

private:
  SolutionState Solve();

  vtkNew<vtkTransportSceneReader> Reader;
  vtkNew<vtkImportanceDrivenShooting> Shooting;
  StepReport Before; ///< when the camera was chosen
};

} // namespace vantage
