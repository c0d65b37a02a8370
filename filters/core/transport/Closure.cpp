#include "core/transport/Closure.h"

#include "core/math/Sampling.h"
#include "core/transport/HierarchicalField.h"

#include <algorithm>

namespace vantage
{

namespace
{

constexpr std::uint32_t EscapeRays = 128;
constexpr double SmallestFactor = 0.6;
constexpr double LargestFactor = 1.6;

bool IsEnclosed(const ElementTree& tree, const OccluderScene& occluders, PatchId patchId)
{
  const Patch& patch = tree.Patches()[patchId];
  const Polygon shape = tree.Shape(patch.node);
  const Frame frame(patch.normal);
  for (std::uint32_t i = 0; i < EscapeRays; ++i)
  {
    RandomStream random(i);
    const Vec3 point = PointAt(shape, random.Next2());
    const Vec2 direction((i + random.Next()) / EscapeRays, RadicalInverse2(i));
    const auto hit =
      occluders.Intersect(point, frame.ToWorld(CosineHemisphere(direction)), patch.facet);
    if (!hit || !tree.Patches()[hit->Patch()].IsActive())
    {
      return false;
    }
  }
  return true;
}

} // namespace

std::vector<double> ClosureFactors(const ElementTree& tree, const OccluderScene& occluders,
  const InteractionGraph& graph, PatchId patch)
{
  std::vector<double> factors(tree.Size(), 1.0);
  if (!IsEnclosed(tree, occluders, patch))
  {
    return factors;
  }
  std::vector<double> rowSums(tree.Size(), 0.0);
  for (const InteractionId id : graph.Of(patch))
  {
    const NodeId node = graph[id].ends[EndOn(tree, graph[id], patch)];
    rowSums[node] += graph[id].throughput / tree[node].area;
  }
  for (const NodeId node : NodesOfPatch(tree, tree.Patches()[patch].node))
  {
    if (tree[node].level > 0)
    {
      rowSums[node] += rowSums[tree[node].parent];
    }
    if (rowSums[node] > 0.0)
    {
      factors[node] = std::clamp(Pi / rowSums[node], SmallestFactor, LargestFactor);
    }
  }
  return factors;
}

} // namespace vantage
