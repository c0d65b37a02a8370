#pragma once

#include "core/Solver.h"

#include <string>
#include <vtkSmartPointer.h>

class vtkImageData;
class vtkPolyData;

/// \file ReportFigures.h
/// Pictures of a report other than its charts.

namespace vantage
{

class OffscreenDisplay;
struct Target;

/// Tone-mapped with the exposure of the target.
void WritePicture(const Target& target, const Image& image, const std::string& path);

/// How far a picture is from the reference: orange where it is too bright, blue where it is too
/// dark, in proportion to the logarithm of the difference between LeastDifference (white) and
/// MostDifference of the mean radiance of the reference.
void WriteDifference(const Target& target, const Image& image, const std::string& path);

inline constexpr double LeastDifference = 0.003;
inline constexpr double MostDifference = 1.0;

/// The interactions of a solution, over its darkened rooms.
struct InteractionFigure
{
  vtkSmartPointer<vtkImageData> image; ///< 3 unsigned char; null when nothing was carried
  std::string caption;
};

/// Draws them for one target, all over the same rooms.
class InteractionPainter
{
public:
  /// Both must outlive the painter.
  InteractionPainter(OffscreenDisplay& display, const Target& target);

  /// From above and from inside where the scene has a camera named overview, else from inside only.
  /// Coloured by what they contribute to the view where the method knows that, else by what they
  /// carry.
  InteractionFigure Draw(const Solver& solver);

private:
  vtkPolyData* Rooms();

  OffscreenDisplay& Display;
  const Target& Goal;
  vtkSmartPointer<vtkPolyData> LitRooms; ///< made when they are first needed
};

} // namespace vantage
