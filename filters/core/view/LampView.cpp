#include "core/view/LampView.h"

#include "core/math/ScrambledSobol.h"
#include "core/mesh/Bounds.h"
#include "core/view/SmoothFit.h"

#include <tbb/parallel_invoke.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

namespace vantage
{

namespace
{

/// In local units: what is nearer to a plane than this touches it.
constexpr double Touching = 1e-10;
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

Bounds BoundsOf(const ConvexRegion& region)
{
  Bounds bounds(region.low);
  bounds.Add(region.high);
  return bounds;
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
  const Search search = this->SearchAround(all, tolerance);
  for (std::uint32_t k = 0; k < search.obstacles.size(); ++k)
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
  return this->Front ? ClipToFront(bounds, *this->Front, Touching) : bounds;
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

/// The part of a facet that is in front of both the patch and a flat lamp. Local; may be empty.
Polygon LampView::Between(std::uint32_t facet) const
{
  Polygon local;
  for (const Vec3& v : this->Occluders->Shape(facet))
  {
    local.Add(this->Frame->ToLocal(v) / this->Unit);
  }
  const Polygon above = ClipToFront(local, Plane(), Touching);
  return this->Front ? ClipToFront(above, *this->Front, Touching) : above;
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

LampView::Search LampView::SearchAround(const Group& all, double tolerance) const
{
  Search search{ {}, {}, LampCutter(this->Lamp), tolerance };
  const Polygon bounds = this->Bounds(all);
  if (bounds.Empty())
  {
    return search;
  }
  std::map<std::uint32_t, bool> isBodyKnown; // and whether it casts its shadow as one
  const auto isOfBody = [&](PatchId inside)
  {
    const std::uint32_t body = this->Occluders->BodyAround(inside);
    if (body == None)
    {
      return false;
    }
    const auto [known, isNew] = isBodyKnown.try_emplace(body, false);
    if (isNew)
    {
      known->second = this->AddBody(body, search);
    }
    return known->second;
  };
  for (const std::uint32_t facet : this->FacetsFrom(this->ToWorld(bounds)))
  {
    const bool isOfFront = isOfBody(PatchOf(facet, Side::Front));
    const bool isOfBack = isOfBody(PatchOf(facet, Side::Back));
    if (!isOfFront && !isOfBack)
    {
      this->AddFacet(facet, search);
    }
  }
  return search;
}

/// Returns whether all of its facets are seen to. A convex body hides nothing from its own outside,
/// and nothing of a lamp that is part of it.
bool LampView::AddBody(std::uint32_t body, Search& search) const
{
  const auto facets = this->Occluders->Convex().FacetsOf(body);
  if (facets.size() == 0)
  {
    return false;
  }
  const bool isItsOwn = std::any_of(facets.begin(), facets.end(),
    [this](PatchId side)
    { return side / 2 == this->Facet || this->Named->IsOfConvexPart(side / 2); });
  if (isItsOwn)
  {
    return true;
  }
  if (!search.cutter.Occluders().AddBody(this->LocalBody(body)))
  {
    return false;
  }
  Obstacle obstacle;
  obstacle.firstFacet = static_cast<std::uint32_t>(search.facets.size());
  for (const PatchId side : facets)
  {
    search.facets.push_back(side / 2);
    for (const Vec3& corner : this->Occluders->Shape(side / 2))
    {
      obstacle.bounds.Add(corner);
    }
  }
  obstacle.lastFacet = static_cast<std::uint32_t>(search.facets.size());
  search.obstacles.push_back(obstacle);
  return true;
}

void LampView::AddFacet(std::uint32_t facet, Search& search) const
{
  const Polygon between = this->Between(facet);
  if (facet == this->Facet || this->Named->IsOfConvexPart(facet) || between.Empty() ||
      this->Lamp.IsInFrontOf(between))
  {
    return;
  }
  const auto inside = this->Occluders->InsideOf(facet);
  search.cutter.Occluders().AddPlate(between, inside ? std::optional(inside->side) : std::nullopt);
  const auto first = static_cast<std::uint32_t>(search.facets.size());
  search.facets.push_back(facet);
  search.obstacles.push_back({ first, first + 1, inside, {} });
}

ConvexBody LampView::LocalBody(std::uint32_t body) const
{
  const ConvexBodies& bodies = this->Occluders->Convex();
  std::vector<Polygon> shapes;
  ConvexBody local;
  for (const PatchId facet : bodies.FacetsOf(body))
  {
    Polygon& shape = shapes.emplace_back();
    for (const Vec3& v : ShapeOf(*this->Occluders, facet))
    {
      shape.Add(this->Frame->ToLocal(v) / this->Unit);
      local.corners.push_back(shape[shape.Size() - 1]);
    }
  }
  for (const std::uint32_t facet : bodies.SidesOf(body))
  {
    local.planes.push_back(SupportingPlane(shapes[facet]));
  }
  for (const ConvexBodies::Edge& edge : bodies.EdgesOf(body))
  {
    const Polygon& shape = shapes[edge.facet];
    const int corner = static_cast<int>(edge.corner);
    local.edges.push_back(
      { shape[corner], shape[(corner + 1) % shape.Size()], edge.first, edge.second });
  }
  return local;
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
    { return this->IsElsewhere(search.obstacles[suspect.occluder], search, *shaft); };
    group.suspects.erase(std::remove_if(group.suspects.begin(), group.suspects.end(), isElsewhere),
      group.suspects.end());
  }
  return std::none_of(group.suspects.begin(), group.suspects.end(),
    [&](const LampCutter::Suspect& suspect)
    { return search.cutter.Occluders().HidesAll(suspect.occluder, bounds); });
}

bool LampView::IsElsewhere(
  const Obstacle& obstacle, const Search& search, const ConvexRegion& shaft) const
{
  const auto first = search.facets.begin() + obstacle.firstFacet;
  const auto last = search.facets.begin() + obstacle.lastFacet;
  const bool isBody = last - first > 1;
  if (isBody && !obstacle.bounds.Meets(BoundsOf(shaft)))
  {
    return true;
  }
  return std::none_of(first, last,
    [&](std::uint32_t facet)
    { return ReachesInto(this->Occluders->Shape(facet), shaft, this->Occluders->Tolerance()); });
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
    const auto& inside = search.obstacles[suspect.occluder].inside;
    suspect.isSeenFromOutside = suspect.isSeenFromOutside || (inside && !inside->body.Meets(box));
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
    const std::uint32_t facet = search.facets[search.obstacles[suspect.occluder].firstFacet];
    return !this->Named->IsOfWhole(facet) &&
           search.cutter.Occluders().IsSharp(suspect.occluder, bounds);
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
  const auto seen =
    shadows.AreTooMany() ? std::nullopt : search.cutter.Seen(local, group.suspects, shadows);
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
