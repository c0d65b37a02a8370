#include "CommandLine.h"

#include <CLI/CLI.hpp>
#include <exception>
#include <new>
#include <vtkLogger.h>

namespace
{

constexpr int BadInput = 2;

int Run(int argc, char** argv)
{
  CLI::App app("Global illumination for the view that is asked for.", "vantage");
  app.require_subcommand(1);
  vantage::Command command;
  vantage::AddRenderCommand(app, command);
  vantage::AddInfoCommand(app, command);
  vantage::AddLabyrinthCommand(app, command);
  vantage::AddCompareCommand(app, command);
  vantage::AddFormFactorsCommand(app, command);
  vantage::AddPlatesCommand(app, command);
  vantage::AddReportCommand(app, command);
  vantage::AddViewCommand(app, command);
  try
  {
    app.parse(argc, argv);
  }
  catch (const CLI::ParseError& error)
  {
    if (error.get_exit_code() == 0) // help was asked for
    {
      return app.exit(error);
    }
    const auto chosen = app.get_subcommands();
    vantage::PrintError(std::string("command line: ") + error.what() + "; see vantage " +
                        (chosen.empty() ? "" : chosen.front()->get_name() + " ") + "--help");
    return BadInput;
  }
  return command();
}

} // namespace

int main(int argc, char** argv)
{
  // VTK's own complaints take several lines; VtkFile turns them into one.
  vtkLogger::SetStderrVerbosity(vtkLogger::VERBOSITY_OFF);
  try
  {
    return Run(argc, argv);
  }
  catch (const std::bad_alloc&)
  {
    vantage::PrintError(
      "memory: not enough for this scene or image size; make one of them smaller");
  }
  catch (const std::exception& error)
  {
    vantage::PrintError(error.what());
  }
  return BadInput;
}
