#pragma once

#include "core/Solver.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <tuple>
#include <vector>

/// \file SolvedView.h
/// What vtkTransportSolution carries.

namespace vantage
{

/// A solution as one execution of the shooting filter left it, with what is needed to look at it
/// later. It never changes once it is handed out.
struct SolvedView
{
  std::shared_ptr<const SolutionSnapshot> snapshot;
  Camera camera;              ///< the solution was made for
  double errorEstimate = 0.0; ///< StepReport::errorEstimate of the last step
  bool isForItsView = false;  ///< errors are those of that camera's picture (goal-oriented)
  std::shared_ptr<const ElementTree> tree; ///< of the elements, each of whose leaves is a cell
  /// Node of that tree that each cell is, ascending (ElementSurface::elements).
  std::vector<NodeId> nodeOfCell;

  /// The cell that shows a point of a patch. \pre the patch is active
  std::uint32_t CellAt(PatchId patch, const Vec3& point) const
  {
    const NodeId leaf = this->tree->LeafContaining(this->tree->Patches()[patch].node, point);
    return static_cast<std::uint32_t>(
      std::lower_bound(this->nodeOfCell.begin(), this->nodeOfCell.end(), leaf) -
      this->nodeOfCell.begin());
  }

  /// Whether a camera is where the solution's own is, and turned as that is.
  bool LooksAlike(const Camera& other) const
  {
    const auto keyOf = [](const Camera& c)
    { return std::tie(c.eye, c.lookAt, c.up, c.fieldOfView); };
    return keyOf(other) == keyOf(this->camera);
  }
  /// Whether the solution was made for a picture of so many pixels.
  bool IsMadeFor(const Camera& other, int width, int height) const
  {
    return this->LooksAlike(other) && std::abs(this->camera.aspect * height - width) < 1.0;
  }

  std::size_t Bytes() const
  {
    return sizeof(SolvedView) + this->snapshot->Bytes() + this->tree->Size() * sizeof(Node) +
           this->nodeOfCell.capacity() * sizeof(NodeId);
  }
};

/// What a solver knows now of the view that it works for. `elements` are its own, of now.
std::shared_ptr<const SolvedView> ViewOf(
  const Solver& solver, const ElementSolution& elements, const Camera& camera);

} // namespace vantage
