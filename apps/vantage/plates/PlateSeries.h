#pragma once

#include "core/scene/Scene.h"
#include "plates/PlateTable.h"

#include <functional>
#include <string>
#include <vector>
#include <vtkSmartPointer.h>

class vtkImageData;

/// \file PlateSeries.h
/// The plates of Bekaert and Willems (1995), made anew.

namespace vantage
{

class OffscreenDisplay;

struct PlateSettings
{
  int width = 800;  ///< of a plate, pixels, 16 .. 8192; those that show interactions twice, from
                    ///< above and from the camera, are twice as wide
  int height = 600; ///< pixels, 16 .. 8192
  int referenceSamples = 128; ///< a pixel of the path-traced references, 2 .. 1,000,000

  /// \throw InputError naming the first value out of range.
  void Validate() const;
};

struct Plate
{
  std::string name;                    ///< "1d"
  std::string solution;                ///< PlateRow::plate of the solution it shows: "1b"
  std::string caption;                 ///< one line
  vtkSmartPointer<vtkImageData> image; ///< 3 unsigned char
};

struct PlateSeries
{
  std::vector<Plate> plates; ///< 1a 1b 1c 1d 2a 2b 2c 3a 3b 3c
  vtkSmartPointer<vtkImageData> sheet;
  std::vector<PlateRow> rows;
  std::vector<std::string> notes; ///< what the rows do not say, one line each
};

/// \throw InputError when the scene has no light or not the cameras view1, view2 and overview.
void RequirePlateScene(const Scene& scene);

/// Called with the part done, 0 .. 1, and what is being done.
using PlateProgress = std::function<void(double, const std::string&)>;

/// \param path file of the scene, which the pipeline reads, \param scene what it holds.
/// \throw InputError for settings out of range or a missing camera; Error when the scene cannot be
/// solved.
PlateSeries MakePlates(OffscreenDisplay& display, const std::string& path, const Scene& scene,
  const PlateSettings& settings, const PlateProgress& progress);

} // namespace vantage
