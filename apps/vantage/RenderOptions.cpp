#include "RenderOptions.h"

#include "CommandLine.h"
#include "ImageFile.h"
#include "core/Error.h"
#include "io/AtomicFile.h"
#include "io/CameraFile.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <filesystem>
#include <limits>
#include <set>

namespace vantage
{

namespace
{

const std::string PathTracingName = "path-tracing";
/// Where neither steps nor error nor time is asked for.
constexpr double DefaultError = 0.01;

std::vector<std::string> AllMethodNames()
{
  std::vector<std::string> names = MethodNames();
  names.push_back(PathTracingName);
  return names;
}

void DeclareCamera(CLI::App& command, RenderOptions& options)
{
  command
    .add_option("--camera", options.view.names,
      "Name of one of the scene's cameras [the first]; given again: an image each, -0001 and so on")
    ->expected(1)
    ->take_all();
  command.add_option("--walk", options.walk, "File of cameras to go through, noted as in .obj");
  DeclareCameraOptions(command, options.view);
  command.add_option("--samples-per-pixel", options.samplesPerPixel,
    "Primary rays; of path-tracing, paths [4; 64 without --steps and --time]");
  command.add_flag("--pixel-centres", options.pixelCentres, "Primary rays through centres only");
  command.add_flag("--flat", options.flat, "One radiance an element, not interpolated");
  command.add_option("--exposure", options.toneMapping.exposure,
    "Of .png: radiance is multiplied by 2^EV [automatic, the first camera's]");
}

void DeclareSolver(CLI::App& command, RenderOptions& options)
{
  SolverSettings& solver = options.solver;
  RefinementSettings& refinement = solver.refinement;
  command.add_option("--method", options.method, Join(AllMethodNames()))->capture_default_str();
  command
    .add_option("--granularity", options.granularity, "What a step shoots: interaction, patch")
    ->capture_default_str();
  command.add_option("--oracle", options.oracle, "Of refinement: F, BF")->capture_default_str();
  command
    .add_option("--form-factor-tolerance", refinement.formFactorTolerance,
      "Largest classical form factor of an interaction")
    ->capture_default_str();
  command
    .add_option("--power-tolerance", refinement.powerTolerance,
      "Least part of the strongest emitter's power that is refined")
    ->capture_default_str();
  command
    .add_option("--shadow-tolerance", refinement.shadowTolerance,
      "The same for direct light at shadow boundaries")
    ->capture_default_str();
  command
    .add_option("--minimum-element-size", refinement.minimumElementSize,
      "Least edge, in square roots of the mean facet area")
    ->capture_default_str();
  command.add_option("--maximum-level", refinement.maximumLevel, "Splits below a patch")
    ->capture_default_str();
  command.add_option("--visibility-rays", solver.visibilityRays, "Of a partly visible pair")
    ->check(CLI::NonNegativeNumber)
    ->capture_default_str();
  command.add_option("--view-rays", solver.viewRays, "For the view importance")
    ->check(CLI::NonNegativeNumber)
    ->capture_default_str();
  command
    .add_flag("--importance,!--no-importance", solver.importance,
      "Goal-oriented: refine for the view, or for all surfaces alike")
    ->capture_default_str();
  command
    .add_flag("--initial-phase,!--no-initial-phase", solver.initialPhase,
      "Direct light of all emitters first")
    ->capture_default_str();
}

void DeclareBudget(CLI::App& command, RenderOptions& options)
{
  command.add_option("--steps", options.steps, "At most so many steps; of path-tracing, paths")
    ->check(CLI::NonNegativeNumber);
  command.add_option(
    "--error", options.error, "Stop at this relative error [0.01 without --steps and --time]");
  command.add_option("--time", options.seconds, "At most so many seconds of solving");
  command.add_option("--threads", options.threads, "0: all")->capture_default_str();
  command.add_option("--seed", options.solver.seed, "Of random numbers")
    ->check(CLI::NonNegativeNumber)
    ->capture_default_str();
}

/// Whether both names mean the same existing file.
bool IsSameFile(const std::string& a, const std::string& b)
{
  std::error_code error;
  return std::filesystem::equivalent(a, b, error);
}

} // namespace

bool RenderOptions::IsPathTracing() const
{
  return this->method == PathTracingName;
}

bool RenderOptions::IsGathered() const
{
  return this->method == NameOf(Method::GoalOriented);
}

void RenderOptions::Resolve()
{
  const std::vector<std::string> methods = AllMethodNames();
  if (std::find(methods.begin(), methods.end(), this->method) == methods.end())
  {
    throw UnknownNameError("method", this->method, Join(methods));
  }
  if (!this->IsPathTracing())
  {
    this->solver.method = MethodFromName(this->method);
  }
  this->solver.granularity = GranularityFromName(this->granularity);
  this->solver.refinement.oracle = RefinementOracleFromName(this->oracle);
  this->solver.Validate();
  this->MakeBudget().Validate();
  this->toneMapping.Validate();
  this->view.Validate();
  if (this->samplesPerPixel && *this->samplesPerPixel < 1)
  {
    throw InputError("--samples-per-pixel: it must be 1 or more; give for example 4");
  }
  if (this->threads < 0)
  {
    throw InputError("--threads: it must not be negative; give 0 for all");
  }
  if (this->IsPathTracing() && this->error)
  {
    throw InputError("--error: path-tracing does not stop at an error; give --steps or --time");
  }
  if (!this->walk.empty() && !this->view.names.empty())
  {
    throw InputError("--walk: it brings its own cameras; drop --camera");
  }
  if (this->IsPathTracing() && (this->view.names.size() > 1 || !this->walk.empty()))
  {
    throw InputError("path-tracing keeps nothing from camera to camera; give one --camera a run");
  }
  if (this->IsGathered() && (this->samplesPerPixel || this->flat))
  {
    throw InputError("--samples-per-pixel and --flat: the image of goal-oriented is gathered, not "
                     "drawn from elements; drop them or choose another --method");
  }
  if (this->IsGathered())
  {
    this->MakeGatherSettings(Camera()).Validate();
  }
  this->RequireOptionsOfTheMethod();
  this->CheckOutputs();
}

void RenderOptions::RequireOptionsOfTheMethod() const
{
  const RenderOptions usual;
  const RefinementSettings& asked = this->solver.refinement;
  const RefinementSettings& known = usual.solver.refinement;
  const bool areOfThePaper =
    this->granularity != usual.granularity || this->oracle != usual.oracle ||
    asked.formFactorTolerance != known.formFactorTolerance ||
    asked.powerTolerance != known.powerTolerance ||
    asked.shadowTolerance != known.shadowTolerance || !this->solver.initialPhase;
  if (this->IsGathered() && areOfThePaper)
  {
    throw InputError("--granularity, --oracle, --form-factor-tolerance, --power-tolerance, "
                     "--shadow-tolerance and --no-initial-phase: goal-oriented has no use for "
                     "them; drop them or choose another --method");
  }
  if (!this->IsGathered() && !this->irradiance.empty())
  {
    throw InputError("--irradiance: it is gathered with goal-oriented only; drop it or --method");
  }
  if (!this->IsGathered() && !this->solver.importance)
  {
    throw InputError("--no-importance: it is of goal-oriented; drop it, or choose "
                     "progressive-shooting as a method without importance");
  }
}

void RenderOptions::CheckOutputs() const
{
  std::vector<std::string> files = this->outputs;
  std::vector<std::string> suffixes = ImageSuffixes();
  suffixes.push_back(".vtp");
  bool hasElements = !this->links.empty() || !this->history.empty();
  for (const std::string& output : this->outputs)
  {
    RequireSuffix(output, suffixes);
    hasElements = hasElements || SuffixOf(output) == ".vtp";
  }
  if (this->IsPathTracing() && hasElements)
  {
    throw InputError("path-tracing has no elements, links and history; drop the .vtp, --links and "
                     "--history outputs or choose another --method");
  }
  const auto add = [&files](const std::string& file, const std::string& suffix)
  {
    if (!file.empty())
    {
      RequireSuffix(file, { suffix });
      files.push_back(file);
    }
  };
  add(this->irradiance, ".exr");
  add(this->links, ".vtp");
  add(this->history, ".csv");
  add(this->report, ".json");
  if (files.empty())
  {
    throw InputError("command line: there is no output; name one with -o, such as -o image.png");
  }
  std::set<std::string> seen;
  for (const std::string& file : files)
  {
    CheckWritable(file);
    if (IsSameFile(file, this->scene))
    {
      throw InputError(file + ": it would overwrite the scene; choose another output");
    }
    if (!seen.insert(std::filesystem::weakly_canonical(std::filesystem::absolute(file)).string())
           .second)
    {
      throw InputError(file + ": it is given twice as an output; choose another name");
    }
  }
}

bool RenderOptions::WantsImage() const
{
  return !this->irradiance.empty() ||
         std::any_of(this->outputs.begin(), this->outputs.end(),
           [](const std::string& output) { return SuffixOf(output) != ".vtp"; });
}

Budget RenderOptions::MakeBudget() const
{
  Budget budget;
  if (this->steps)
  {
    budget.steps = *this->steps;
  }
  if (this->seconds)
  {
    budget.seconds = *this->seconds;
  }
  budget.error = this->error.value_or(this->steps || this->seconds ? 0.0 : DefaultError);
  return budget;
}

ElementImageSettings RenderOptions::MakeImageSettings(const Camera& camera) const
{
  ElementImageSettings settings;
  const auto [width, height] = this->view.SizeOf(camera);
  settings.width = width;
  settings.height = height;
  settings.samplesPerPixel = this->samplesPerPixel.value_or(settings.samplesPerPixel);
  settings.pixelCentres = this->pixelCentres;
  settings.flat = this->flat;
  settings.seed = this->solver.seed;
  return settings;
}

GatherSettings RenderOptions::MakeGatherSettings(const Camera& camera) const
{
  const ElementImageSettings image = this->MakeImageSettings(camera);
  GatherSettings settings;
  settings.width = image.width;
  settings.height = image.height;
  settings.error =
    std::clamp(GatherShare * this->error.value_or(DefaultError), LeastGatherError, 1.0);
  settings.pixelCentres = this->pixelCentres;
  settings.seed = this->solver.seed;
  return settings;
}

double RenderOptions::ErrorOfElements() const
{
  const double wanted = this->error.value_or(DefaultError);
  return wanted > 0.0 ? std::min(wanted, 1.0) : DefaultError;
}

PathTracerSettings RenderOptions::MakePathTracerSettings() const
{
  PathTracerSettings settings;
  // The least of what is asked for; the default where nothing is.
  constexpr std::uint64_t noLimit = std::numeric_limits<int>::max();
  if (this->samplesPerPixel || this->steps || this->seconds)
  {
    const std::uint64_t samples = this->samplesPerPixel.value_or(noLimit);
    settings.samplesPerPixel =
      static_cast<int>(std::min({ samples, this->steps.value_or(noLimit), noLimit }));
  }
  settings.pixelCentres = this->pixelCentres;
  settings.seed = this->solver.seed;
  settings.seconds = this->seconds.value_or(settings.seconds);
  return settings;
}

std::vector<Camera> RenderOptions::ChooseCameras(const Scene& scene) const
{
  const bool isWalk = !this->walk.empty();
  return this->view.Choose(
    scene, this->scene, isWalk ? ReadCameras(this->walk) : std::vector<Camera>());
}

std::string RenderOptions::FramePath(const std::string& output, std::size_t k, std::size_t n)
{
  if (n == 1)
  {
    return output;
  }
  const std::string number = std::to_string(k + 1);
  const std::string suffix = SuffixOf(output);
  return output.substr(0, output.size() - suffix.size()) + "-" +
         std::string(number.size() < 4 ? 4 - number.size() : 0, '0') + number + suffix;
}

void DeclareRenderOptions(CLI::App& command, RenderOptions& options)
{
  command.add_option("SCENE", options.scene, "Scene (.obj, .vtp)")->required();
  command.add_option("-o,--output", options.outputs,
    "Image (.png tone-mapped, .exr, .vti radiance) or elements (.vtp)");
  command.add_option("--irradiance", options.irradiance,
    "Image of what arrives at the surfaces that pixels see (.exr, linear)");
  command.add_option("--links", options.links, "Interactions (.vtp)");
  command.add_option("--history", options.history, "A row a step (.csv)");
  command.add_option("--report", options.report, "Figures of the run (.json)");
  DeclareCamera(command, options);
  DeclareSolver(command, options);
  DeclareBudget(command, options);
  command.add_flag("--quiet", options.quiet, "No progress bar and no warnings");
}

} // namespace vantage
