#pragma once

#include "core/transport/HierarchicalField.h"
#include "core/transport/InteractionGraph.h"
#include "core/transport/PairEvaluator.h"
#include "core/transport/PatchOptics.h"
#include "core/transport/RadiancePrediction.h"
#include "core/transport/Refinement.h"
#include "core/transport/ViewWeights.h"

#include <cstdint>
#include <vector>

/// \file Transport.h
/// The state of the diffuse solution, and the moves that every method is made of: make the
/// interactions of a patch, shoot radiance or importance over an interaction.

namespace vantage
{

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

/// Radiance and importance of all elements, and the interactions over which both are shot
/// (Bekaert and Willems 1995, section 3, in the diffuse case):
///
///     L_i = E_i + rho_i sum_k F_ik L_k          P_i = V_i + sum_j F_ij Y_j,   Y_j = rho_j P_j
///
/// An interaction remembers what it has carried, so what is unshot is a difference, and adding to a
/// patch is O(level) however many interactions it has. The interactions of a patch are made
/// all at once (Expand), as fine as the tolerances ask, and never change: they depend on the scene
/// only, not on the order of the steps. A patch is expanded before it shoots for the first time;
/// from then on its elements are final and its rows are closed (Closure.h). Radiance, importance
/// and flux only grow, but for the elements of a patch at the moment it is expanded.
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
  /// Makes the interactions of a patch with all patches that are not expanded yet (the others have
  /// made theirs with it already).
  void Expand(PatchId patch, std::uint32_t step);
  bool IsExpanded(PatchId patch) const { return this->Expanded[patch] != 0; }

  /// Expands the next patch that the eye sees directly; false when all are. A flux estimate is
  /// known not to fall once this has been done.
  bool ExpandNextVisible(std::uint32_t step);

  /// \pre the shooter's patch is expanded
  void ShootRadiance(InteractionId id, End shooter);
  /// \pre the shooter's patch is expanded
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
  Color Radiance(NodeId node) const;            ///< L, W m^-2 sr^-1
  Color Importance(NodeId node) const;          ///< P, sr m^-2
  Color ReceivedImportance(NodeId node) const;  ///< P - V, sr m^-2
  Color ReflectedImportance(NodeId node) const; ///< Y = rho P, m^-2
  double ViewImportance(NodeId node) const;     ///< V, sr m^-2
  double ClosureWeight(NodeId leaf) const;      ///< of what it receives (Closure.h)
  ///@}

  /// Estimate of the view flux from below, <V, Ls> + <P, r> over the expanded patches. Shooting
  /// radiance r over an interaction whose importance the other way is unshot by q adds r G q to
  /// it, and so does shooting that importance: the error is a product of two residuals.
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
  const InteractionGraph& Graph() const { return this->TheGraph; }
  const PatchOptics& OpticsOf(PatchId patch) const { return this->Optics[patch]; }
  const TransportCounters& Counters() const { return this->Counts; }
  std::size_t Bytes() const;

  // The prediction refers to the tree and the optics.
  Transport(const Transport&) = delete;
  Transport& operator=(const Transport&) = delete;

private:
  static constexpr double NotPredicted = -1.0;

  /// A pair on its way to become an interaction.
  struct Candidate
  {
    ElementPair pair;
    PairValue value;
  };

  Color Brdf(NodeId node) const;
  std::vector<NodeId> PatchesInFrontOf(PatchId patch) const;
  std::vector<Candidate> RootCandidates(PatchId patch);
  std::vector<Candidate> Refine(const Candidate& coarse, SplitChoice choice);
  void Evaluate(std::vector<Candidate>& candidates);
  SplitChoice ChooseSplit(const Candidate& candidate);
  std::vector<NodeId> Parts(NodeId node, bool isSplit);
  double PredictedRadiance(PatchId patch);
  void SplitNode(NodeId node);
  void AddInteraction(const Candidate& candidate, std::uint32_t step);
  void CloseRows(PatchId patch);
  void WeighView(NodeId patch);
  void MeasureOptics();
  void ResetFlux();

  ElementTree TheTree;
  const OccluderScene* Occluders;
  std::vector<PatchOptics> Optics;
  PairEvaluator Evaluator;
  Refiner TheRefiner;
  RadiancePrediction Prediction;
  std::vector<double> Predicted; ///< of each patch
  InteractionGraph TheGraph;
  HierarchicalField RadianceField;   ///< irradiance received; reflected by weight times BRDF
  HierarchicalField ImportanceField; ///< P - V
  ViewWeights View;
  std::vector<double> WeightedView;    ///< of each node: mean of closure factor times V
  std::vector<PatchId> VisiblePatches; ///< that the eye sees and are not expanded; next at the back
  bool IsViewSet = false;
  std::vector<char> Expanded; ///< of each patch: all its interactions exist
  Color FluxEstimate{ 0.0 };
  Color FluxReceived{ 0.0 };
  double TotalEmittedPower = 0.0;
  double AreaOfAll = 0.0;
  double AlbedoOfAll = 0.0;
  TransportCounters Counts;
};

/// total - shot, where total >= shot but for round-off. A difference of a few roundings is nothing
/// at all, or it would be shot for ever.
Color UnshotPart(const Color& total, const Color& shot);

} // namespace vantage
