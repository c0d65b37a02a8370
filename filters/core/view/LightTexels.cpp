#include "core/view/LightTexels.h"

#include "core/mesh/PackedLists.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>

namespace vantage
{

namespace
{

/// With fewer hits a patch does not pay for the search for what shades it.
constexpr std::ptrdiff_t LeastHits = 4;
/// With more hits a texel is quartered.
constexpr std::ptrdiff_t MostHits = 8;
/// Below an element, if hits lie in one place.
constexpr int MostLevels = 20;

} // namespace

LightTexels::LightTexels(const OccluderScene& occluders, const RadianceSolution& solution,
  const std::vector<Hit>& sample, DirectCounters& counters)
  : TreeOfPatch(solution.albedo.size(), None)
{
  const PackedLists<Vec3> points(this->TreeOfPatch.size(),
    [&](const auto& visit)
    {
      for (const Hit& hit : sample)
      {
        visit(hit.Patch(), hit.point);
      }
    });
  std::vector<PatchId> patches;
  for (PatchId patch = 0; patch < this->TreeOfPatch.size(); ++patch)
  {
    const auto met = points.Of(patch);
    if (met.end() - met.begin() >= LeastHits)
    {
      const PatchCoordinates map(ShapeOf(occluders, patch));
      this->TreeOfPatch[patch] = static_cast<std::uint32_t>(this->Trees.size());
      this->Trees.emplace_back(map);
      patches.push_back(patch);
    }
  }
  const DirectLight light(occluders, solution);
  std::vector<DirectCounters> counts(patches.size());
  tbb::parallel_for(std::size_t(0), patches.size(),
    [&](std::size_t k)
    {
      const auto met = points.Of(patches[k]);
      const std::vector<Vec3> places(met.begin(), met.end());
      this->Trees[k].Build(solution, solution.elementOfPatch[patches[k]], places,
        light.OfNamed(patches[k], places, counts[k]));
    });
  for (const DirectCounters& count : counts)
  {
    counters.Add(count);
  }
}

LightTexels::Place LightTexels::At(
  const RadianceSolution& solution, PatchId patch, const Vec3& point) const
{
  const std::uint32_t tree = this->TreeOfPatch.empty() ? None : this->TreeOfPatch[patch];
  return tree != None ? this->Trees[tree].At(point)
                      : Place{ solution.LeafAt(patch, point), nullptr };
}

void LightTexels::Tree::Build(const RadianceSolution& solution, RadianceSolution::NodeIndex root,
  const std::vector<Vec3>& points, const std::vector<Color>& irradiance)
{
  std::vector<Sample> samples;
  samples.reserve(points.size());
  for (std::size_t i = 0; i < points.size(); ++i)
  {
    samples.push_back({ this->Map.Of(points[i]), irradiance[i] });
  }
  this->Nodes.assign(1, {});
  this->Build(0, solution, root, samples.data(), samples.data() + samples.size(), 0);
}

LightTexels::Place LightTexels::Tree::At(const Vec3& point) const
{
  Vec2 place = this->Map.Of(point);
  const Node* node = &this->Nodes[0];
  while (node->firstChild != None)
  {
    node = &this->Nodes[node->firstChild + ToQuarter(this->Map.IsTriangle(), place)];
  }
  return { node->leaf, node->isLit ? &node->irradiance : nullptr };
}

/// `level` counts from the element that the node lies in.
void LightTexels::Tree::Build(std::uint32_t node, const RadianceSolution& solution,
  RadianceSolution::NodeIndex id, Sample* first, Sample* last, int level)
{
  const RadianceSolution::Element& element = solution.elements[id];
  const bool isInLeaf = element.childCount == 0;
  if (isInLeaf)
  {
    this->Nodes[node].leaf = id;
    this->Light(node, first, last);
    const bool isDark = element.firstLamp == element.lastLamp;
    if (isDark || last - first <= MostHits || level == MostLevels)
    {
      return;
    }
  }
  const std::uint32_t firstChild = this->Split(node);
  const std::array<Sample*, 5> bounds = this->Sort(first, last);
  for (std::uint32_t c = 0; c < 4; ++c)
  {
    this->Build(firstChild + c, solution, isInLeaf ? id : element.firstChild + c, bounds[c],
      bounds[c + 1], isInLeaf ? level + 1 : 0);
  }
}

void LightTexels::Tree::Light(std::uint32_t node, const Sample* first, const Sample* last)
{
  if (first == last)
  {
    return;
  }
  Color sum(0.0);
  for (const Sample* sample = first; sample != last; ++sample)
  {
    sum += sample->irradiance;
  }
  this->Nodes[node].irradiance = sum / static_cast<double>(last - first);
  this->Nodes[node].isLit = true;
}

/// The children start as copies of their parent.
std::uint32_t LightTexels::Tree::Split(std::uint32_t node)
{
  const auto firstChild = static_cast<std::uint32_t>(this->Nodes.size());
  const Node parent = this->Nodes[node];
  this->Nodes.resize(this->Nodes.size() + 4, parent);
  this->Nodes[node].firstChild = firstChild;
  return firstChild;
}

/// Moves the samples of each quarter together and on to coordinates within it. Returns where they
/// begin, and the end.
std::array<LightTexels::Tree::Sample*, 5> LightTexels::Tree::Sort(Sample* first, Sample* last) const
{
  for (Sample* sample = first; sample != last; ++sample)
  {
    sample->quarter = ToQuarter(this->Map.IsTriangle(), sample->place);
  }
  std::array<Sample*, 5> bounds{ first, last, last, last, last };
  for (std::uint32_t c = 0; c < 3; ++c)
  {
    bounds[c + 1] =
      std::partition(bounds[c], last, [c](const Sample& sample) { return sample.quarter == c; });
  }
  return bounds;
}

} // namespace vantage
