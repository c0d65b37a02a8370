#pragma once

#include "core/Solver.h"

#include <string>
#include <vector>
#include <vtkSmartPointer.h>

class vtkImageData;
class vtkLookupTable;
class vtkPolyData;
class vtkRenderer;

/// \file PlatePainter.h
/// The kinds of pictures that the plates are.

namespace vantage
{

class OffscreenDisplay;

/// Draws pictures of one size and exposure, so that they can be compared; 3 unsigned char.
class PlatePainter
{
public:
  /// Radiance is multiplied by 2^exposure. The display must outlive the painter.
  PlatePainter(OffscreenDisplay& display, int width, int height, double exposure);

  /// The rooms as they are drawn below interactions, and a camera that looks at them from outside;
  /// it is moved until they fill the picture. \pre called before all below but DrawView()
  void SetRooms(vtkPolyData* elements, const Camera& overview);

  /// Elements from above, without what would hide the rooms.
  vtkSmartPointer<vtkImageData> DrawFromAbove(vtkPolyData* elements) const;

  /// What a camera inside sees of a solution.
  vtkSmartPointer<vtkImageData> DrawView(const Camera& camera, const Solver& solver) const;

  /// Interactions over the darkened rooms, coloured by a cell array; seen through walls.
  vtkSmartPointer<vtkImageData> DrawInteractionsFromAbove(
    vtkPolyData* interactions, const std::string& array, const std::string& title) const;

  /// The same from inside, hidden by what stands before them, and without a legend.
  vtkSmartPointer<vtkImageData> DrawInteractionsFrom(
    const Camera& camera, vtkPolyData* interactions, const std::string& array) const;

  /// Side by side, from above and from inside.
  vtkSmartPointer<vtkImageData> DrawInteractionsTwice(vtkPolyData* interactions,
    const Camera& camera, const std::string& array, const std::string& title) const;

private:
  vtkSmartPointer<vtkImageData> Draw(const std::vector<vtkRenderer*>& renderers) const;

  OffscreenDisplay& Display;
  int Width;
  int Height;
  double Exposure;
  Camera Overview;
  vtkSmartPointer<vtkPolyData> Rooms;
  std::vector<bool> Shown; ///< patches
};

} // namespace vantage
