#pragma once

#include "core/transport/HierarchicalField.h"
#include "core/transport/InteractionGraph.h"
#include "core/transport/PairEvaluator.h"
#include "core/transport/Refinement.h"
#include "core/transport/ViewWeights.h"

#include <cstdint>
#include <optional>
#include <vector>

/// \file Transport.h
/// The state of the diffuse solution, and the moves that every method is made of: make the
/// interactions of a patch, shoot radiance or importance over an interaction.

namespace vantage
{

/// What a side of a facet is made of.
struct PatchOptics
{
  Color albedo{ 0.0 };
  Color emission{ 0.0 }; ///< W m^-2 sr^-1
};

struct TransportSettings
{
  RefinementSettings refinement;
  Accuracy accuracy = Accuracy::Default;
  std::uint32_t visibilityRays = 16;
};

/// What was done so far.
struct TransportCounters
{
  std::uint64_t evaluations = 0; ///< pairs whose throughput and visibility were computed
  std::uint64_t rays = 0;        ///< shadow rays
};

/// total - shot, where total >= shot but for round-off. A difference of a few roundings is nothing
/// at all, or it would be shot for ever.
Color UnshotPart(const Color& total, const Color& shot);

/// Radiance and importance of all elements, and the interactions over which both are shot
/// (Bekaert and Willems 1995, section 3, in the diffuse case):
///
///     L_i = E_i + rho_i sum_k F_ik L_k          P_i = V_i + sum_j F_ij Y_j,   Y_j = rho_j P_j
///
/// An interaction remembers what it has carried, so what is unshot is a difference, and adding to a
/// patch is O(level) however many interactions it has. When an interaction is refined, its children
/// are taken to have shot the same fraction of what their ends have as it had: what is unshot
/// stays what it was, nothing is ever taken back, and radiance, importance and flux only grow.
class Transport
{
public:
  /// `optics` has one entry for each patch of the tree; `occluders` must outlive this.
  Transport(ElementTree tree, const OccluderScene& occluders, std::vector<PatchOptics> optics,
    double meanFacetArea, const TransportSettings& settings);

  /// Other materials: radiance and importance start anew, interactions stay.
  void SetOptics(std::vector<PatchOptics> optics);

  /// Another view: importance starts anew, radiance and interactions stay.
  void SetView(std::vector<ViewSample> samples);

  /// \name Moves
  /// `step` is noted in the interactions that are made.
  ///@{
  /// Makes the interactions of a patch with all patches that are not expanded yet (those have
  /// made theirs with it already). The F oracle refines them at once, so that radiance and
  /// importance travel over the very same ones.
  void Expand(PatchId patch, std::uint32_t step);
  bool IsExpanded(PatchId patch) const { return this->Expanded[patch] != 0; }

  /// Refines interactions that are too coarse for the radiance that leaves their end on the patch
  /// (or, with Other ends, arrives at it), until none is.
  enum class Flow
  {
    Leaving,
    Arriving
  };
  void RefineInteractionsOf(PatchId patch, Flow flow, std::uint32_t step);
  /// The same for one interaction and one direction; true when its children replaced it.
  bool RefineInteraction(InteractionId id, End shooter, std::uint32_t step);

  void ShootRadiance(InteractionId id, End shooter);
  void ShootImportance(InteractionId id, End shooter);
  ///@}

  /// \name What an interaction has to carry
  ///@{
  Color LeavingRadiance(InteractionId id, End shooter) const;   ///< L of the shooter toward it
  Color LeavingImportance(InteractionId id, End shooter) const; ///< Y of the shooter toward it
  Color UnshotRadiance(InteractionId id, End shooter) const;    ///< dL, >= 0
  Color UnshotImportance(InteractionId id, End shooter) const;  ///< dY, >= 0
  ///@}

  /// \name Means over a node
  ///@{
  Color Radiance(NodeId node) const;           ///< L, W m^-2 sr^-1
  Color ReceivedImportance(NodeId node) const; ///< P - V, sr m^-2
  Color Importance(NodeId node) const;         ///< P, sr m^-2
  double ViewImportance(NodeId node) const;    ///< V, sr m^-2
  ///@}

  /// Estimate of the view flux from below, <V, Ls> + <P, r>. Shooting radiance r over an
  /// interaction whose importance the other way is unshot by q adds r G q to it, and so does
  /// shooting that importance: the error is a product of two residuals.
  const Color& ViewFluxEstimate() const { return this->FluxEstimate; }
  /// <V, L> of the radiance received so far.
  const Color& ViewFluxReceived() const { return this->FluxReceived; }

  /// The same from the leaves, summed afresh: <V, L> and <E, P>. O(elements).
  Color ViewFluxOfRadiance() const;
  Color ViewFluxOfImportance() const;

  /// Power that the emitters emit, W, mean of channels.
  double EmittedPower() const { return this->TotalEmittedPower; }
  /// Of all sides that take part: their area, and their albedo, mean over area and channels.
  double TotalArea() const { return this->AreaOfAll; }
  double MeanAlbedo() const { return this->AlbedoOfAll; }
  bool HasView() const { return this->IsViewSet; }

  const ElementTree& Tree() const { return this->TheTree; }
  InteractionGraph& Graph() { return this->TheGraph; }
  const InteractionGraph& Graph() const { return this->TheGraph; }
  const PatchOptics& OpticsOf(PatchId patch) const { return this->Optics[patch]; }
  const TransportCounters& Counters() const { return this->Counts; }
  std::size_t Bytes() const;

private:
  struct Refinement
  {
    InteractionId parent;
    End splitEnd;
  };

  Color Brdf(NodeId node) const;
  std::optional<End> EndToSplit(InteractionId id, End shooter) const;
  void Refine(const std::vector<Refinement>& refinements, std::uint32_t step);
  void SplitNode(NodeId node);
  std::vector<NodeId> PatchesInFrontOf(PatchId patch) const;
  Interaction MakeInteraction(
    const ElementPair& pair, const PairValue& value, std::uint32_t step) const;
  void InheritShotParts(Interaction& child, const Interaction& parent) const;
  std::vector<PairValue> EvaluateAndCount(const std::vector<ElementPair>& pairs);
  void MeasureOptics();
  void ResetFlux();

  ElementTree TheTree;
  std::vector<PatchOptics> Optics;
  PairEvaluator Evaluator;
  Refiner TheRefiner;
  InteractionGraph TheGraph;
  HierarchicalField ReceivedRadiance;
  HierarchicalField ReceivedImportances;
  ViewWeights View;
  bool IsViewSet = false;
  std::vector<char> Expanded; ///< of each patch: all its interactions exist
  Color FluxEstimate{ 0.0 };
  Color FluxReceived{ 0.0 };
  double TotalEmittedPower = 0.0;
  double StrongestEmitterPower = 0.0;
  double AreaOfAll = 0.0;
  double AlbedoOfAll = 0.0;
  TransportCounters Counts;
};

} // namespace vantage
