#include "core/view/LampView.h"

#include "core/math/ScrambledSobol.h"
#include "core/mesh/Bounds.h"
#include "core/view/SmoothFit.h"

#include <tbb/parallel_invoke.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace vantage
{

namespace
{

/// Groups of so many spots are not halved further; with few facets in the way, nor are larger ones,
/// unless there is a tolerance.
constexpr int SmallGroup = 32;
constexpr int SmallGroupOfFewFacets = 64;
constexpr std::size_t FewFacets = 2;
/// To ask at each of so few whether an occluder is in the way is no more work than to ask for all.
constexpr int FewSpots = 4;
/// Groups of more spots are worth the thirteen values that a smooth fit takes.
constexpr int LeastToFit = 24;
constexpr int ShadowRays = 256;
/// Larger groups are halved on two threads.
constexpr int ParallelGroup = 256;

/// How far away the lamp reaches.
double ReachOf(const NamedLamp& lamp, const Vec3& from)
{
  const std::vector<Vec3>& corners = lamp.surface.Corners();
  return RadiusAround({ corners.data(), static_cast<int>(corners.size()) }, from);
}

/// The rectangle around spots.
std::pair<Vec2, Vec2> Around(const LampSpot* first, const LampSpot* last)
{
  Vec2 low = first->place;
  Vec2 high = low;
  for (const LampSpot* spot = first; spot != last; ++spot)
  {
    low = glm::min(low, spot->place);
    high = glm::max(high, spot->place);
  }
  return { low, high };
}

} // namespace

LampView::LampView(const OccluderScene& occluders, std::uint32_t facet, const PatchFrame& frame,
  const NamedLamp& lamp)
  : Occluders(&occluders)
  , Facet(facet)
  , Frame(&frame)
  , Named(&lamp)
  , Unit(ReachOf(lamp, frame.origin))
  , Lamp(lamp.surface.In(frame, this->Unit))
{
  if (this->Lamp.Size() > 0 && this->Lamp.IsFlat())
  {
    this->Front = this->Lamp.PlaneOf(0);
  }
  for (const Vec3& corner : this->Lamp.Corners())
  {
    this->Corners.push_back(frame.ToWorld(corner * this->Unit));
  }
}

DirectCounters LampView::Look(
  LampSpot* first, LampSpot* last, double tolerance, double* factors) const
{
  for (LampSpot* spot = first; spot != last; ++spot)
  {
    factors[spot->index] = 0.0;
  }
  if (this->Lamp.Size() == 0 || this->Named->IsOfConvexPart(this->Facet) || first == last)
  {
    return {};
  }
  Group all{ first, last, {} };
  const Search search{ this->ObstaclesOf(all), tolerance };
  for (std::uint32_t k = 0; k < search.obstacles.Size(); ++k)
  {
    all.suspects.push_back({ k });
  }
  DirectCounters counters = this->Look(std::move(all), search, factors);
  ++counters.occluderQueries;
  return counters;
}

/// The rectangle around the spots, as far as it is in front of a flat lamp. Local.
Polygon LampView::Bounds(const Group& group) const
{
  constexpr double margin = 1e-6;
  const auto [first, last] = Around(group.first, group.last);
  const Vec2 low = first / this->Unit - margin;
  const Vec2 high = last / this->Unit + margin;
  const Polygon bounds{ { low.x, low.y, 0.0 }, { high.x, low.y, 0.0 }, { high.x, high.y, 0.0 },
    { low.x, high.y, 0.0 } };
  return this->Front ? ClipToFront(bounds, *this->Front, LampSurface::Touching) : bounds;
}

Polygon LampView::ToWorld(const Polygon& local) const
{
  Polygon world;
  for (const Vec3& v : local)
  {
    world.Add(this->Frame->ToWorld(v * this->Unit));
  }
  return world;
}

/// What holds all ways from a polygon of the patch to the lamp.
std::optional<ConvexRegion> LampView::ShaftFrom(const Polygon& ground) const
{
  const double tolerance = this->Occluders->Tolerance();
  return this->Lamp.Size() == 1
           ? Shaft(ground, this->ToWorld(this->Lamp.Face(0)), tolerance)
           : std::optional<ConvexRegion>(ShaftTo(ground, this->Corners, tolerance));
}

/// Those that reach into what is between a polygon of the patch and the lamp.
std::vector<std::uint32_t> LampView::FacetsFrom(const Polygon& ground) const
{
  if (const auto shaft = this->ShaftFrom(ground))
  {
    return this->Occluders->FacetsInRegion(*shaft);
  }
  vantage::Bounds box;
  for (const Vec3& v : ground)
  {
    box.Add(v);
  }
  for (const Vec3& v : this->Corners)
  {
    box.Add(v);
  }
  return this->Occluders->FacetsInBox(box.Low(), box.High());
}

LampObstacles LampView::ObstaclesOf(const Group& all) const
{
  const Polygon bounds = this->Bounds(all);
  return { this->Place(),
    bounds.Empty() ? std::vector<std::uint32_t>() : this->FacetsFrom(this->ToWorld(bounds)) };
}

/// Leaves the occluders that reach into what is between the spots and the lamp. Returns false when
/// nothing of the lamp is seen.
bool LampView::Narrow(Group& group, const Search& search) const
{
  const Polygon bounds = this->Bounds(group);
  if (bounds.Empty())
  {
    return false;
  }
  if (group.suspects.empty())
  {
    return true;
  }
  const Polygon ground = this->ToWorld(bounds);
  this->LookForBodies(group, search, ground);
  if (group.last - group.first <= FewSpots)
  {
    return true;
  }
  if (const auto shaft = this->ShaftFrom(ground))
  {
    const auto isElsewhere = [&](const LampCutter::Suspect& suspect)
    { return search.obstacles.IsElsewhere(suspect.occluder, *shaft); };
    group.suspects.erase(std::remove_if(group.suspects.begin(), group.suspects.end(), isElsewhere),
      group.suspects.end());
  }
  return std::none_of(group.suspects.begin(), group.suspects.end(),
    [&](const LampCutter::Suspect& suspect)
    { return search.obstacles.Cutter().Occluders().HidesAll(suspect.occluder, bounds); });
}

/// Finds out which bodies are elsewhere.
void LampView::LookForBodies(Group& group, const Search& search, const Polygon& ground) const
{
  vantage::Bounds box;
  for (const Vec3& corner : ground)
  {
    box.Add(corner);
  }
  for (LampCutter::Suspect& suspect : group.suspects)
  {
    suspect.isSeenFromOutside =
      suspect.isSeenFromOutside || search.obstacles.IsSeenFromOutside(suspect.occluder, box);
  }
}

DirectCounters LampView::Look(Group group, const Search& search, double* factors) const
{
  DirectCounters counters;
  if (!this->Narrow(group, search))
  {
    return counters;
  }
  if (!this->LookSmoothly(group, search, factors, counters))
  {
    if (this->IsSmall(group, search))
    {
      this->LookAtEach(group, search, factors, counters);
    }
    else
    {
      counters.Add(this->LookHalves(group, search, factors));
    }
  }
  return counters;
}

/// Whether to halve the group is of no use.
bool LampView::IsSmall(const Group& group, const Search& search) const
{
  const auto count = group.last - group.first;
  if (search.tolerance == 0.0)
  {
    return count <= SmallGroup || group.suspects.empty() ||
           (count <= SmallGroupOfFewFacets && group.suspects.size() <= FewFacets);
  }
  return count <= SmallGroup || (group.suspects.empty() && this->Lamp.Size() == 1);
}

/// A single face without anything in the way is no more work than its fit, and exact.
bool LampView::IsWorthAFit(const Group& group, const Search& search) const
{
  return search.tolerance > 0.0 && group.last - group.first > LeastToFit &&
         (!group.suspects.empty() || this->Lamp.Size() > 1);
}

DirectCounters LampView::LookHalves(const Group& group, const Search& search, double* factors) const
{
  const auto [low, high] = Around(group.first, group.last);
  const int axis = high.x - low.x >= high.y - low.y ? 0 : 1;
  const double cut = 0.5 * (low[axis] + high[axis]);
  LampSpot* middle = std::partition(
    group.first, group.last, [&](const LampSpot& spot) { return spot.place[axis] < cut; });
  if (middle == group.first || middle == group.last)
  {
    middle = group.first + (group.last - group.first) / 2; // all in one place
  }
  DirectCounters lower, upper;
  const auto lookLower = [&] {
    lower = this->Look({ group.first, middle, group.suspects }, search, factors);
  };
  const auto lookUpper = [&] {
    upper = this->Look({ middle, group.last, group.suspects }, search, factors);
  };
  if (group.last - group.first > ParallelGroup)
  {
    tbb::parallel_invoke(lookLower, lookUpper);
  }
  else
  {
    lookLower();
    lookUpper();
  }
  lower.Add(upper);
  return lower;
}

/// Looks at a few places only, if these tell of all, as they never do without a tolerance.
bool LampView::LookSmoothly(
  const Group& group, const Search& search, double* factors, DirectCounters& counters) const
{
  if (!this->IsWorthAFit(group, search))
  {
    return false;
  }
  const Polygon bounds = this->Bounds(group);
  // What a lamp hides of itself changes as slowly as it turns.
  const auto isSharp = [&](const LampCutter::Suspect& suspect)
  {
    return !search.obstacles.IsOfLamp(suspect.occluder) &&
           search.obstacles.Cutter().Occluders().IsSharp(suspect.occluder, bounds);
  };
  if (std::any_of(group.suspects.begin(), group.suspects.end(), isSharp))
  {
    return false;
  }
  const auto [low, high] = Around(group.first, group.last);
  LampCutter::Shadows shadows;
  const auto fit = FitSmooth(low, high, search.tolerance,
    [&](const Vec2& place) { return this->SeenFrom(place, group, search, shadows, counters); });
  if (!fit)
  {
    return false;
  }
  for (const LampSpot* spot = group.first; spot != group.last; ++spot)
  {
    factors[spot->index] = std::max(fit->At(spot->place), 0.0);
  }
  return true;
}

void LampView::LookAtEach(
  const Group& group, const Search& search, double* factors, DirectCounters& counters) const
{
  LampCutter::Shadows shadows;
  for (const LampSpot* spot = group.first; spot != group.last; ++spot)
  {
    factors[spot->index] = this->SeenFrom(spot->place, group, search, shadows, counters);
  }
}

double LampView::SeenFrom(const Vec2& place, const Group& group, const Search& search,
  LampCutter::Shadows& shadows, DirectCounters& counters) const
{
  const Vec2 local = place / this->Unit;
  if (this->Front && this->Front->Distance(Vec3(local, 0.0)) <= 0.0)
  {
    return 0.0;
  }
  const auto seen = shadows.AreTooMany()
                      ? std::nullopt
                      : search.obstacles.Cutter().Seen(local, group.suspects, shadows);
  const double factor = seen ? *seen : this->SeenByRays(place, counters);
  counters.lampEvaluations += factor > 0.0 ? 1 : 0;
  counters.cutEvaluations += shadows.Any() ? 1 : 0;
  return factor;
}

/// The closed form times the part of it that well spread rays find.
double LampView::SeenByRays(const Vec2& place, DirectCounters& counters) const
{
  const SurfacePoint from{ this->Frame->ToWorld(Vec3(place, 0.0)), this->Facet };
  std::vector<double> areasTo; // of the shapes, up to and with each
  for (const Polygon& shape : this->Named->shapes)
  {
    areasTo.push_back((areasTo.empty() ? 0.0 : areasTo.back()) + Area(shape));
  }
  double seen = 0.0;
  double total = 0.0;
  for (int i = 0; i < ShadowRays; ++i)
  {
    Vec2 uv = ScrambledSobol(i, Hash(this->Named->patches[0], this->Facet));
    const double chosen = uv.x * areasTo.back();
    const auto next = std::upper_bound(areasTo.begin(), areasTo.end() - 1, chosen);
    const auto k = static_cast<std::size_t>(next - areasTo.begin());
    const Polygon& shape = this->Named->shapes[k];
    const double before = k > 0 ? areasTo[k - 1] : 0.0;
    const double area = areasTo[k] - before;
    uv.x = (chosen - before) / area;
    const Vec3 y = PointAt(shape, uv);
    const Vec3 way = y - from.position;
    const double square = glm::dot(way, way);
    const double weight =
      AreaElementAt(shape, uv) / area * std::max(glm::dot(way, this->Frame->z), 0.0) *
      std::max(SupportingPlane(shape).Distance(from.position), 0.0) / (square * square);
    total += weight;
    const SurfacePoint to{ y, this->Named->patches[k] / 2 };
    seen += weight > 0.0 && this->Occluders->IsOccluded(from, to) ? 0.0 : weight;
    counters.shadowRays += weight > 0.0 ? 1 : 0;
  }
  LampSurface::Workspace room;
  return total > 0.0 ? this->Lamp.At(place / this->Unit, room) * seen / total : 0.0;
}

} // namespace vantage
