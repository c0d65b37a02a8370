#include "CommandLine.h"
#include "ImageFile.h"
#include "ProgressBar.h"
#include "SceneFile.h"
#include "TextTable.h"
#include "VtkFile.h"
#include "core/Error.h"
#include "core/view/ToneMapping.h"
#include "io/AtomicFile.h"
#include "io/ReferenceCache.h"
#include "plates/OffscreenDisplay.h"
#include "report/Interruption.h"
#include "report/Provenance.h"
#include "report/ReportFigures.h"
#include "report/ReportOptions.h"
#include "report/ReportPage.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <iostream>
#include <memory>
#include <tbb/global_control.h>
#include <vtkImageData.h>

namespace vantage
{

namespace
{

namespace fs = std::filesystem;

/// The part of the whole work that the reference is taken for.
constexpr double ReferencePart = 0.2;

ReferenceSettings ReferenceSettingsFor(int height)
{
  ReferenceSettings settings;
  settings.size = height;
  settings.gatherRays = 1024; // more where the noise asks for them
  return settings;
}

/// In a scene without a solution, references would have no end.
void RequireSolution(const Target& target, bool quiet)
{
  Solver probe(target.scene);
  probe.SetCamera(target.camera);
  Budget none;
  none.steps = 0;
  probe.Run(none);
  if (!quiet)
  {
    PrintWarnings(probe.Warnings());
  }
}

void RequireLight(const Image& reference)
{
  for (const Color& pixel : reference.pixels)
  {
    if (MaxChannel(pixel) > 0.0)
    {
      return;
    }
  }
  throw InputError("reference: it is black, so that no error is relative to it; choose a view that "
                   "sees light");
}

Image ReadReference(const std::string& path, const Target& target)
{
  const Image image = ReadImage(path);
  if (image.width != target.width || image.height != target.height)
  {
    throw InputError(path + ": it has " + std::to_string(image.width) + " x " +
                     std::to_string(image.height) + " pixels, the pictures " +
                     std::to_string(target.width) + " x " + std::to_string(target.height) +
                     "; give another --size or --reference");
  }
  return image;
}

/// Makes a report, run by run.
class Reporter
{
public:
  explicit Reporter(const ReportOptions& options)
    : Options(options)
    , Bar(!options.quiet)
  {
    this->Goal.scene = this->ReadSceneWithWarnings();
    this->Goal.camera = options.ChooseCamera(this->Goal.scene);
    const auto [width, height] = options.SizeFor(this->Goal.camera);
    this->Goal.width = width;
    this->Goal.height = height;
    PrepareFolder(options.folder);
    CheckWritable(this->PathOf(PageFile));
    RequireSolution(this->Goal, options.quiet);
  }

  int Make()
  {
    try
    {
      this->TakeReference();
      this->Report.plans = this->Options.MakePlans();
      const RunStore store(this->PathOf("runs"), this->Goal.identity);
      this->RunAll(store);
      WriteReport(this->Display, this->Goal, this->Report, store, this->Options.folder);
    }
    catch (const Interrupted&)
    {
      return this->GiveUp();
    }
    return 0;
  }

  void Print() const
  {
    const auto isNumber = [](std::size_t column) { return column > 0; };
    std::cout << this->Kept << " of " << this->Report.plans.size() << " runs were there already\n"
              << AlignTable(MakeSecondsTable(this->Report), isNumber)
              << "With methods of the paper shown by their elements:\n"
              << AlignTable(MakeSecondsTable(this->Report, true), isNumber)
              << this->PathOf(PageFile) << '\n';
  }

private:
  std::string PathOf(const std::string& name) const
  {
    return (fs::path(this->Options.folder) / name).string();
  }

  Scene ReadSceneWithWarnings() const
  {
    std::vector<std::string> warnings;
    Scene scene = ReadScene(this->Options.scene, &warnings);
    if (!this->Options.quiet)
    {
      PrintWarnings(warnings);
    }
    return scene;
  }

  void TakeReference()
  {
    Target& goal = this->Goal;
    const ReferenceSettings settings = ReferenceSettingsFor(goal.height);
    goal.identity = ProgramVersion() + "; view " +
                    std::to_string(ReferenceKey(goal.scene, goal.camera, settings));
    if (!this->Options.reference.empty())
    {
      goal.reference = ReadReference(this->Options.reference, goal);
      goal.identity += "; reference " + HashOfImage(goal.reference);
      this->Report.referenceNote = "The reference is " + this->Options.reference +
                                   "; how noisy that is, this program does not know.";
    }
    else
    {
      const std::string folder = this->Options.referenceFolder.empty()
                                   ? this->PathOf("references")
                                   : this->Options.referenceFolder;
      const ReferenceImage reference = CachedReference(folder,
        fs::path(this->Options.scene).stem().string(), goal.scene, goal.camera, settings,
        [this](double part) { this->Progress(ReferencePart * part, "reference"); });
      goal.reference = reference.image;
      goal.noise = reference.noise;
      this->Report.referenceNote =
        "The reference has its direct light in closed form, past all occluders, and its indirect "
        "light from a gather into radiosity by collocation; it owes nothing to the methods that "
        "are judged. Its own noise is " +
        TwoDigits(100.0 * goal.noise) +
        " %, from two independent halves: errors of that size are its own.";
    }
    RequireLight(goal.reference);
    goal.exposure = AutomaticExposure(goal.reference.pixels);
  }

  void Progress(double part, const std::string& what)
  {
    this->Watch.Check();
    this->Bar.Update(part, what);
  }

  void RunAll(const RunStore& store)
  {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism,
      static_cast<std::size_t>(this->Options.threads));
    this->Report.scene = fs::path(this->Options.scene).filename().string();
    this->Report.command = this->Options.CommandLine(this->Goal);
    for (const RunPlan& plan : this->Report.plans)
    {
      std::optional<RunRecord> record = store.Find(plan);
      if (record && record->isFinished)
      {
        ++this->Kept;
        this->Report.records.push_back(*record);
        continue;
      }
      this->Report.records.push_back(store.NewRecord(plan));
      this->Run(plan, store, this->Report.records.back());
    }
  }

  /// Whether the interactions of that run are drawn: of those of its method the one that is as
  /// accurate as users have it.
  bool IsExample(const RunPlan& plan) const
  {
    const double usual = RefinementSettings().powerTolerance;
    const auto distance = [usual](const RunPlan& p)
    { return std::abs(std::log(p.powerTolerance.value_or(usual) / usual)); };
    return std::none_of(this->Report.plans.begin(), this->Report.plans.end(),
      [&](const RunPlan& other)
      { return other.method == plan.method && distance(other) < distance(plan); });
  }

  void Run(const RunPlan& plan, const RunStore& store, RunRecord& record)
  {
    const double runs = static_cast<double>(this->Report.plans.size());
    const double before = static_cast<double>(this->Report.records.size() - 1);
    RunObserver observer;
    observer.progressed = [&](double part)
    {
      const double done = ReferencePart + (1.0 - ReferencePart) * (before + part) / runs;
      this->Progress(done, plan.Title());
    };
    observer.measured = [&](Measurement m, const Image& image)
    {
      const std::string number = std::to_string(record.measurements.size() + 1);
      m.image = store.PictureName(plan, number);
      m.differenceImage = store.PictureName(plan, number + "-difference");
      WritePicture(this->Goal, image, store.PathOf(m.image));
      WriteDifference(this->Goal, image, store.PathOf(m.differenceImage));
      record.measurements.push_back(m);
      store.Save(plan, record);
      this->Watch.Check();
    };
    observer.solved = [&](const Solver& solver)
    {
      if (this->IsExample(plan))
      {
        this->Keep(this->Painter.Draw(solver), plan, store, record);
      }
    };
    RunMethod(this->Goal, plan, observer);
    record.isFinished = true;
    store.Save(plan, record);
  }

  void Keep(const InteractionFigure& figure, const RunPlan& plan, const RunStore& store,
    RunRecord& record) const
  {
    if (figure.image)
    {
      record.interactionImage = store.PictureName(plan, "interactions");
      record.interactionCaption = figure.caption;
      WritePng(figure.image, store.PathOf(record.interactionImage));
    }
  }

  /// What is there is kept, as a table too.
  int GiveUp() const
  {
    const auto finished = std::count_if(this->Report.records.begin(), this->Report.records.end(),
      [](const RunRecord& record) { return record.isFinished; });
    if (!this->Report.records.empty())
    {
      WriteTextAtomically(
        this->PathOf(MeasurementFile), PrintMeasurements(AllMeasurements(this->Report)));
    }
    PrintError("stopped: " + this->Options.folder + " keeps " + std::to_string(finished) +
               " finished runs; give the same command again to go on");
    return this->Watch.ExitCode();
  }

  ReportOptions Options;
  InterruptionWatch Watch;
  OffscreenDisplay Display;
  ProgressBar Bar;
  Target Goal;
  InteractionPainter Painter{ this->Display, this->Goal };
  SpeedReport Report;
  std::size_t Kept = 0; ///< runs that were there already
};

int MakeReport(ReportOptions options)
{
  options.Resolve();
  std::unique_ptr<Reporter> reporter = std::make_unique<Reporter>(options);
  const int code = reporter->Make();
  if (code == 0 && !options.quiet)
  {
    reporter->Print();
  }
  return code;
}

} // namespace

void AddReportCommand(CLI::App& app, Command& chosen)
{
  const auto options = std::make_shared<ReportOptions>();
  CLI::App* command = app.add_subcommand(
    "report", "Measure speed against error of every method: tables, charts, pictures, a page");
  DeclareReportOptions(*command, *options);
  command->callback([options, &chosen] { chosen = [options] { return MakeReport(*options); }; });
}

} // namespace vantage
