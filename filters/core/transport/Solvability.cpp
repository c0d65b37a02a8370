#include "core/transport/Solvability.h"

#include "core/Error.h"
#include "core/math/Sampling.h"

namespace vantage
{

namespace
{

/// A walk this long has not found a way out of a scene that has one in fewer than one of
/// a million cases where 0.15 % of the bounces end it; darker leaks are as good as none.
constexpr int LongestWalk = 10000;
constexpr int WalksPerPatch = 4;
constexpr std::size_t MostPatches = 64;

/// Albedos nearer to 1 than this reflect everything.
constexpr double WhiteTolerance = 1e-12;

bool IsWhite(const PatchOptics& optics, int channel)
{
  return optics.albedo[channel] >= 1.0 - WhiteTolerance;
}

/// Whether a diffuse walk from the patch ends.
bool WalkEnds(const ElementTree& tree, const OccluderScene& occluders,
  const std::vector<PatchOptics>& optics, PatchId start, int channel, std::uint64_t walk)
{
  RandomStream random(walk, start);
  PatchId patch = start;
  Vec3 point = PointAt(tree.Shape(tree.Patches()[start].node), random.Next2());
  for (int bounce = 0; bounce < LongestWalk; ++bounce)
  {
    const Patch& from = tree.Patches()[patch];
    const Vec3 direction = Frame(from.normal).ToWorld(CosineHemisphere(random.Next2()));
    const auto hit = occluders.Intersect(point, direction, from.facet);
    if (!hit || !tree.Patches()[hit->Patch()].IsActive() || !IsWhite(optics[hit->Patch()], channel))
    {
      return true;
    }
    patch = hit->Patch();
    point = hit->point;
  }
  return false;
}

} // namespace

void RequireSolvable(
  const ElementTree& tree, const OccluderScene& occluders, const std::vector<PatchOptics>& optics)
{
  for (int channel = 0; channel < 3; ++channel)
  {
    std::size_t tried = 0;
    for (PatchId p = 0; p < optics.size() && tried < MostPatches; ++p)
    {
      if (!tree.Patches()[p].IsActive() || !IsWhite(optics[p], channel))
      {
        continue;
      }
      ++tried;
      bool ends = false;
      for (std::uint64_t walk = 0; walk < WalksPerPatch && !ends; ++walk)
      {
        ends = WalkEnds(tree, occluders, optics, p, channel, walk);
      }
      if (!ends)
      {
        throw DivergenceError("scene: all surfaces around some place have albedo 1 and no light "
                              "leaves it, so its radiance is infinite; lower an albedo below 1 "
                              "or open the scene");
      }
    }
  }
}

} // namespace vantage
