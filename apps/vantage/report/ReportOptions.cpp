#include "report/ReportOptions.h"

#include "CommandLine.h"
#include "ImageFile.h"
#include "core/Error.h"
#include "io/TextLines.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cctype>
#include <cmath>
#include <functional>

namespace vantage
{

namespace
{

constexpr int DefaultHeight = 160; ///< pixels
constexpr int LeastSize = 8;
constexpr int MostSize = 4096;
constexpr int MostSamples = 1 << 20;

bool Contains(const std::vector<std::string>& names, const std::string& name)
{
  return std::find(names.begin(), names.end(), name) != names.end();
}

/// As a shell takes it for one word.
std::string Quoted(const std::string& word)
{
  const bool isPlain = !word.empty() && std::all_of(word.begin(), word.end(),
                                          [](unsigned char c) {
                                            return std::isalnum(c) != 0 || c == '.' || c == '/' ||
                                                   c == '-' || c == '_';
                                          });
  std::string quoted = "'";
  for (const char c : word)
  {
    quoted += c == '\'' ? std::string("'\\''") : std::string(1, c);
  }
  return isPlain ? word : quoted + "'";
}

/// Largest first, each once.
template <typename Number>
void SortDown(std::vector<Number>& numbers)
{
  std::sort(numbers.begin(), numbers.end(), std::greater<>());
  numbers.erase(std::unique(numbers.begin(), numbers.end()), numbers.end());
}

template <typename Number>
void RequireRange(
  const std::string& option, const std::vector<Number>& numbers, double above, double most)
{
  for (const Number number : numbers)
  {
    if (!(number > above && number <= most))
    {
      throw InputError(option + ": " + PrintNumber(number) +
                       " is out of range; give numbers above " + PrintNumber(above) +
                       " and up to " + PrintNumber(most));
    }
  }
}

/// " --option a b c".
template <typename Values>
std::string PrintOption(const std::string& option, const Values& values)
{
  std::string text = " " + option;
  for (const double value : values)
  {
    text += ' ' + PrintNumber(value);
  }
  return text;
}

} // namespace

std::vector<std::string> ReportMethodNames()
{
  std::vector<std::string> names = MethodNames();
  names.push_back(PathTracingName);
  return names;
}

void ReportOptions::Resolve()
{
  const std::vector<std::string> known = ReportMethodNames();
  for (const std::string& method : this->methods)
  {
    if (!Contains(known, method))
    {
      throw UnknownNameError("method", method, Join(known));
    }
  }
  RequireRange("--errors", this->errors, 0.0, 1.0);
  RequireRange("--power-tolerances", this->powerTolerances, 0.0, 1.0);
  RequireRange("--samples", this->samples, 0, MostSamples);
  RequireRange("--time", std::vector<double>{ this->seconds }, 0.0, 1e6);
  RequireRange("--threads", std::vector<int>{ this->threads }, -1, 4096);
  if (this->size)
  {
    RequireRange(
      "--size", std::vector<int>{ (*this->size)[0], (*this->size)[1] }, LeastSize - 1, MostSize);
  }
  if (!this->reference.empty())
  {
    RequireSuffix(this->reference, { ".exr", ".vti" });
  }
  SortDown(this->errors);
  SortDown(this->powerTolerances);
  SortDown(this->samples);
  std::reverse(this->samples.begin(), this->samples.end());
  this->threads = static_cast<int>(ThreadsFor(this->threads));
}

std::array<int, 2> ReportOptions::SizeFor(const Camera& given) const
{
  return this->size.value_or(std::array<int, 2>{
    std::max(1, static_cast<int>(std::lround(DefaultHeight * given.aspect))), DefaultHeight });
}

Camera ReportOptions::ChooseCamera(const Scene& given) const
{
  if (given.cameras.empty())
  {
    throw InputError(this->scene + ": it has no camera; a report needs one in the scene");
  }
  Camera chosen = this->camera.empty() ? given.cameras.front() : given.FindCamera(this->camera);
  const std::array<int, 2> pixels = this->SizeFor(chosen);
  chosen.aspect = static_cast<double>(pixels[0]) / pixels[1];
  chosen.Validate();
  return chosen;
}

std::vector<RunPlan> ReportOptions::MakePlans() const
{
  const std::vector<std::string> onFixedGraph = FixedGraphMethodNames();
  std::vector<RunPlan> plans;
  for (const std::string& method : ReportMethodNames())
  {
    if (!Contains(this->methods, method))
    {
      continue;
    }
    RunPlan plan;
    plan.method = method;
    plan.budgets = this->errors;
    plan.seconds = this->seconds;
    plan.seed = this->seed;
    plan.threads = static_cast<std::size_t>(this->threads);
    if (method == PathTracingName)
    {
      plan.budgets.assign(this->samples.begin(), this->samples.end());
    }
    if (!Contains(onFixedGraph, method))
    {
      plans.push_back(plan);
      continue;
    }
    for (const double tolerance : this->powerTolerances)
    {
      plan.powerTolerance = tolerance;
      plans.push_back(plan);
    }
  }
  return plans;
}

std::string ReportOptions::CommandLine(const Target& target) const
{
  std::vector<std::string> methods;
  for (const RunPlan& plan : this->MakePlans())
  {
    if (!Contains(methods, plan.method))
    {
      methods.push_back(plan.method);
    }
  }
  std::string text = "vantage report " + Quoted(this->scene) + " -o " + Quoted(this->folder) +
                     " --camera " + Quoted(target.camera.name) + " --size " +
                     std::to_string(target.width) + ' ' + std::to_string(target.height) +
                     " --methods";
  for (const std::string& method : methods)
  {
    text += ' ' + method;
  }
  text += PrintOption("--errors", this->errors) +
          PrintOption("--power-tolerances", this->powerTolerances) +
          PrintOption("--samples", this->samples) + " --time " + PrintNumber(this->seconds) +
          " --threads " + std::to_string(this->threads) + " --seed " + std::to_string(this->seed);
  text +=
    this->referenceFolder.empty() ? "" : " --reference-folder " + Quoted(this->referenceFolder);
  return text + (this->reference.empty() ? "" : " --reference " + Quoted(this->reference));
}

void DeclareReportOptions(CLI::App& command, ReportOptions& options)
{
  command.add_option("SCENE", options.scene, "Scene with a camera (.obj, .vtp)")->required();
  command.add_option("-o,--output", options.folder, "Folder to write into")->required();
  command.add_option("--camera", options.camera, "Name of one of the scene's cameras [the first]");
  command.add_option("--size", options.size, "Pixels W H [height 160]");
  command.add_option("--methods", options.methods, Join(ReportMethodNames()) + " [all]");
  command
    .add_option("--errors", options.errors,
      "Asked errors: goal-oriented of the picture; else the part unshot, and of the gather")
    ->capture_default_str();
  command
    .add_option(
      "--power-tolerances", options.powerTolerances, "Of methods on a fixed graph, a run each")
    ->capture_default_str();
  command.add_option("--samples", options.samples, "A pixel, of path-tracing")
    ->capture_default_str();
  command
    .add_option("--time", options.seconds, "At most so many processor seconds of solving, each run")
    ->capture_default_str();
  command.add_option("--reference", options.reference,
    "Image of radiance at pixel centres to judge by (.exr, .vti) [one is made]");
  command.add_option("--reference-folder", options.referenceFolder,
    "Where references are kept for other reports [references in the output folder]");
  command.add_option("--threads", options.threads, "Of what is measured; 0: all")
    ->capture_default_str();
  command.add_option("--seed", options.seed, "Of random numbers")
    ->check(CLI::NonNegativeNumber)
    ->capture_default_str();
  command.add_flag("--quiet", options.quiet, "No progress bar, no warnings and no table");
}

} // namespace vantage
