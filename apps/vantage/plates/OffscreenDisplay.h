#pragma once

#include <vtkSmartPointer.h>

#include <memory>
#include <vector>

class vtkImageData;
class vtkRenderer;
class vtkRenderWindow;

/// \file OffscreenDisplay.h
/// Drawing without a display.

namespace vantage
{

/// A window in memory. It asks EGL for OpenGL without any surface, so that it works on a server as
/// it does on a desktop: VTK's own windows end the process where there is no X display.
/// One at a time, to be used from the thread that made it.
class OffscreenDisplay
{
public:
  /// \throw Error when the machine has no OpenGL 3.2 that works without a display.
  OffscreenDisplay();
  ~OffscreenDisplay();
  OffscreenDisplay(const OffscreenDisplay&) = delete;
  OffscreenDisplay& operator=(const OffscreenDisplay&) = delete;

  /// Everything is drawn at this many times the size, each way, and averaged: whoever sets the size
  /// of a text or the width of a line multiplies by it.
  static constexpr int Supersampling = 2;

  /// An image of width x height pixels with 3 unsigned char, row 0 at the bottom. A renderer that
  /// is on layer 1 is drawn over those on layer 0. They belong to the caller and may be used again.
  vtkSmartPointer<vtkImageData> Draw(
    const std::vector<vtkRenderer*>& renderers, int width, int height);

private:
  struct Context;
  std::unique_ptr<Context> Egl; // outlives the window
  vtkSmartPointer<vtkRenderWindow> Window;
};

} // namespace vantage
