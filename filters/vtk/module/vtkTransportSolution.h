#pragma once

#include "vtkDataObject.h"
#include "vtkVantageFiltersModule.h"

#include <memory>

namespace vantage
{
struct SolvedView;
}

/// A solution of vtkImportanceDrivenShooting that can be looked at from anywhere.
///
/// vtkViewGather makes pictures of it. For that it needs more than the elements' arrays tell: which
/// lamps light an element, how elements nest, and what stands in the way of light. Arrays cannot
/// carry that, and the solver cannot be asked for it either: it goes on changing with the next
/// execution, and goes when its filter does. So the solution travels as a data object of its own,
/// on a port of its own, and the elements stay plain polygons that any filter may cut, merge or
/// write without breaking a tie that nobody sees.
///
/// What is carried never changes: an execution of the source puts a new solution in its output and
/// leaves copies of the old one alone. So ShallowCopy and DeepCopy both share it (DeepCopy copies
/// the field data), it may be used from several threads, and it stays valid when the source
/// executes again or is deleted. Initialize() lets go of it.
///
/// Field data: those of the source's input, so the cameras that came with a scene (CameraName ...)
/// can be chosen by name further down.
///
/// There is no file format for it: write the scene and solve again, or write the elements.
class VTKVANTAGEFILTERS_EXPORT vtkTransportSolution : public vtkDataObject
{
public:
  static vtkTransportSolution* New();
  vtkTypeMacro(vtkTransportSolution, vtkDataObject)
  void PrintSelf(ostream& os, vtkIndent indent) override;

  void Initialize() override;
  void ShallowCopy(vtkDataObject* source) override;
  void DeepCopy(vtkDataObject* source) override;

  /// KiB of the solution, shared with its copies, and of the field data. The geometry, which all
  /// solutions of a scene share with the solver, is not counted.
  unsigned long GetActualMemorySize() override;

  /// False when nothing was solved yet.
  bool HasSolution() const { return this->View != nullptr; }

  ///@{
  /// What is carried, for the filters of this module; null when there is nothing.
  void SetView(std::shared_ptr<const vantage::SolvedView> view);
  const vantage::SolvedView* GetView() const { return this->View.get(); }
  ///@}

  ///@{
  /// The solution in a pipeline's information; null when it holds something else.
  static vtkTransportSolution* GetData(vtkInformation* info);
  static vtkTransportSolution* GetData(vtkInformationVector* vector, int index = 0);
  ///@}

protected:
  vtkTransportSolution();
  ~vtkTransportSolution() override;

private:
  vtkTransportSolution(const vtkTransportSolution&) = delete;
  void operator=(const vtkTransportSolution&) = delete;

  void Share(vtkDataObject* source);

  std::shared_ptr<const vantage::SolvedView> View;
};
