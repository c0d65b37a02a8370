#include "core/visibility/PairVisibility.h"

#include "core/math/ScrambledSobol.h"
#include "core/visibility/FlatOccluder.h"

#include <algorithm>
#include <array>

namespace vantage
{

namespace
{

/// Boxes and facets a proof of full visibility may look at: about the cost of ten rays.
constexpr int ProofEffort = 160;
/// A proof that nothing is visible looks at so many facets: behind the chair that hides the centres
/// may stand the wall that hides all.
constexpr int FacetsToTry = 4;

/// The ends, in an order that does not depend on the order of the arguments. Two ends on one facet
/// never see each other, so the facets tell the order of all others.
struct OrderedPair
{
  const VisibilityEnd& a;
  const VisibilityEnd& b;
  Plane planeA, planeB;

  OrderedPair(const VisibilityEnd& first, const VisibilityEnd& second)
    : a(first.facet <= second.facet ? first : second)
    , b(first.facet <= second.facet ? second : first)
    , planeA(SupportingPlane(this->a.shape))
    , planeB(SupportingPlane(this->b.shape))
  {
  }
};

/// Where a facet cuts a segment, as its plane tells; a facet may be a little bent.
Vec3 Crossing(const Vec3& from, const Vec3& to, const Polygon& facet)
{
  const Plane plane = SupportingPlane(facet);
  const double before = plane.Distance(from);
  const double after = plane.Distance(to);
  const double t = before != after ? std::clamp(before / (before - after), 0.0, 1.0) : 0.0;
  return from + t * (to - from);
}

/// Whether the facet cuts every segment between two convex polygons. It does when its plane lies
/// between them and it covers the crossings of the segments between their corners, because all
/// other crossings lie in the convex hull of those.
bool HidesAll(const Polygon& facet, const Polygon& a, const Polygon& b, double tolerance)
{
  const FlatOccluder occluder(facet, None);
  const double side = occluder.plane.Distance(Centroid(a)) > 0.0 ? 1.0 : -1.0;
  for (const Vec3& u : a)
  {
    for (const Vec3& v : b)
    {
      const double above = side * occluder.plane.Distance(u);
      const double below = -side * occluder.plane.Distance(v);
      if (above < -tolerance || below < -tolerance)
      {
        return false;
      }
      const double t = above <= tolerance ? 0.0 : above / (above + std::max(below, 0.0));
      if (!occluder.Covers(u + t * (v - u), tolerance))
      {
        return false;
      }
    }
  }
  return true;
}

/// Of the facets between the centres of a and b, from a on, one that hides all of b.
bool IsProvablyHidden(const OccluderScene& occluders, const OrderedPair& pair, const Polygon& a,
  const Polygon& b, std::uint32_t first, PairVisibility& result)
{
  const double tolerance = occluders.Tolerance();
  const SurfacePoint to{ Centroid(b), pair.b.facet };
  SurfacePoint from{ Centroid(a), first };
  for (int tries = 1;; ++tries)
  {
    const Polygon facet = occluders.Shape(from.facet);
    if (HidesAll(facet, a, b, tolerance))
    {
      return true;
    }
    if (tries == FacetsToTry)
    {
      return false;
    }
    from.position = Crossing(from.position, to.position, facet);
    const auto next = occluders.FirstOccluder(from, to);
    ++result.rays;
    if (!next)
    {
      return false;
    }
    from.facet = *next;
  }
}

/// A proof that everything or nothing of a and b, both cut to each other's front, is visible. One
/// ray between the centres tells which of the two is worth trying.
bool Prove(const OccluderScene& occluders, const OrderedPair& pair, const Polygon& a,
  const Polygon& b, PairVisibility& result)
{
  const auto occluder =
    occluders.FirstOccluder({ Centroid(a), pair.a.facet }, { Centroid(b), pair.b.facet });
  ++result.rays;
  ++result.lines;
  if (occluder)
  {
    result.fraction = 0.0;
    return IsProvablyHidden(occluders, pair, a, b, *occluder, result);
  }
  result.fraction = 1.0;
  const auto shaft = Shaft(a, b, occluders.Tolerance());
  return shaft && occluders.IsProvablyEmpty(*shaft, ProofEffort);
}

void Sample(const OccluderScene& occluders, const OrderedPair& pair, std::uint32_t rays,
  std::uint64_t seed, PairVisibility& result)
{
  double facing = 0.0;
  double free = 0.0;
  for (std::uint32_t i = 0; i < rays; ++i)
  {
    const std::array<double, 4> u = ScrambledSobol4(i, seed);
    const Vec2 onA(u[0], u[1]);
    const Vec2 onB(u[2], u[3]);
    const Vec3 p = PointAt(pair.a.shape, onA);
    const Vec3 q = PointAt(pair.b.shape, onB);
    if (pair.planeA.Distance(q) > 0.0 && pair.planeB.Distance(p) > 0.0)
    {
      const double weight = AreaElementAt(pair.a.shape, onA) * AreaElementAt(pair.b.shape, onB);
      facing += weight;
      free += occluders.IsOccluded({ p, pair.a.facet }, { q, pair.b.facet }) ? 0.0 : weight;
      ++result.rays;
      ++result.lines;
    }
  }
  result.fraction = facing > 0.0 ? free / facing : 0.0;
}

} // namespace

PairVisibility EstimateVisibility(const OccluderScene& occluders, const VisibilityEnd& first,
  const VisibilityEnd& second, std::uint32_t rays, std::uint64_t seed)
{
  const OrderedPair pair(first, second);
  const double tolerance = occluders.Tolerance();
  const Polygon a = ClipToFront(pair.a.shape, pair.planeB, tolerance);
  const Polygon b = ClipToFront(pair.b.shape, pair.planeA, tolerance);
  PairVisibility result;
  if (a.Empty() || b.Empty())
  {
    result.fraction = 0.0;
    result.isCertain = true;
    return result;
  }
  result.isCertain = Prove(occluders, pair, a, b, result);
  if (!result.isCertain)
  {
    Sample(occluders, pair, rays, seed, result);
  }
  return result;
}

} // namespace vantage
