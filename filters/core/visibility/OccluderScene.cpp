#include "core/visibility/OccluderScene.h"

#include "core/Error.h"
#include "core/visibility/FacetHierarchy.h"
#include "core/visibility/FlatOccluder.h"

#include <embree3/rtcore.h>
#include <immintrin.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace vantage
{

namespace
{

/// How far a ray in single precision strays from the true one in a scene of unit diagonal: origin
/// and direction are each rounded to about 6e-8. Ten times that is still nothing for Embree's
/// boxes.
constexpr double SinglePrecisionMargin = 1e-6;

RTCBounds BoundsOf(const Polygon& part, double margin)
{
  Vec3 low = part[0];
  Vec3 high = part[0];
  for (const Vec3& v : part)
  {
    low = glm::min(low, v);
    high = glm::max(high, v);
  }
  const glm::vec3 lower(low - margin);
  const glm::vec3 upper(high + margin);
  return { lower.x, lower.y, lower.z, 0.0f, upper.x, upper.y, upper.z, 0.0f };
}

/// Embree and its rays ask for denormals to be zero; the caller's arithmetic must not change, or
/// results would depend on which threads have traced before.
class FlushDenormals
{
public:
  FlushDenormals()
    : Saved(_mm_getcsr())
  {
    _mm_setcsr(this->Saved | _MM_FLUSH_ZERO_ON | 0x0040u /* denormals are zero */);
  }
  ~FlushDenormals() { _mm_setcsr(this->Saved); }
  FlushDenormals(const FlushDenormals&) = delete;
  FlushDenormals& operator=(const FlushDenormals&) = delete;

private:
  unsigned int Saved;
};

/// State shared by Embree's callbacks.
struct OccluderList
{
  std::vector<FlatOccluder> occluders;
  std::vector<RTCBounds> bounds; ///< until the Embree scene is built
  double tolerance = 0.0;        ///< in the normalised scene
};

/// A query on its way through Embree, in the normalised scene. Embree hands the context back to the
/// callbacks, so it comes first.
struct Query
{
  RTCIntersectContext context;
  Vec3 origin;
  Vec3 direction; ///< of a segment: from end to end
  bool isSegment; ///< else a half-line
  std::array<std::uint32_t, 2> ignored;
  double rayStart = 0.0; ///< where Embree's ray starts, along direction
  double rayEnd = 1.0;
  double length; ///< of the direction: Embree's ray has a direction of unit length
  double nearest = std::numeric_limits<double>::infinity(); ///< of hits so far, along direction
  std::uint32_t occluder = None;                            ///< that was hit

  Query(const Vec3& o, const Vec3& d, bool segment, std::uint32_t ignoredA, std::uint32_t ignoredB)
    : origin(o)
    , direction(d)
    , isSegment(segment)
    , ignored{ ignoredA, ignoredB }
    , length(glm::length(d))
  {
    rtcInitIntersectContext(&this->context);
  }

  std::optional<double> Crossing(const FlatOccluder& occluder, double tolerance) const;
};

/// Where the query crosses a facet, along its direction: properly, with the ends of a segment (the
/// origin of a half-line) further from the facet's plane than the tolerance.
std::optional<double> Query::Crossing(const FlatOccluder& occluder, double tolerance) const
{
  if (occluder.facet == this->ignored[0] || occluder.facet == this->ignored[1])
  {
    return std::nullopt;
  }
  const double start = occluder.plane.Distance(this->origin);
  const double speed = glm::dot(occluder.plane.normal, this->direction);
  const double end = start + speed;
  const bool leavesPlane = std::abs(start) > tolerance && start * speed < 0.0;
  const bool passesPlane = !this->isSegment || (std::abs(end) > tolerance && start * end < 0.0);
  if (!leavesPlane || !passesPlane)
  {
    return std::nullopt;
  }
  const double t = -start / speed;
  return occluder.Covers(this->origin + t * this->direction, tolerance) ? std::optional(t)
                                                                        : std::nullopt;
}

void ReportBounds(const RTCBoundsFunctionArguments* args)
{
  const auto* list = static_cast<const OccluderList*>(args->geometryUserPtr);
  *args->bounds_o = list->bounds[args->primID];
}

void FindAny(const RTCOccludedFunctionNArguments* args)
{
  const auto* list = static_cast<const OccluderList*>(args->geometryUserPtr);
  const auto* query = reinterpret_cast<const Query*>(args->context);
  if (args->valid[0] != 0 && query->Crossing(list->occluders[args->primID], list->tolerance))
  {
    reinterpret_cast<RTCRay*>(args->ray)->tfar = -std::numeric_limits<float>::infinity();
  }
}

/// Keeps the nearest hit; of equally near ones the one with the lowest number, so that the result
/// does not depend on the order in which Embree visits facets.
void FindNearest(const RTCIntersectFunctionNArguments* args)
{
  const auto* list = static_cast<const OccluderList*>(args->geometryUserPtr);
  auto* query = reinterpret_cast<Query*>(args->context);
  const FlatOccluder& occluder = list->occluders[args->primID];
  const auto t = args->valid[0] != 0 ? query->Crossing(occluder, list->tolerance) : std::nullopt;
  if (!t || *t > query->nearest || (*t == query->nearest && args->primID > query->occluder))
  {
    return;
  }
  query->nearest = *t;
  query->occluder = args->primID;
  const double alongRay = (*t - query->rayStart) * query->length + SinglePrecisionMargin;
  RTCRay& ray = reinterpret_cast<RTCRayHit*>(args->rayhit)->ray;
  ray.tfar = std::min(ray.tfar, static_cast<float>(alongRay));
}

RTCRay EmbreeRay(const Query& query)
{
  const Vec3 origin = query.origin + query.rayStart * query.direction;
  const Vec3 direction = query.direction / query.length;
  const double end = (query.rayEnd - query.rayStart) * query.length + SinglePrecisionMargin;
  RTCRay ray{};
  ray.org_x = static_cast<float>(origin.x);
  ray.org_y = static_cast<float>(origin.y);
  ray.org_z = static_cast<float>(origin.z);
  ray.dir_x = static_cast<float>(direction.x);
  ray.dir_y = static_cast<float>(direction.y);
  ray.dir_z = static_cast<float>(direction.z);
  ray.tfar = static_cast<float>(end);
  ray.mask = 0xffffffffu;
  return ray;
}

/// The part of the half-line within the cube [-1, 1]^3, which holds the normalised scene with
/// room to spare: single precision has no room for an eye a thousand scenes away.
bool ClipToScene(Query& query)
{
  double start = 0.0;
  double end = std::numeric_limits<double>::infinity();
  for (int axis = 0; axis < 3; ++axis)
  {
    const double o = query.origin[axis];
    const double d = query.direction[axis];
    if (d != 0.0)
    {
      start = std::max(start, (-std::copysign(1.0, d) - o) / d);
      end = std::min(end, (std::copysign(1.0, d) - o) / d);
    }
    else if (std::abs(o) > 1.0)
    {
      return false;
    }
  }
  query.rayStart = start;
  query.rayEnd = end;
  return start < end && std::isfinite(end) && query.length > 0.0;
}

} // namespace

struct OccluderScene::Implementation
{
  FacetShapes shapes;
  Vec3 centre;
  double scale; ///< normalised = (x - centre) * scale
  OccluderList list;
  FacetHierarchy hierarchy;
  DarkSides dark;
  ConvexBodies convex;
  RTCDevice device = nullptr;
  RTCScene scene = nullptr;

  Implementation(const FacetSet& set, DarkSides darkSides);
  ~Implementation();
  Implementation(const Implementation&) = delete;
  Implementation& operator=(const Implementation&) = delete;

  void NormaliseFacets();
  void BuildEmbreeScene();
  Vec3 Normalise(const Vec3& x) const { return (x - this->centre) * this->scale; }
  double Tolerance() const { return this->list.tolerance / this->scale; }
  Query Segment(const SurfacePoint& from, const SurfacePoint& to) const;
  void TraceNearest(Query& query) const;
};

OccluderScene::Implementation::Implementation(const FacetSet& set, DarkSides darkSides)
  : shapes(set.facets)
  , centre(0.5 * (set.low + set.high))
  , scale(1.0 / std::max(glm::length(set.high - set.low), std::numeric_limits<double>::min()))
  , hierarchy(this->shapes, set.Tolerance())
  , dark(std::move(darkSides))
  , convex(set, this->dark)
{
  this->list.tolerance = set.Tolerance() * this->scale;
  this->NormaliseFacets();
  this->BuildEmbreeScene();
}

OccluderScene::Implementation::~Implementation()
{
  rtcReleaseScene(this->scene);
  rtcReleaseDevice(this->device);
}

void OccluderScene::Implementation::NormaliseFacets()
{
  const double margin = std::max(SinglePrecisionMargin, 2.0 * this->list.tolerance);
  this->list.occluders.reserve(this->shapes.Size());
  this->list.bounds.reserve(this->shapes.Size());
  for (std::uint32_t f = 0; f < this->shapes.Size(); ++f)
  {
    Polygon shape;
    for (const Vec3& v : this->shapes[f])
    {
      shape.Add(this->Normalise(v));
    }
    for (const Polygon& part : FlatParts(shape, this->list.tolerance))
    {
      this->list.occluders.push_back(FlatOccluder(part, f));
      this->list.bounds.push_back(BoundsOf(part, margin));
    }
  }
}

void OccluderScene::Implementation::BuildEmbreeScene()
{
  this->device = rtcNewDevice(nullptr);
  if (!this->device)
  {
    throw Error("visibility: Embree cannot make a device (error " +
                std::to_string(rtcGetDeviceError(nullptr)) +
                "); the processor needs SSE2 at least");
  }
  this->scene = rtcNewScene(this->device);
  rtcSetSceneFlags(this->scene, RTC_SCENE_FLAG_ROBUST);
  rtcSetSceneBuildQuality(this->scene, RTC_BUILD_QUALITY_HIGH);
  RTCGeometry geometry = rtcNewGeometry(this->device, RTC_GEOMETRY_TYPE_USER);
  rtcSetGeometryUserPrimitiveCount(
    geometry, static_cast<unsigned int>(this->list.occluders.size()));
  rtcSetGeometryUserData(geometry, &this->list);
  rtcSetGeometryBoundsFunction(geometry, ReportBounds, nullptr);
  rtcSetGeometryOccludedFunction(geometry, FindAny);
  rtcSetGeometryIntersectFunction(geometry, FindNearest);
  rtcCommitGeometry(geometry);
  rtcAttachGeometry(this->scene, geometry);
  rtcReleaseGeometry(geometry);
  rtcCommitScene(this->scene);
  std::vector<RTCBounds>().swap(this->list.bounds);
  const RTCError error = rtcGetDeviceError(this->device);
  if (error != RTC_ERROR_NONE)
  {
    throw Error("visibility: Embree cannot take the scene (error " + std::to_string(error) +
                "); is there enough memory?");
  }
}

Query OccluderScene::Implementation::Segment(const SurfacePoint& from, const SurfacePoint& to) const
{
  return { this->Normalise(from.position), (to.position - from.position) * this->scale, true,
    from.facet, to.facet };
}

void OccluderScene::Implementation::TraceNearest(Query& query) const
{
  const FlushDenormals flush;
  RTCRayHit ray{};
  ray.ray = EmbreeRay(query);
  rtcIntersect1(this->scene, &query.context, &ray);
}

OccluderScene::OccluderScene(const FacetSet& facets, DarkSides dark)
  : Impl(std::make_unique<Implementation>(facets, std::move(dark)))
{
}
OccluderScene::~OccluderScene() = default;
OccluderScene::OccluderScene(OccluderScene&&) noexcept = default;
OccluderScene& OccluderScene::operator=(OccluderScene&&) noexcept = default;

bool OccluderScene::IsOccluded(const SurfacePoint& from, const SurfacePoint& to) const
{
  Query query = this->Impl->Segment(from, to);
  if (!(query.length > 0.0))
  {
    return false;
  }
  const FlushDenormals flush;
  RTCRay ray = EmbreeRay(query);
  rtcOccluded1(this->Impl->scene, &query.context, &ray);
  return ray.tfar < 0.0f;
}

std::optional<std::uint32_t> OccluderScene::FirstOccluder(
  const SurfacePoint& from, const SurfacePoint& to) const
{
  const Implementation& impl = *this->Impl;
  Query query = impl.Segment(from, to);
  if (query.length > 0.0)
  {
    impl.TraceNearest(query);
  }
  return query.occluder != None ? std::optional(impl.list.occluders[query.occluder].facet)
                                : std::nullopt;
}

std::optional<Hit> OccluderScene::Intersect(
  const Vec3& origin, const Vec3& direction, std::uint32_t ignore) const
{
  const Implementation& impl = *this->Impl;
  Query query(impl.Normalise(origin), direction * impl.scale, false, ignore, None);
  if (!ClipToScene(query))
  {
    return std::nullopt;
  }
  impl.TraceNearest(query);
  if (query.occluder == None)
  {
    return std::nullopt;
  }
  const FlatOccluder& occluder = impl.list.occluders[query.occluder];
  const Plane& plane = occluder.plane;
  const Vec3 x = query.origin + query.nearest * query.direction;
  Hit hit;
  hit.facet = occluder.facet;
  hit.side = glm::dot(plane.normal, query.direction) < 0.0 ? Side::Front : Side::Back;
  hit.point = impl.centre + (x - plane.Distance(x) * plane.normal) / impl.scale;
  hit.distance = query.nearest;
  return hit;
}

std::vector<std::uint32_t> OccluderScene::FacetsInBox(const Vec3& low, const Vec3& high) const
{
  return this->Impl->hierarchy.FacetsIn(BoxRegion(low, high, this->Tolerance()));
}

std::vector<std::uint32_t> OccluderScene::FacetsInRegion(const ConvexRegion& region) const
{
  return this->Impl->hierarchy.FacetsIn(region);
}

bool OccluderScene::IsProvablyEmpty(const ConvexRegion& region, int effort) const
{
  return this->Impl->hierarchy.IsProvablyEmpty(region, effort);
}

std::uint32_t OccluderScene::FacetCount() const
{
  return this->Impl->shapes.Size();
}

std::uint32_t OccluderScene::BodyAround(PatchId patch) const
{
  const DarkSides& dark = this->Impl->dark;
  return dark.bodies.empty() ? None : dark.bodyOf[patch];
}

const ConvexBodies& OccluderScene::Convex() const
{
  return this->Impl->convex;
}

std::optional<OccluderScene::Inside> OccluderScene::InsideOf(std::uint32_t facet) const
{
  const DarkSides& dark = this->Impl->dark;
  const std::uint32_t front = this->BodyAround(PatchOf(facet, Side::Front));
  const std::uint32_t back = this->BodyAround(PatchOf(facet, Side::Back));
  if ((front == None) == (back == None))
  {
    return std::nullopt;
  }
  return front != None ? Inside{ Side::Front, dark.bodies[front] }
                       : Inside{ Side::Back, dark.bodies[back] };
}

Polygon OccluderScene::Shape(std::uint32_t facet) const
{
  return Polygon(this->Impl->shapes[facet]);
}

double OccluderScene::Tolerance() const
{
  return this->Impl->Tolerance();
}

} // namespace vantage
