#include "core/goal/GoalOrientedTransport.h"

#include "core/goal/LargestFirst.h"
#include "core/goal/RowClosure.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace vantage
{

namespace
{

/// Sweeps end when this part of the last estimate of the error is left to come, as far as that is
/// not above the largest one, or the least tolerance.
constexpr double SweptPart = 0.02;
constexpr double LargestEstimate = 0.2;
constexpr double LeastTolerance = 5e-4;
constexpr int MostSweeps = 1000;
/// From one sweep to the next, the change falls by this at least, or else the sums get balanced.
constexpr double SlowFall = 0.8;
/// A view that is darker than this part of the mean radiance of all surfaces is black: errors are
/// relative to that then. Six decades lie between a street in the sun and one under stars.
constexpr double Darkness = 1e-6;
/// Part of all errors, as squares, that links which may be refined must have, or else the estimate
/// would hardly fall by a tenth, however many of them were. That may be wrong as long as
/// there are clusters in which lamps hide, but not with so many links.
constexpr double LeastGain = 0.1;
constexpr std::size_t LinksToGiveUp = 200000;
/// Over the least error that is refined in a round, as squares: a new link from which more is to be
/// expected is refined in the same round. So a chain of links, as it leads from a cluster down to
/// the lamp in it, needs one solution and not one for each. 8 to 30 cost the same.
constexpr double RefinedAgain = 30.0;

} // namespace

GoalOrientedTransport::GoalOrientedTransport(ElementTree tree, const OccluderScene& occluders,
  std::vector<PatchOptics> optics, double meanFacetArea, const GoalOrientedSettings& settings)
  : Open(std::move(tree), occluders, std::move(optics))
  , Occluders(&occluders)
  , Settings(settings)
  , Splits(settings.minimumElementSize * std::sqrt(meanFacetArea), settings.maximumLevel)
  , Evaluator(this->Open, occluders, settings.visibilityRays, settings.seed)
{
  this->Evaluate({ LinkRequest{ { 0, 0 } } });
  this->FollowTree();
}

void GoalOrientedTransport::SetOptics(std::vector<PatchOptics> optics)
{
  this->Open.SetOptics(std::move(optics));
  this->Interactions.WakeAll();
  this->FollowTree();
  this->SetSources();
  this->RadianceFlow.Clear();
  this->ImportanceFlow.Clear();
}

void GoalOrientedTransport::SetView(std::vector<ViewSample> samples)
{
  this->Open.SetView(std::move(samples));
  this->Interactions.WakeAll();
  this->FollowTree();
  this->SetSources();
  this->ImportanceFlow.Clear();
}

void GoalOrientedTransport::FollowTree()
{
  const auto firstNew = static_cast<OpenId>(this->Factors[WithCluster].size());
  this->RadianceFlow.Follow(this->Open);
  this->ImportanceFlow.Follow(this->Open);
  this->Interactions.Follow(this->Open);
  this->Splits.Follow(this->Open);
  for (OpenId id = firstNew; id < this->Open.Size(); ++id)
  {
    for (std::vector<double>& factors : this->Factors)
    {
      factors.push_back(id == 0 ? 1.0 : factors[this->Open[id].parent]);
    }
    this->SetSource(id);
  }
}

void GoalOrientedTransport::SetSource(OpenId id)
{
  const OpenNode& node = this->Open[id];
  this->RadianceFlow.SetSource(id, node.emission, node.emissionRms);
  if (node.IsExposed())
  {
    const Color reflection = node.albedo / Pi;
    const double view = this->Settings.importance ? node.view / node.area : 1.0;
    const double viewRms = this->Settings.importance ? node.viewRms : 1.0;
    this->ImportanceFlow.SetSource(id, reflection * view, Mean(reflection) * viewRms);
  }
}

void GoalOrientedTransport::SetSources()
{
  for (OpenId id = 0; id < this->Open.Size(); ++id)
  {
    this->SetSource(id);
  }
}

void GoalOrientedTransport::Solve()
{
  this->FollowTree();
  this->Open.SumAreas();
  const bool areAllAwake = this->Interactions.WakeWhenDue();
  const std::vector<Link>& links = this->Interactions.Awake();
  const LinkMatrix matrix(this->Open, links, this->Interactions.RestingNodes());
  CloseRows(this->Open, matrix, this->Factors);
  for (Flow* flow : { &this->RadianceFlow, &this->ImportanceFlow })
  {
    this->Converge(matrix, *flow);
    flow->FindSpreads(this->Open, matrix, links);
  }
  this->ImportanceFlow.FindStraight(matrix, this->Factors);
  this->Rank();
  if (areAllAwake)
  {
    const double ofAll = this->Errors.All();
    if (this->Interactions.LetRest(this->Open, this->PartsInView()))
    {
      this->Rank();
    }
    const double ofAwake = this->Errors.All();
    this->ErrorAtRest = std::sqrt(std::max(0.0, ofAll * ofAll - ofAwake * ofAwake));
  }
  const double error = std::hypot(this->Errors.All(), this->ErrorAtRest);
  // Infinite where nothing is known to be lit yet.
  this->Estimate = error > 0.0 ? error / this->Goal() : 0.0;
}

void GoalOrientedTransport::Rank()
{
  this->Errors = LinkErrors(this->Open, this->Interactions.Awake(), this->RadianceFlow,
    this->ImportanceFlow, this->Factors, this->Hidden);
}

/// Radiance times importance, but where little light is known the view may yet find some.
std::vector<double> GoalOrientedTransport::PartsInView() const
{
  const double mean = Mean(this->RadianceFlow.Value(0));
  std::vector<double> parts(this->Open.Size(), 0.0);
  for (OpenId id = 0; id < this->Open.Size(); ++id)
  {
    const OpenNode& node = this->Open[id];
    if (node.IsLeaf())
    {
      const double seen = this->Settings.importance ? node.view : node.area;
      const double importance = seen + node.area * Mean(this->ImportanceFlow.Arriving(id));
      parts[id] = importance * (mean + Mean(this->RadianceFlow.Value(id)));
    }
  }
  return parts;
}

void GoalOrientedTransport::Converge(const LinkMatrix& matrix, Flow& flow)
{
  // What a sweep changes falls by the same factor each time in the end: what is left to come is the
  // rest of a geometric series.
  const double tolerance =
    std::max(LeastTolerance, SweptPart * std::min(this->Estimate, LargestEstimate));
  double lastChange = 0.0;
  bool isBalanced = false;
  for (int sweep = 0; sweep < MostSweeps; ++sweep)
  {
    const double change = this->Sweep(matrix, flow, isBalanced);
    const double slowing = lastChange - change;
    if (change == 0.0 || (change < tolerance && change * change < tolerance * slowing))
    {
      break;
    }
    // A balanced sweep is no member of the series: what comes after it starts a new one.
    const bool isSlow = lastChange > 0.0 && change > SlowFall * lastChange;
    lastChange = isBalanced ? 0.0 : change;
    isBalanced = !isBalanced && isSlow;
  }
  // The tolerance is of one sign all over: what is left of the sum is known without sweeping on.
  this->Sweep(matrix, flow, true);
}

double GoalOrientedTransport::Sweep(const LinkMatrix& matrix, Flow& flow, bool isBalanced)
{
  ++this->Counts.sweeps;
  this->Counts.sweptLinks += this->Interactions.Awake().size();
  return flow.Sweep(matrix, this->Factors, isBalanced);
}

double GoalOrientedTransport::Goal() const
{
  if (this->Settings.importance)
  {
    const double darkness = Darkness * this->Open[0].view * Mean(this->RadianceFlow.Value(0));
    return std::max(Mean(this->ViewFlux()), darkness);
  }
  double flux = 0.0;
  for (OpenId id = 0; id < this->Open.Size(); ++id)
  {
    if (this->Open[id].IsLeaf())
    {
      flux += this->Open[id].area * Mean(this->RadianceFlow.Value(id));
    }
  }
  return flux;
}

Color GoalOrientedTransport::ViewFlux() const
{
  Color flux = this->Open.EmissionInView();
  for (OpenId id = 0; id < this->Open.Size(); ++id)
  {
    if (this->Open[id].IsLeaf())
    {
      flux += this->Open[id].view * this->RadianceFlow.Received(id);
    }
  }
  return flux;
}

Color GoalOrientedTransport::ViewFluxOfImportance() const
{
  Color flux = this->Open.EmissionInView();
  for (OpenId id = 0; id < this->Open.Size(); ++id)
  {
    const OpenNode& node = this->Open[id];
    if (node.IsLeaf() && node.IsExposed())
    {
      flux += node.emission * node.area * this->ImportanceFlow.Arriving(id);
    }
  }
  return flux;
}

std::size_t GoalOrientedTransport::LeafCount() const
{
  std::size_t count = 0;
  for (OpenId id = 0; id < this->Open.Size(); ++id)
  {
    count += this->Open[id].IsLeaf() && !this->Open[id].IsCluster() ? 1 : 0;
  }
  return count;
}

std::size_t GoalOrientedTransport::Refine(double share)
{
  std::vector<std::uint32_t> worst = this->LinksToRefine();
  if (worst.empty() && this->Interactions.DoSomeRest())
  {
    this->Interactions.WakeAll();
    this->Rank();
    worst = this->LinksToRefine();
  }
  worst.resize(MoveLargestFirst(worst, this->Errors.OfLinks(), share));
  const double again = RefinedAgain * this->LeastError(worst);
  std::sort(worst.begin(), worst.end());
  ++this->Counts.rounds;
  std::size_t count = 0;
  std::vector<Link> refined = this->Interactions.TakeOut(worst);
  while (!refined.empty())
  {
    count += refined.size();
    const std::size_t firstNew = this->Interactions.Awake().size();
    this->Replace(refined);
    this->FollowTree();
    this->Errors.Follow(this->Open, this->RadianceFlow, this->ImportanceFlow);
    refined = this->TakeOutBad(firstNew, again);
  }
  this->Counts.refined += count;
  return count;
}

double GoalOrientedTransport::LeastError(const std::vector<std::uint32_t>& links) const
{
  const std::vector<double>& errors = this->Errors.OfLinks();
  const double sum = std::accumulate(errors.begin(), errors.end(), 0.0);
  double least = sum;
  for (const std::uint32_t i : links)
  {
    least = std::min(least, errors[i]);
  }
  return std::max(least, sum / static_cast<double>(errors.size()));
}

void GoalOrientedTransport::Replace(const std::vector<Link>& links)
{
  std::vector<LinkRequest> requests;
  std::vector<std::size_t> ends; ///< in the requests, of what replaces each
  for (const Link& link : links)
  {
    this->AppendRequests(link, requests);
    ends.push_back(requests.size());
  }
  const std::vector<double> throughputs = this->Evaluate(requests);
  std::size_t next = 0;
  for (std::size_t i = 0; i < links.size(); ++i)
  {
    double carried = 0.0;
    for (; next < ends[i]; ++next)
    {
      carried += throughputs[next];
    }
    if (HiddenLight::Concerns(this->Open, links[i]))
    {
      this->Hidden.Learn(links[i], carried);
    }
  }
}

std::vector<Link> GoalOrientedTransport::TakeOutBad(std::size_t first, double least)
{
  const std::vector<Link>& links = this->Interactions.Awake();
  std::vector<std::uint32_t> bad;
  for (std::size_t i = first; i < links.size(); ++i)
  {
    if (this->Splits.MayRefine(links[i]) &&
        this->Errors.Expected(this->Open, links[i], this->Hidden) >= least)
    {
      bad.push_back(static_cast<std::uint32_t>(i));
    }
  }
  return this->Interactions.TakeOut(bad);
}

std::vector<std::uint32_t> GoalOrientedTransport::LinksToRefine() const
{
  std::vector<std::uint32_t> refinable;
  double ofRefinable = 0.0;
  double ofAll = 0.0;
  for (std::uint32_t i = 0; i < this->Errors.OfLinks().size(); ++i)
  {
    ofAll += this->Errors.OfLinks()[i];
    if (this->Errors.OfLinks()[i] > 0.0 && this->Splits.MayRefine(this->Interactions.Awake()[i]))
    {
      ofRefinable += this->Errors.OfLinks()[i];
      refinable.push_back(i);
    }
  }
  const bool isUseless =
    this->Interactions.Size() > LinksToGiveUp && ofRefinable < LeastGain * ofAll;
  return isUseless ? std::vector<std::uint32_t>() : refinable;
}

std::vector<OpenId> GoalOrientedTransport::Parts(OpenId id, bool isSplit)
{
  if (!isSplit)
  {
    return { id };
  }
  this->Open.Open(id);
  std::vector<OpenId> parts(this->Open[id].childCount);
  std::iota(parts.begin(), parts.end(), this->Open[id].firstChild);
  return parts;
}

void GoalOrientedTransport::AppendRequests(const Link& link, std::vector<LinkRequest>& requests)
{
  const std::array<bool, 2> split = this->Splits.EndsToSplit(this->Open, link);
  const std::vector<OpenId> first = this->Parts(link.ends[0], split[0]);
  const std::vector<OpenId> second = this->Parts(link.ends[1], split[1]);
  for (const OpenId a : first)
  {
    for (const OpenId b : second)
    {
      const bool isTwice = link.IsSelf() && b < a;
      const bool isFlat = a == b && !this->Open[a].IsCluster();
      if (!isTwice && !isFlat && this->Open[a].IsExposed() && this->Open[b].IsExposed())
      {
        requests.push_back({ { a, b }, link.visibility, link.agreeingRays });
      }
    }
  }
}

std::vector<double> GoalOrientedTransport::Evaluate(const std::vector<LinkRequest>& requests)
{
  std::vector<EvaluatedLink> made(requests.size());
  std::vector<double> throughputs;
  throughputs.reserve(requests.size());
  tbb::parallel_for(std::size_t(0), requests.size(),
    [&](std::size_t i) { made[i] = this->Evaluator.Evaluate(requests[i]); });
  for (EvaluatedLink& result : made)
  {
    Link& link = result.link;
    link.step = this->Counts.rounds;
    throughputs.push_back(link.throughput);
    const bool hasCluster = HasCluster(this->Open, link);
    ++(hasCluster ? this->Counts.clusterPairs : this->Counts.surfacePairs);
    this->Counts.linkRays += result.rays;
    this->Counts.certified += result.rays == 0 && !hasCluster && !result.isKnownHidden ? 1 : 0;
    if (result.isKnownHidden)
    {
      ++this->Counts.hidden;
      continue;
    }
    this->Interactions.Add(link);
  }
  return throughputs;
}

std::size_t GoalOrientedTransport::Bytes() const
{
  return this->Open.Bytes() + this->Interactions.Bytes() + this->Errors.Bytes() +
         2 * this->Factors[WithCluster].capacity() * sizeof(double) + this->Splits.Bytes() +
         this->RadianceFlow.Bytes() + this->ImportanceFlow.Bytes();
}

} // namespace vantage
