#pragma once

#include "core/goal/Flow.h"
#include "core/goal/HiddenLight.h"
#include "core/goal/LinkErrors.h"
#include "core/goal/LinkEvaluator.h"
#include "core/goal/LinkSet.h"
#include "core/goal/SplitRule.h"

#include <cstdint>
#include <vector>

/// \file GoalOrientedTransport.h
/// Only the interactions that the view needs.

namespace vantage
{

struct GoalOrientedSettings
{
  std::uint32_t visibilityRays = 16; ///< a pair that is partly visible, 1 .. 1024
  double minimumElementSize = 0.05;  ///< RefinementSettings::minimumElementSize
  int maximumLevel = 10;             ///< splits below a patch
  bool importance = true;            ///< false: every surface matters as much as another
  std::uint64_t seed = 1;            ///< of points and rays between the ends of links
};

/// What was done so far, where it was done.
struct GoalOrientedCounters
{
  std::uint64_t surfacePairs = 0; ///< links between patches or elements that were evaluated
  std::uint64_t clusterPairs = 0;
  std::uint64_t linkRays = 0;
  std::uint64_t refined = 0;   ///< links replaced by finer ones
  std::uint64_t certified = 0; ///< whose visibility was taken over from their parent
  std::uint64_t hidden = 0;    ///< dropped: nothing passes
  std::uint64_t sweeps = 0;
  std::uint64_t sweptLinks = 0; ///< that sweeps have gone over
  std::uint32_t rounds = 0;
};

/// Hierarchical interactions over clusters, patches and elements, made on demand from a single one
/// between the root and itself. The graph that exists is solved nearly to convergence, for radiance
/// and for importance; then the links with the largest part in the error of the view are refined,
/// both in order and in number as importance tells (the combination that the conclusion of Bekaert
/// and Willems 1995 asks for; dual weighted residuals: Becker and Rannacher 2001).
///
/// The picture is gathered (view/ViewGather.h): lamps are integrated at every pixel, and again at
/// the surfaces one reflection away, where all other radiance is looked up. So an error of that
/// counts as much as the importance that a surface *receives*, an error of what lamps give as much
/// as the importance that it receives over two reflections or more: links from lamps need not be
/// fine, only known, on what the eye sees and on what lights that.
class GoalOrientedTransport
{
public:
  /// `occluders` must outlive this.
  GoalOrientedTransport(ElementTree tree, const OccluderScene& occluders,
    std::vector<PatchOptics> optics, double meanFacetArea, const GoalOrientedSettings& settings);

  /// Other materials: radiance and importance start anew, links stay.
  void SetOptics(std::vector<PatchOptics> optics);
  /// Another view: importance starts anew, radiance and links stay.
  void SetView(std::vector<ViewSample> samples);

  /// Solves for radiance and importance on the links there are and ranks these. O(links) a sweep;
  /// in most calls those that rest (LinkSet.h) do not take part.
  void Solve();
  /// Replaces the links with the largest errors by finer ones, `share` of all in (0, 1], and those
  /// among these again from which errors as large are to be expected. Returns how many; 0 when
  /// that is of no use any more, as elements are as small as they may be. \pre Solve
  std::size_t Refine(double share);

  /// Of the relative L1 error of a gathered picture, the part that comes from the links. \pre Solve
  double ErrorEstimate() const { return this->Estimate; }
  /// <V, L>: light through the view, W m^-2. \pre Solve
  Color ViewFlux() const;
  /// The same from the other side, <E, P>. \pre Solve
  Color ViewFluxOfImportance() const;
  /// Leaves of the opened tree that are patches or elements.
  std::size_t LeafCount() const;

  const OpenTree& Tree() const { return this->Open; }
  /// A copy.
  std::vector<Link> Links() const { return this->Interactions.All(); }
  std::size_t LinkCount() const { return this->Interactions.Size(); }
  const Flow& Radiance() const { return this->RadianceFlow; }
  const Flow& Importance() const { return this->ImportanceFlow; }
  /// The factor d of a node, of its links of a kind (RowClosure.h).
  double ClosureOf(LinkKind kind, OpenId id) const { return this->Factors[kind][id]; }
  const GoalOrientedCounters& Counters() const { return this->Counts; }
  std::size_t Bytes() const;

private:
  /// Makes room for what is known of new nodes.
  void FollowTree();
  void SetSource(OpenId id);
  void SetSources();
  void Converge(const LinkMatrix& matrix, Flow& flow);
  double Sweep(const LinkMatrix& matrix, Flow& flow, bool isBalanced);
  /// Finds the errors of the links that are awake.
  void Rank();
  /// Of each leaf, in the unit of the view flux: what its light may have to do with the view.
  std::vector<double> PartsInView() const;
  /// What errors are relative to: the view flux, unless that is next to nothing, or what it is when
  /// all surfaces matter alike.
  double Goal() const;
  /// Those that have an error and an end that may be split; none where there are many links and
  /// nearly all of the error is between elements that may not.
  std::vector<std::uint32_t> LinksToRefine() const;
  /// Of some links, or the mean of all when that is larger.
  double LeastError(const std::vector<std::uint32_t>& links) const;
  /// Makes the finer links that stand for some that were taken out.
  void Replace(const std::vector<Link>& links);
  /// Takes out those from a place on that may be refined and are to be expected to have errors of
  /// `least` or more.
  std::vector<Link> TakeOutBad(std::size_t first, double least);
  void AppendRequests(const Link& link, std::vector<LinkRequest>& requests);
  std::vector<OpenId> Parts(OpenId id, bool isSplit);
  /// Returns the throughput of each.
  std::vector<double> Evaluate(const std::vector<LinkRequest>& requests);

  OpenTree Open;
  const OccluderScene* Occluders;
  GoalOrientedSettings Settings;
  SplitRule Splits;
  LinkEvaluator Evaluator;
  LinkSet Interactions;
  LinkErrors Errors;        ///< of those that are awake
  double ErrorAtRest = 0.0; ///< what the others add to that, as squares
  HiddenLight Hidden;
  Closure Factors;
  Flow RadianceFlow;
  Flow ImportanceFlow;
  double Estimate = 0.0;
  GoalOrientedCounters Counts;
};

} // namespace vantage
