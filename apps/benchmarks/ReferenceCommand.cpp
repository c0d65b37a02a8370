#include "Commands.h"
#include "Measure.h"

#include "support/ReferenceImage.h"
#include "support/StudyScenes.h"

#include <CLI/CLI.hpp>

#include <cstdio>
#include <memory>
#include <string>
#include <vector>

namespace vantage::benchmarks
{

namespace
{

struct ReferenceOptions
{
  std::vector<std::string> scenes = test::StudySceneNames();
  std::string cache = "references";
  bool checksCells = false;
  int tracedSamples = 0;
};

/// The same reference with cells of four times the area: what it differs by, beyond the noise of
/// the coarser one, is the discretisation.
void CheckCells(const test::StudyScene& study, const test::ReferenceImage& reference)
{
  test::ReferenceSettings coarser = study.reference;
  coarser.mapCells /= 4;
  const test::ReferenceImage coarse = test::MakeReference(study.scene, study.View(), coarser);
  const ImageDifference difference = Compare(coarse.image, reference.image);
  std::printf(",%.5f,%.5f,%+.5f", coarse.noise, difference.relativeL1, difference.relativeBias);
}

/// Against path tracing through the same pixel centres: whole image and blocks of 8 x 8.
void CheckAgainstPaths(const test::StudyScene& study, const ReferenceOptions& options,
  const test::ReferenceImage& reference)
{
  constexpr int Block = 8;
  const test::TracedImage traced =
    test::PathTraced(study.scene, study.View(), study.reference.size, options.tracedSamples, true);
  const ImageDifference difference =
    Compare(BlockMeans(reference.image, Block), BlockMeans(traced.image, Block));
  std::printf(
    ",%+.5f,%.5f,%.5f", difference.relativeBias, traced.noiseOfMean, difference.relativeL1);
}

void MakeReferences(const ReferenceOptions& options)
{
  std::printf("scene,cpu s,mean radiance,noise L1%s%s\n",
    options.checksCells ? ",noise with larger cells,larger cells L1,larger cells bias" : "",
    options.tracedSamples > 0 ? ",bias to paths,noise of paths' mean,block L1 to paths" : "");
  for (const std::string& name : options.scenes)
  {
    const test::StudyScene study = test::MakeStudyScene(name);
    const Stopwatch watch;
    const test::ReferenceImage reference =
      test::CachedReference(options.cache, name, study.scene, study.View(), study.reference);
    double mean = 0.0;
    for (const Color& pixel : reference.image.pixels)
    {
      mean += Mean(pixel) / static_cast<double>(reference.image.pixels.size());
    }
    std::printf("%s,%.2f,%.5g,%.5f", name.c_str(), watch.Cpu(), mean, reference.noise);
    if (options.checksCells)
    {
      CheckCells(study, reference);
    }
    if (options.tracedSamples > 0)
    {
      CheckAgainstPaths(study, options, reference);
    }
    std::printf("\n");
    std::fflush(stdout);
  }
}

} // namespace

void AddReferenceCommand(CLI::App& app, Command& chosen)
{
  const auto options = std::make_shared<ReferenceOptions>();
  CLI::App* command = app.add_subcommand(
    "references", "Makes the reference images of the study scenes and says how good they are");
  command->add_option("--scenes", options->scenes, "Names, or room-N for a random room");
  command->add_option("--cache", options->cache, "Folder of the images")
    ->envname("VANTAGE_REFERENCES")
    ->capture_default_str();
  command->add_flag("--check-cells", options->checksCells,
    "Compares with references of cells of four times the area");
  command->add_option("--check-paths", options->tracedSamples,
    "Compares with path tracing of so many samples a pixel");
  command->callback([options, &chosen] { chosen = [options] { MakeReferences(*options); }; });
}

} // namespace vantage::benchmarks
