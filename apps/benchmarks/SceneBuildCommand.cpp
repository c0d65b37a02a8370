#include "Commands.h"
#include "Measure.h"

#include "core/Solver.h"
#include "core/mesh/DarkSides.h"
#include "core/mesh/ElementTree.h"
#include "core/visibility/OccluderScene.h"
#include "support/StudyScenes.h"

#include <CLI/CLI.hpp>

#include <cstdio>
#include <memory>
#include <utility>
#include <vector>

namespace vantage::benchmarks
{

namespace
{

void PrintStage(int rooms, const char* stage, const Stopwatch& watch)
{
  std::printf("%d,%s,%.4f,%.4f,%.1f\n", rooms, stage, watch.Cpu(), watch.Wall(),
    static_cast<double>(PeakMemoryBytes()) / 1e6);
}

/// Stage by stage what every solver does with a scene before its first step.
void MeasureStages(int rooms)
{
  const Stopwatch making;
  const Scene scene = test::MakeLabyrinthOf(rooms, 1);
  PrintStage(rooms, "make", making);
  const Stopwatch all;
  const Stopwatch facetWatch;
  const FacetSet facets = BuildFacets(scene);
  PrintStage(rooms, "facets", facetWatch);
  const Stopwatch darkWatch;
  const DarkSides dark = FindDarkSides(facets, scene.materials);
  PrintStage(rooms, "dark sides", darkWatch);
  const Stopwatch treeWatch;
  const ElementTree tree(facets, scene.materials, dark);
  PrintStage(rooms, "tree", treeWatch);
  const Stopwatch occluderWatch;
  const OccluderScene occluders(facets, dark);
  PrintStage(rooms, "occluders", occluderWatch);
  PrintStage(rooms, "sum", all);
}

/// The same as Solver does it, with what it needs besides.
void MeasureSolver(int rooms)
{
  Scene scene = test::MakeLabyrinthOf(rooms, 1);
  const Stopwatch watch;
  const Solver solver(std::move(scene));
  PrintStage(rooms, "solver", watch);
}

} // namespace

void AddSceneBuildCommand(CLI::App& app, Command& chosen)
{
  const auto sizes = std::make_shared<std::vector<int>>(std::vector<int>{ 20, 1000, 10000 });
  CLI::App* command =
    app.add_subcommand("scene-build", "Time and memory until a labyrinth can be solved, as CSV");
  command->add_option("--rooms", *sizes, "Rooms of the labyrinths")->capture_default_str();
  command->callback(
    [sizes, &chosen]
    {
      chosen = [sizes]
      {
        std::printf("rooms,stage,cpu s,wall s,peak MB so far\n");
        for (const int rooms : *sizes)
        {
          InOwnProcess([rooms] { MeasureStages(rooms); });
          InOwnProcess([rooms] { MeasureSolver(rooms); });
        }
      };
    });
}

} // namespace vantage::benchmarks
