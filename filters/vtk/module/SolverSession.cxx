#include "SolverSession.h"

#include <algorithm>
#include <tuple>
#include <utility>

namespace vantage
{

namespace
{

// The structured bindings below name every field, so that a field which is added to one of the
// structs does not compile until somebody has decided what changing it means here.

auto KeyOf(const RefinementSettings& settings)
{
  const auto& [oracle, formFactor, power, shadow, minimumSize, maximumLevel] = settings;
  return std::tie(oracle, formFactor, power, shadow, minimumSize, maximumLevel);
}

auto KeyOf(const SolverSettings& settings)
{
  const auto& [method, granularity, refinement, accuracy, visibilityRays, viewRays, initial,
    importance, seed] = settings;
  return std::tuple_cat(
    std::tie(method, granularity, accuracy, visibilityRays, viewRays, initial, importance, seed),
    KeyOf(refinement));
}

auto KeyOf(const Camera& camera)
{
  const auto& [name, eye, lookAt, up, fieldOfView, aspect] = camera;
  return std::tie(eye, lookAt, up, fieldOfView, aspect);
}

auto KeyOf(const Material& material)
{
  const auto& [name, albedo, emission, specular, shininess, twoSided] = material;
  return std::tie(albedo, emission, specular, shininess, twoSided);
}

bool HaveEqualMaterials(const Scene& a, const Scene& b)
{
  return std::equal(a.materials.begin(), a.materials.end(), b.materials.begin(), b.materials.end(),
    [](const Material& x, const Material& y) { return KeyOf(x) == KeyOf(y); });
}

bool HaveEqualGeometry(const Scene& a, const Scene& b)
{
  const auto keyOf = [](const Scene& scene)
  {
    const auto& [vertices, indices, offsets, materialOfPolygon, materials, cameras] = scene;
    return std::tie(vertices, indices, offsets, materialOfPolygon);
  };
  return keyOf(a) == keyOf(b);
}

std::uint64_t StepsOf(const Solver& solver)
{
  return solver.History().empty() ? 0 : solver.History().back().step;
}

} // namespace

Solver& SolverSession::Prepare(
  Scene scene, const SolverSettings& settings, const Camera& camera, std::uint64_t steps)
{
  scene.Validate();
  settings.Validate();
  camera.Validate();
  const bool isRelit = !HaveEqualMaterials(scene, this->SceneKey);
  const bool isSame = this->Kept && KeyOf(settings) == KeyOf(this->SettingsKey) &&
                      HaveEqualGeometry(scene, this->SceneKey) &&
                      (!isRelit || this->Kept->CanTake(scene.materials));
  const bool isMoved = !isSame || KeyOf(camera) != KeyOf(this->CameraKey);
  this->Changed = isRelit || isMoved;
  const bool isBackwards = !this->Changed && this->StepsDone() > steps;

  // What throws below leaves the session without a solver, never with one that half fits its keys.
  std::unique_ptr<Solver> solver = std::move(this->Kept);
  if (!isSame || isBackwards)
  {
    solver = std::make_unique<Solver>(scene, settings);
    solver->SetCamera(camera);
    this->Changed = true;
  }
  else
  {
    if (isRelit)
    {
      solver->SetMaterials(scene.materials);
    }
    if (isMoved)
    {
      solver->SetCamera(camera);
    }
  }
  if (this->Changed)
  {
    this->FirstStep = StepsOf(*solver);
  }
  this->SceneKey = std::move(scene);
  this->SettingsKey = settings;
  this->CameraKey = camera;
  this->Kept = std::move(solver);
  return *this->Kept;
}

std::uint64_t SolverSession::StepsDone() const
{
  return StepsOf(*this->Kept) - this->FirstStep;
}

} // namespace vantage
