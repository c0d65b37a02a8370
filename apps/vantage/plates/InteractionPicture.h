#pragma once

#include <string>
#include <vtkSmartPointer.h>

class vtkActor;
class vtkLookupTable;
class vtkPolyData;
class vtkRenderer;

/// \file InteractionPicture.h
/// Interactions as thin lines, coloured by the logarithm of what they mean.

namespace vantage
{

/// Five decades up to about the largest value of a cell array of port 1 of
/// vtkImportanceDrivenShooting, dark to bright in even steps of lightness.
vtkSmartPointer<vtkLookupTable> MakeInteractionScale(
  vtkPolyData* interactions, const std::string& array);

/// The interactions within the scale, the strongest drawn last. About so many of them are opaque,
/// 1 or more; weaker ones are more and more transparent, so that tens of thousands read as texture
/// and not as fog.
/// Wants a renderer that draws translucent lines in their order: see DrawInOrder().
vtkSmartPointer<vtkActor> MakeInteractionLines(
  vtkPolyData* interactions, const std::string& array, vtkLookupTable* scale, double opaqueLines);

/// Adds a legend in the lower right corner of a picture that is `height` pixels high.
void AddScaleBar(
  vtkRenderer* renderer, vtkLookupTable* scale, const std::string& title, int height);

/// Makes a renderer blend translucent things in the order of their cells, as a painter would. VTK's
/// usual order-independent blending would bury the strong lines below the many.
void DrawInOrder(vtkRenderer* renderer);

} // namespace vantage
