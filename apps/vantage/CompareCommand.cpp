#include "CommandLine.h"
#include "ImageFile.h"
#include "core/Error.h"

#include <CLI/CLI.hpp>
#include <iostream>
#include <memory>
#include <optional>

namespace vantage
{

namespace
{

struct CompareOptions
{
  std::string image;
  std::string reference;
  std::optional<double> tolerance;
};

/// Exit code 1 when the images differ by more than the tolerance, as `diff` and `cmp` do.
int CompareImages(const CompareOptions& options)
{
  if (options.tolerance && !(*options.tolerance >= 0.0))
  {
    throw InputError(
      "--tolerance: it must be zero or more; give a relative L1 error, such as 0.01");
  }
  const ImageDifference difference =
    Compare(ReadImage(options.image), ReadImage(options.reference));
  std::cout << "relative L1   " << difference.relativeL1 << "\nrelative RMSE "
            << difference.relativeRmse << "\nrelative bias " << difference.relativeBias << '\n';
  // Written so that a difference that is not a number counts as one.
  const bool isWithin = !options.tolerance || difference.relativeL1 <= *options.tolerance;
  return isWithin ? 0 : 1;
}

} // namespace

void AddCompareCommand(CLI::App& app, Command& chosen)
{
  const auto options = std::make_shared<CompareOptions>();
  CLI::App* command =
    app.add_subcommand("compare", "How far an image is from a reference (.exr, .vti, .png)");
  command->add_option("A", options->image, "Image")->required();
  command->add_option("B", options->reference, "Reference")->required();
  command->add_option(
    "--tolerance", options->tolerance, "Exit with 1 when the relative L1 error is larger");
  command->callback([options, &chosen] { chosen = [options] { return CompareImages(*options); }; });
}

} // namespace vantage
