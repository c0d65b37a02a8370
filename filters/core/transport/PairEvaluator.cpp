#include "core/transport/PairEvaluator.h"

#include "core/math/Sampling.h"

#include <algorithm>

namespace vantage
{

namespace
{

/// Corners nearer to a plane than this part of the distance between the shapes lie on it.
constexpr double RelativePlaneTolerance = 1e-9;

bool ReachesInFront(const Polygon& shape, const Plane& plane, double tolerance)
{
  return std::any_of(shape.begin(), shape.end(),
    [&](const Vec3& corner) { return plane.Distance(corner) > tolerance; });
}

/// The way down from the patch to the element as one number: it does not depend on where the patch
/// is, so that a moved or shuffled scene uses the same rays.
std::uint64_t PathBelowPatch(const ElementTree& tree, NodeId node)
{
  std::uint64_t path = 1;
  while (tree[node].level > 0)
  {
    const NodeId parent = tree[node].parent;
    path = Hash(path, node - tree[parent].firstChild);
    node = parent;
  }
  return path;
}

} // namespace

std::uint32_t AgreeingRays(
  const PairVisibility& seen, double parentVisibility, std::uint32_t parentAgreeingRays)
{
  if (seen.isCertain)
  {
    return Certain;
  }
  const bool isUnanimous = seen.fraction == 0.0 || seen.fraction == 1.0;
  const std::uint32_t inherited = seen.fraction == parentVisibility ? parentAgreeingRays : 0;
  return isUnanimous ? seen.lines + inherited : 0;
}

bool FaceEachOther(const Polygon& a, const Polygon& b)
{
  const double scale = RadiusAround(b, a[0]) + RadiusAround(a, a[0]);
  const double tolerance = RelativePlaneTolerance * scale;
  return ReachesInFront(a, SupportingPlane(b), tolerance) &&
         ReachesInFront(b, SupportingPlane(a), tolerance);
}

PairEvaluator::PairEvaluator(
  const OccluderScene& occluders, Accuracy accuracy, std::uint32_t visibilityRays)
  : Occluders(&occluders)
  , TheAccuracy(accuracy)
  , VisibilityRays(visibilityRays)
{
}

PairValue PairEvaluator::Evaluate(const ElementTree& tree, const ElementPair& pair) const
{
  PairValue value;
  const Polygon first = tree.Shape(pair.first);
  const Polygon second = tree.Shape(pair.second);
  if (!FaceEachOther(first, second))
  {
    return value;
  }
  if (pair.parentAgreeingRays >= CertifyingRays)
  {
    value.visibility = pair.parentVisibility;
    value.agreeingRays = pair.parentAgreeingRays;
  }
  else
  {
    // A symmetric function of the two paths keeps the rays the same for either order of the ends.
    const std::uint64_t seed = PathBelowPatch(tree, pair.first) + PathBelowPatch(tree, pair.second);
    const PairVisibility seen =
      EstimateVisibility(*this->Occluders, { first, tree.PatchOfNode(pair.first).facet },
        { second, tree.PatchOfNode(pair.second).facet },
        pair.isRoot ? 4 * this->VisibilityRays : this->VisibilityRays, seed);
    value.visibility = seen.fraction;
    value.rays = seen.rays;
    value.agreeingRays = AgreeingRays(seen, pair.parentVisibility, pair.parentAgreeingRays);
  }
  if (value.visibility > 0.0)
  {
    value.throughput = value.visibility * Throughput(first, second, this->TheAccuracy);
  }
  return value;
}

} // namespace vantage
