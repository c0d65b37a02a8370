#include "CommandLine.h"
#include "SceneFile.h"
#include "SceneSummary.h"

#include <CLI/CLI.hpp>
#include <iostream>
#include <memory>

namespace vantage
{

namespace
{

int PrintInfo(const std::string& path)
{
  std::vector<std::string> warnings;
  const Scene scene = ReadScene(path, &warnings);
  const FacetSet facets = BuildFacets(scene);
  std::cout << DescribeScene(scene, facets);
  PrintWarnings(warnings);
  PrintWarnings(SceneWarnings(scene, facets));
  if (scene.cameras.empty())
  {
    PrintWarnings({ "there is no camera; render needs --eye and --look-at" });
  }
  return 0;
}

} // namespace

void AddInfoCommand(CLI::App& app, Command& chosen)
{
  const auto path = std::make_shared<std::string>();
  CLI::App* command = app.add_subcommand("info", "What a scene contains and what is wrong with it");
  command->add_option("SCENE", *path, "Scene (.obj, .vtp)")->required();
  command->callback([path, &chosen] { chosen = [path] { return PrintInfo(*path); }; });
}

} // namespace vantage
