#include "CameraOptions.h"
#include "CommandLine.h"
#include "SceneFile.h"
#include "core/Error.h"
#include "view/ProgressiveView.h"
#include "view/ViewWindow.h"

#include <CLI/CLI.hpp>
#include <memory>
#include <string>
#include <tbb/global_control.h>
#include <utility>
#include <vector>

// Last, as it has macros for common words.
#include <X11/Xlib.h>

namespace vantage
{

namespace
{

struct ViewOptions
{
  std::string scene;
  CameraOptions view;
  double error = 0.01;
  ToneMappingSettings toneMapping;
  int threads = 0; ///< 0: all
  SolverSettings solver;
  bool quiet = false;

  void Validate() const
  {
    this->view.Validate();
    this->solver.Validate();
    if (!(this->error >= LeastGatherError && this->error <= 1.0))
    {
      throw InputError("--error: it must be from 0.0005 to 1; give for example 0.01");
    }
    if (this->threads < 0)
    {
      throw InputError("--threads: it must not be negative; give 0 for all");
    }
    this->toneMapping.Validate();
  }
};

/// VTK would end the program without one.
void RequireDisplay()
{
  Display* display = XOpenDisplay(nullptr);
  if (!display)
  {
    throw InputError("view: there is no X display to open a window on; start it on a desktop, or "
                     "write images with vantage render");
  }
  XCloseDisplay(display);
}

int View(const ViewOptions& options)
{
  options.Validate();
  std::vector<std::string> warnings;
  Scene scene = ReadScene(options.scene, &warnings);
  ViewWindow::Settings settings;
  settings.title = options.scene;
  settings.start = options.view.Choose(scene, options.scene).front();
  settings.places = scene.cameras;
  settings.toneMapping = options.toneMapping;
  const auto [width, height] = options.view.SizeOf(settings.start);
  settings.width = width;
  settings.height = height;
  if (!options.quiet)
  {
    PrintWarnings(warnings);
  }
  RequireDisplay();
  const tbb::global_control control(
    tbb::global_control::max_allowed_parallelism, ThreadsFor(options.threads));
  ProgressiveView view(std::move(scene), options.solver, options.error);
  ViewWindow(view, settings).Run();
  return 0;
}

} // namespace

void AddViewCommand(CLI::App& app, Command& chosen)
{
  const auto options = std::make_shared<ViewOptions>();
  CLI::App* command =
    app.add_subcommand("view", "Look around in a scene: drag, wheel, w s a d, 1 to 9 for its "
                               "cameras, x exposure, p prints the camera, q");
  command->add_option("SCENE", options->scene, "Scene (.obj, .vtp)")->required();
  command
    ->add_option("--camera", options->view.names, "Name of one of the scene's cameras [the first]")
    ->expected(1);
  DeclareCameraOptions(*command, options->view);
  command->add_option("--error", options->error, "Of the last picture of a view, relative L1")
    ->capture_default_str();
  command->add_option("--exposure", options->toneMapping.exposure,
    "Radiance is multiplied by 2^EV [automatic, of the first picture]");
  command->add_option("--threads", options->threads, "0: all")->capture_default_str();
  command->add_option("--seed", options->solver.seed, "Of random numbers")
    ->check(CLI::NonNegativeNumber)
    ->capture_default_str();
  command->add_flag("--quiet", options->quiet, "No warnings");
  command->callback([options, &chosen] { chosen = [options] { return View(*options); }; });
}

} // namespace vantage
