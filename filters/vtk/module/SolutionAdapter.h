#pragma once

#include "core/Solver.h"
#include "vtkVantageFiltersModule.h"

#include <vtkSmartPointer.h>

#include <vector>

class vtkImageData;
class vtkPolyData;
class vtkTable;

/// \file SolutionAdapter.h
/// What a Solver knows, as data sets of VTK. Real numbers are double unless said otherwise.

namespace vantage
{

struct SolvedView;

/// The leaf elements as polygons; elements of one flat surface share points.
///
/// | cell array       | components | unit        | content                                      |
/// |------------------|------------|-------------|----------------------------------------------|
/// | Radiance         | 3          | W m^-2 sr^-1| leaving the element, emission included       |
/// | Irradiance       | 3          | W m^-2      | arriving; of goal-oriented only              |
/// | UnshotRadiance   | 3          | W m^-2 sr^-1| its part that is not yet propagated          |
/// | Importance       | 3          | sr m^-2     | P: what light here means for the view        |
/// | UnshotImportance | 3          | sr m^-2     | part of albedo * P that is not propagated    |
/// | ViewImportance   | 1          | sr m^-2     | V: importance straight from the eye          |
/// | Albedo           | 3          | 1           | of the input                                 |
/// | Emission         | 3          | W m^-2 sr^-1| of the input, on the side that emits         |
/// | PatchId          | 1 (id)     |             | one side of one flat facet                   |
/// | InputCellId      | 1 (id)     |             | polygon of the scene it came from            |
/// | Side             | 1 (uchar)  |             | 0 front, 1 back; corners run accordingly     |
/// | Level            | 1 (int)    |             | subdivisions below the patch                 |
///
/// Point arrays: Radiance, 3, ElementSolution::pointRadiance, and with Irradiance its
/// pointIrradiance.
VTKVANTAGEFILTERS_EXPORT vtkSmartPointer<vtkPolyData> ElementsToPolyData(
  const ElementSolution& solution);

/// The same with the field array ErrorEstimate (1): the relative L1 error of the picture that the
/// points give, of the solution and of the gather.
VTKVANTAGEFILTERS_EXPORT vtkSmartPointer<vtkPolyData> ElementsToPolyData(
  const GatheredElements& gathered, double errorOfSolution);

/// One line an interaction, from the centre of the shooter to the centre of the receiver.
///
/// | cell array    | type | unit   | content                                               |
/// |---------------|------|--------|-------------------------------------------------------|
/// | Shooter       | id   |        | PatchId of the end that sends more; -1: cluster       |
/// | Receiver      | id   |        | same of the other end                                 |
/// | ShooterLevel  | int  |        | subdivisions of that end below its patch; -1: cluster |
/// | ReceiverLevel | int  |        | same of the other end                                 |
/// | FormFactor    | real | sr     | pi times the classical one, visibility included       |
/// | Visibility    | real | 1      | visible fraction, 0 to 1                              |
/// | ShotFlux      | real | W      | carried so far, both directions                       |
/// | Contribution  | real | W m^-2 | of what was carried, to the view flux                 |
/// | Step          | id   |        | in which it was made                                  |
VTKVANTAGEFILTERS_EXPORT vtkSmartPointer<vtkPolyData> InteractionsToPolyData(
  const std::vector<InteractionRecord>& interactions);

/// One row a step. Columns: Step, Phase (string), Patch (-1: none), ViewFlux and UnshotViewFlux
/// (W m^-2), UnshotPower (W), ErrorEstimate, Elements, Interactions, Evaluations, Rays, Seconds;
/// meanings as in StepReport.
VTKVANTAGEFILTERS_EXPORT vtkSmartPointer<vtkTable> HistoryToTable(
  const std::vector<StepReport>& history);

/// An image with the point array Radiance (3 floats, W m^-2 sr^-1), row 0 at the bottom.
VTKVANTAGEFILTERS_EXPORT vtkSmartPointer<vtkImageData> ImageToImageData(const Image& image);

/// The same with the point arrays Irradiance (3 floats, W m^-2), ElementId (id, cell of the
/// elements; -1: none) and Depth (float) and the field arrays GatherErrorEstimate and, where it is
/// known, ErrorEstimate: of the solution and of the gather. `camera` is that of the view.
VTKVANTAGEFILTERS_EXPORT vtkSmartPointer<vtkImageData> ViewToImageData(
  const GatheredView& view, const Camera& camera, const SolvedView& solved);

} // namespace vantage
