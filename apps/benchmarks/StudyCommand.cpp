#include "Commands.h"
#include "StudyTable.h"

#include "support/ReferenceImage.h"
#include "support/StudyScenes.h"

#include <CLI/CLI.hpp>
#include <tbb/global_control.h>

#include <memory>
#include <string>
#include <vector>

namespace vantage::benchmarks
{

namespace
{

struct StudyOptions
{
  std::vector<std::string> scenes = test::StudySceneNames();
  int randomRooms = 0;
  int seeds = 1;
  std::vector<double> errors = { 0.1, 0.05, 0.02, 0.01 };
  std::string method = NameOf(Method::GoalOriented);
  std::string cache = "references";
  std::size_t threads = 1;
};

void RunStudy(const StudyOptions& options)
{
  const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, options.threads);
  EngineSettings engine;
  engine.method = MethodFromName(options.method);
  std::vector<std::string> names = options.scenes;
  for (int room = 1; room <= options.randomRooms; ++room)
  {
    names.push_back("room-" + std::to_string(room));
  }
  std::vector<StudyRow> rows;
  std::vector<std::pair<std::string, Image>> references;
  PrintStudyHead();
  for (const std::string& name : names)
  {
    const test::StudyScene study = test::MakeStudyScene(name);
    const test::ReferenceImage reference =
      test::CachedReference(options.cache, name, study.scene, study.View(), study.reference);
    references.emplace_back(name, reference.image);
    engine.size = study.reference.size;
    for (const double error : options.errors)
    {
      engine.error = error;
      for (int seed = 1; seed <= options.seeds; ++seed)
      {
        engine.seed = static_cast<std::uint64_t>(seed);
        StudyRow row{ name, engine.seed, error, reference.noise, {},
          RunEngine(study.scene, study.View(), engine) };
        row.truth = Compare(row.run.image, reference.image);
        PrintStudyRow(row);
        rows.push_back(std::move(row));
      }
    }
  }
  PrintBiasAndNoise(rows, references);
  PrintStudySummary(rows);
}

} // namespace

void AddStudyCommand(CLI::App& app, Command& chosen)
{
  const auto options = std::make_shared<StudyOptions>();
  CLI::App* command =
    app.add_subcommand("study", "Asked, estimated and true errors of pictures, as CSV");
  command->add_option("--scenes", options->scenes, "Names, or room-N for a random room");
  command->add_option("--random-rooms", options->randomRooms, "room-1 to room-N as well");
  command->add_option("--seeds", options->seeds, "Runs of each scene and error")
    ->capture_default_str();
  command->add_option("--errors", options->errors, "Asked relative L1 errors")
    ->capture_default_str();
  command->add_option("--method", options->method, "Of the solver")->capture_default_str();
  command->add_option("--cache", options->cache, "Folder of the reference images")
    ->envname("VANTAGE_REFERENCES")
    ->capture_default_str();
  command->add_option("--threads", options->threads, "Of the solver")->capture_default_str();
  command->callback([options, &chosen] { chosen = [options] { RunStudy(*options); }; });
}

} // namespace vantage::benchmarks
