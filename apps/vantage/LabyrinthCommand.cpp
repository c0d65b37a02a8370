#include "CommandLine.h"
#include "SceneFile.h"
#include "core/scene/Labyrinth.h"
#include "io/AtomicFile.h"

#include <CLI/CLI.hpp>
#include <memory>

namespace vantage
{

namespace
{

struct LabyrinthOptions
{
  LabyrinthSettings settings;
  std::string output;
};

int WriteLabyrinth(const LabyrinthOptions& options)
{
  options.settings.Validate();
  RequireSuffix(options.output, SceneSuffixes());
  CheckWritable(options.output);
  WriteScene(MakeLabyrinth(options.settings), options.output);
  return 0;
}

} // namespace

void AddLabyrinthCommand(CLI::App& app, Command& chosen)
{
  const auto options = std::make_shared<LabyrinthOptions>();
  LabyrinthSettings& settings = options->settings;
  CLI::App* command = app.add_subcommand("labyrinth", "Make a scene of many rooms");
  command->add_option("--rows", settings.rows, "Rooms along y")->capture_default_str();
  command->add_option("--columns", settings.columns, "Rooms along x")->capture_default_str();
  command->add_option("--seed", settings.seed, "Of doors, colours and furniture")
    ->check(CLI::NonNegativeNumber)
    ->capture_default_str();
  command->add_option("--extra-doors", settings.extraDoors, "Part of the spare walls with a door")
    ->capture_default_str();
  command->add_option("--dark-rooms", settings.darkRooms, "Part of the rooms without a lamp")
    ->capture_default_str();
  command->add_option("--lamp-radiance", settings.lampRadiance, "W m^-2 sr^-1")
    ->capture_default_str();
  command->add_option("-o,--output", options->output, "Scene to write (.obj, .vtp)")->required();
  command->callback(
    [options, &chosen] { chosen = [options] { return WriteLabyrinth(*options); }; });
}

} // namespace vantage
