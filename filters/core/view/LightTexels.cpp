#include "core/view/LightTexels.h"

#include "core/mesh/PackedLists.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>

namespace vantage
{

namespace
{

/// Fewer hits tell little of a patch, as each may be wrong.
constexpr std::size_t LeastHits = 4;
/// With more hits a texel is quartered.
constexpr std::ptrdiff_t MostHits = 8;
/// Below an element, if hits lie in one place.
constexpr int MostLevels = 20;

} // namespace

LightTexels::LightTexels(const OccluderScene& occluders, const RadianceSolution& solution,
  const std::vector<Hit>& sample, const std::vector<Color>& irradiance)
  : TreeOfPatch(solution.albedo.size(), None)
{
  const PackedLists<std::uint32_t> hits(this->TreeOfPatch.size(),
    [&](const auto& visit)
    {
      for (std::uint32_t k = 0; k < sample.size(); ++k)
      {
        visit(sample[k].Patch(), k);
      }
    });
  std::vector<PatchId> patches;
  for (PatchId patch = 0; patch < this->TreeOfPatch.size(); ++patch)
  {
    const auto met = hits.Of(patch);
    if (met.begin() != met.end())
    {
      this->TreeOfPatch[patch] = static_cast<std::uint32_t>(this->Trees.size());
      this->Trees.emplace_back(PatchCoordinates(ShapeOf(occluders, patch)));
      patches.push_back(patch);
    }
  }
  tbb::parallel_for(std::size_t(0), patches.size(),
    [&](std::size_t k)
    {
      for (const std::uint32_t i : hits.Of(patches[k]))
      {
        this->Trees[k].Add(sample[i].point, irradiance[i]);
      }
      this->Trees[k].Build(solution, solution.elementOfPatch[patches[k]]);
    });
  std::uint32_t number = 0;
  for (Tree& tree : this->Trees)
  {
    number = tree.NumberTexels(number);
  }
}

LightTexels::Place LightTexels::At(
  const RadianceSolution& solution, PatchId patch, const Vec3& point) const
{
  const std::uint32_t tree = this->TreeOfPatch.empty() ? None : this->TreeOfPatch[patch];
  return tree != None ? this->Trees[tree].At(point)
                      : Place{ solution.LeafAt(patch, point), nullptr, None, {} };
}

std::vector<LightTexels::Texel> LightTexels::All(const OccluderScene& occluders) const
{
  std::vector<Texel> texels;
  for (PatchId patch = 0; patch < this->TreeOfPatch.size(); ++patch)
  {
    if (this->TreeOfPatch[patch] != None)
    {
      this->Trees[this->TreeOfPatch[patch]].List(patch, ShapeOf(occluders, patch), texels);
    }
  }
  return texels;
}

void LightTexels::Tree::Add(const Vec3& point, const Color& irradiance)
{
  this->Samples.push_back({ this->Map.Of(point), irradiance });
}

void LightTexels::Tree::Build(const RadianceSolution& solution, RadianceSolution::NodeIndex root)
{
  this->Nodes.assign(1, {});
  this->IsKnown = this->Samples.size() >= LeastHits;
  Sample* const first = this->Samples.data();
  this->Build(0, solution, root, first, first + this->Samples.size(), 0);
  this->Samples = {};
}

LightTexels::Place LightTexels::Tree::At(const Vec3& point) const
{
  Vec2 place = this->Map.Of(point);
  const Node* node = &this->Nodes[0];
  while (node->firstChild != None)
  {
    node = &this->Nodes[node->firstChild + ToQuarter(this->Map.IsTriangle(), place)];
  }
  return { node->leaf, IrradianceOf(*node), node->texel, place };
}

/// In the order of the nodes, as List() goes through them.
std::uint32_t LightTexels::Tree::NumberTexels(std::uint32_t first)
{
  for (Node& node : this->Nodes)
  {
    node.texel = node.firstChild == None ? first++ : None;
  }
  return first;
}

void LightTexels::Tree::List(PatchId patch, const Polygon& shape, std::vector<Texel>& texels) const
{
  std::vector<Polygon> shapes(this->Nodes.size());
  shapes[0] = shape;
  for (std::size_t n = 0; n < this->Nodes.size(); ++n)
  {
    const Node& node = this->Nodes[n];
    if (node.firstChild == None)
    {
      texels.push_back({ patch, shapes[n], node.leaf, IrradianceOf(node), node.hits });
      continue;
    }
    const std::array<Polygon, 4> quarters = Quarters(shapes[n]);
    std::copy(quarters.begin(), quarters.end(), shapes.begin() + node.firstChild);
  }
}

/// `level` counts from the element that the node lies in.
void LightTexels::Tree::Build(std::uint32_t node, const RadianceSolution& solution,
  RadianceSolution::NodeIndex id, Sample* first, Sample* last, int level)
{
  const RadianceSolution::Element& element = solution.elements[id];
  const bool isInLeaf = element.childCount == 0;
  this->Nodes[node].hits = static_cast<std::uint32_t>(last - first);
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
  if (first == last || !this->IsKnown)
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
