#pragma once

#include "core/view/ToneMapping.h"
#include "view/ProgressiveView.h"

#include <memory>
#include <string>
#include <vector>

class vtkRenderWindowInteractor;

/// \file ViewWindow.h
/// A window to look around in.

namespace vantage
{

/// Shows the pictures of a ProgressiveView, and moves its camera:
///
///     drag                   look around
///     wheel, w s a d, arrows go forward and back, to the left and right
///     page up, page down     go up and down
///     1 .. 9                 the cameras of the scene
///     x                      exposure for what is seen now
///     + -                    brighter, darker
///     p                      print the camera, as --walk and .obj note it
///     q, Escape              close
///
/// Needs an X display.
class ViewWindow
{
public:
  struct Settings
  {
    std::string title;
    Camera start;
    int width = 0; ///< pixels
    int height = 0;
    std::vector<Camera> places;      ///< of the number keys
    ToneMappingSettings toneMapping; ///< without an exposure that of the first picture
  };

  /// \param view must outlive this
  ViewWindow(ProgressiveView& view, const Settings& settings);
  ~ViewWindow();

  /// Opens it; returns when it is closed. \throw what the view has ended with
  void Run();

  /// What the events of the window go to.
  vtkRenderWindowInteractor* Interactor() const;
  /// From where pictures are shown, or will be.
  const Camera& CurrentCamera() const;

private:
  class Implementation;
  std::unique_ptr<Implementation> Impl;
};

} // namespace vantage
