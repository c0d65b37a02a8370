#include "Commands.h"

#include <CLI/CLI.hpp>

#include <exception>
#include <iostream>

namespace
{

int Run(int argc, char** argv)
{
  CLI::App app("Measures the speed and the accuracy of Vantage");
  app.require_subcommand(1);
  vantage::benchmarks::Command chosen;
  vantage::benchmarks::AddReferenceCommand(app, chosen);
  vantage::benchmarks::AddSceneBuildCommand(app, chosen);
  vantage::benchmarks::AddSpeedCommand(app, chosen);
  vantage::benchmarks::AddStudyCommand(app, chosen);
  vantage::benchmarks::AddWalkCommand(app, chosen);
  CLI11_PARSE(app, argc, argv);
  chosen();
  return 0;
}

} // namespace

int main(int argc, char** argv)
{
  try
  {
    return Run(argc, argv);
  }
  catch (const std::exception& error)
  {
    std::cerr << "vantage-benchmarks: " << error.what() << '\n';
  }
  catch (...)
  {
    std::cerr << "vantage-benchmarks: stopped by something that is no exception\n";
  }
  return 2;
}
