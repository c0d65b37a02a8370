#pragma once

#include "core/Solver.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <memory>
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
  /// Node of the element tree that each cell of the elements is, ascending
  /// (ElementSurface::elements).
  std::vector<NodeId> nodeOfCell;

  /// The cell that shows a node, or None: what lies in a cluster that the solver did not look into
  /// has the cluster's node, which no cell shows.
  std::uint32_t CellOf(NodeId node) const
  {
    const auto found = std::lower_bound(this->nodeOfCell.begin(), this->nodeOfCell.end(), node);
    return found != this->nodeOfCell.end() && *found == node
             ? static_cast<std::uint32_t>(found - this->nodeOfCell.begin())
             : None;
  }

  std::size_t Bytes() const
  {
    return sizeof(SolvedView) + this->snapshot->Bytes() +
           this->nodeOfCell.capacity() * sizeof(NodeId);
  }
};

/// What a solver knows now of the view that it works for. `elements` are its own, of now.
std::shared_ptr<const SolvedView> ViewOf(
  const Solver& solver, const ElementSolution& elements, const Camera& camera);

} // namespace vantage
