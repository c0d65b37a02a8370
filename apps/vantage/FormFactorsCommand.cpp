#include "CommandLine.h"
#include "SceneFile.h"
#include "core/Error.h"
#include "core/reference/DenseSolve.h"
#include "io/AtomicFile.h"
#include "io/TextLines.h"

#include <CLI/CLI.hpp>
#include <memory>

namespace vantage
{

namespace
{

/// A dense matrix of more is neither read nor computed in reasonable time.
constexpr std::size_t MostPolygons = 4000;

struct FormFactorsOptions
{
  std::string scene;
  std::string output;
};

/// A dense matrix, row by row.
struct Matrix
{
  explicit Matrix(std::size_t n)
    : size(n)
    , values(n * n)
  {
  }
  double& At(std::size_t row, std::size_t column)
  {
    return this->values[row * this->size + column];
  }

  std::size_t size;
  std::vector<double> values;
};

/// F = G / (pi A): what leaves the front of the row's polygon and arrives at the column's. A
/// polygon may be in several pieces; one that was dropped as degenerate has zeros.
Matrix FormFactors(const Scene& scene)
{
  const FacetSet facets = BuildFacets(scene);
  const ElementTree tree(facets, scene.materials, Sides::FrontOnly);
  std::vector<NodeId> fronts;
  std::vector<std::uint32_t> polygon;
  std::vector<double> area(scene.PolygonCount());
  for (const Patch& patch : tree.Patches())
  {
    if (patch.IsActive())
    {
      fronts.push_back(patch.node);
      polygon.push_back(facets.facets[patch.facet].ScenePolygonOf(patch.side));
      area[polygon.back()] += tree[patch.node].area;
    }
  }
  const std::vector<double> throughput = DenseThroughput(facets, tree, fronts, {});
  Matrix factors(scene.PolygonCount());
  for (std::size_t i = 0; i < fronts.size(); ++i)
  {
    for (std::size_t j = 0; j < fronts.size(); ++j)
    {
      factors.At(polygon[i], polygon[j]) +=
        throughput[i * fronts.size() + j] / (Pi * area[polygon[i]]);
    }
  }
  return factors;
}

int WriteFormFactors(const FormFactorsOptions& options)
{
  RequireSuffix(options.output, { ".csv" });
  std::vector<std::string> warnings;
  const Scene scene = ReadScene(options.scene, &warnings);
  CheckWritable(options.output);
  PrintWarnings(warnings);
  if (scene.PolygonCount() > MostPolygons)
  {
    throw InputError(options.scene + ": it has " + std::to_string(scene.PolygonCount()) +
                     " polygons, too many for a matrix; give a scene with at most " +
                     std::to_string(MostPolygons));
  }
  Matrix factors = FormFactors(scene);
  std::string text;
  for (std::size_t row = 0; row < factors.size; ++row)
  {
    for (std::size_t column = 0; column < factors.size; ++column)
    {
      text += (column == 0 ? "" : ",") + PrintNumber(factors.At(row, column));
    }
    text += "\n";
  }
  WriteTextAtomically(options.output, text);
  return 0;
}

} // namespace

void AddFormFactorsCommand(CLI::App& app, Command& chosen)
{
  const auto options = std::make_shared<FormFactorsOptions>();
  CLI::App* command = app.add_subcommand("form-factors",
    "The matrix of classical form factors: row and column k are the front of the k-th polygon");
  command->add_option("SCENE", options->scene, "Scene (.obj, .vtp)")->required();
  command->add_option("-o,--output", options->output, "Matrix to write (.csv)")->required();
  command->callback(
    [options, &chosen] { chosen = [options] { return WriteFormFactors(*options); }; });
}

} // namespace vantage
