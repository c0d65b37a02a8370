#pragma once

#include "core/Solver.h"
#include "vtkVantageFiltersModule.h"

#include <cstdint>
#include <memory>

/// \file SolverSession.h
/// A solver that outlives the executions of a filter.

namespace vantage
{

/// Keeps a solver and the keys of what it has been given, and redoes only what a change asks for:
///
/// - nothing, or more steps asked for: the solver continues
/// - the camera: Solver::SetCamera, interactions stay
/// - albedo, emission or lobe of materials: Solver::SetMaterials, interactions stay
/// - vertices, polygons, which polygons share a material, sidedness, a lamp inside a closed body:
///   a new solver
/// - any setting: a new solver
/// - fewer steps asked for than were done: a new solver
///
/// The keys hold every number the solver sees; names are left out.
class VTKVANTAGEFILTERS_EXPORT SolverSession
{
public:
  /// The solver for what is asked, made or changed as far as needed. Steps count from the last
  /// change (a row of the initial phase is not a step). \throw InputError for a bad scene, settings
  /// or camera; the solver of the last call is kept.
  Solver& Prepare(
    Scene scene, const SolverSettings& settings, const Camera& camera, std::uint64_t steps);

  /// The solver of the last call. \pre Prepare() has succeeded
  const Solver& Current() const { return *this->Kept; }

  /// The same, or null when there is none.
  const Solver* Find() const { return this->Kept.get(); }

  /// The camera of the last call. \pre Prepare() has succeeded
  const Camera& CurrentCamera() const { return this->CameraKey; }

  /// Steps done since the last change. \pre Prepare() has succeeded
  std::uint64_t StepsDone() const;

  /// True when the last Prepare() made a new solver or changed the one it had.
  bool HasChanged() const { return this->Changed; }

  /// Forgets the solver.
  void Reset() { this->Kept.reset(); }

private:
  std::unique_ptr<Solver> Kept;
  Scene SceneKey;
  SolverSettings SettingsKey;
  Camera CameraKey;
  std::uint64_t FirstStep = 0; ///< steps the solver had done at the last change
  bool Changed = false;
};

} // namespace vantage
