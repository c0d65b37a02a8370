#include "CommandLine.h"
#include "ProgressBar.h"
#include "SceneFile.h"
#include "TextTable.h"
#include "VtkFile.h"
#include "core/Error.h"
#include "io/AtomicFile.h"
#include "plates/OffscreenDisplay.h"
#include "plates/PlateSeries.h"

#include <CLI/CLI.hpp>
#include <array>
#include <filesystem>
#include <iostream>
#include <memory>
#include <optional>
#include <vtkImageData.h>

namespace vantage
{

namespace
{

struct PlatesOptions
{
  std::string scene;
  std::string folder;
  std::optional<std::array<int, 2>> size;
  PlateSettings settings;
  bool quiet = false;
};

std::string PlateFile(const std::string& folder, const std::string& plate)
{
  return (std::filesystem::path(folder) / ("plate-" + plate + ".png")).string();
}

std::string SheetFile(const std::string& folder)
{
  return (std::filesystem::path(folder) / "contact-sheet.png").string();
}

std::string TableFile(const std::string& folder)
{
  return (std::filesystem::path(folder) / "plates.csv").string();
}

int MakeAndWritePlates(PlatesOptions options)
{
  if (options.size)
  {
    options.settings.width = (*options.size)[0];
    options.settings.height = (*options.size)[1];
  }
  options.settings.Validate();
  std::vector<std::string> warnings;
  const Scene scene = ReadScene(options.scene, &warnings);
  RequirePlateScene(scene);
  if (!options.quiet)
  {
    PrintWarnings(warnings);
  }
  OffscreenDisplay display;
  // Before the long work, not after it.
  PrepareFolder(options.folder);
  CheckWritable(SheetFile(options.folder));

  ProgressBar bar(!options.quiet);
  const PlateSeries series = MakePlates(display, options.scene, scene, options.settings,
    [&](double part, const std::string& what) { bar.Update(part, what); });
  for (const Plate& plate : series.plates)
  {
    WritePng(plate.image, PlateFile(options.folder, plate.name));
  }
  WriteTextAtomically(TableFile(options.folder), PrintPlateCsv(series.rows));
  // Last, so that a sheet that is there tells that all is there.
  WritePng(series.sheet, SheetFile(options.folder));
  if (!options.quiet)
  {
    std::cout << AlignTable(FormatPlateTable(series.rows), IsNumberColumn);
    for (const std::string& note : series.notes)
    {
      std::cout << note << '\n';
    }
  }
  return 0;
}

} // namespace

void AddPlatesCommand(CLI::App& app, Command& chosen)
{
  const auto options = std::make_shared<PlatesOptions>();
  CLI::App* command =
    app.add_subcommand("plates", "Make the plates of the paper, a contact sheet and a table");
  command->add_option("SCENE", options->scene, "Scene with cameras view1, view2 and overview")
    ->required();
  command->add_option("-o,--output", options->folder, "Folder to write into")->required();
  command->add_option("--size", options->size, "Width and height of a plate, pixels (800 600)");
  command
    ->add_option("--reference-samples", options->settings.referenceSamples,
      "Samples a pixel of the path-traced references")
    ->capture_default_str();
  command->add_flag("--quiet", options->quiet, "No progress bar, no warnings and no table");
  command->callback(
    [options, &chosen] { chosen = [options] { return MakeAndWritePlates(*options); }; });
}

} // namespace vantage
