#include "core/goal/OpenTree.h"

#include "core/math/ScrambledSobol.h"
#include "core/transport/RadianceSolution.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace vantage
{

namespace
{

/// Points of a patch that are probed; a child inherits what is the same all over its parent.
constexpr std::uint32_t ProbesOfPatch = 64;
constexpr std::uint32_t ProbesOfElement = 16;
constexpr std::uint32_t ProbesOfCluster = 64;
/// A point from which so many rays in turn meet inactive sides is inside something.
constexpr int RaysToTellCovered = 4;

} // namespace

OpenTree::OpenTree(
  ElementTree tree, const OccluderScene& occluders, std::vector<PatchOptics> optics)
  : Elements(std::move(tree))
  , Occluders(&occluders)
  , Surfaces(std::move(optics))
  , Order(this->Elements, this->Surfaces)
{
  this->Nodes.push_back(this->Make(this->Elements.Root(), None));
  this->Probe(this->Nodes.back());
}

void OpenTree::SetOptics(std::vector<PatchOptics> optics)
{
  this->Surfaces = std::move(optics);
  this->Order = PatchOrder(this->Elements, this->Surfaces);
  for (OpenNode& node : this->Nodes)
  {
    this->Measure(node);
  }
  this->SumEmissionInView();
}

void OpenTree::SetView(std::vector<ViewSample> samples)
{
  this->Samples = std::move(samples);
  std::stable_sort(this->Samples.begin(), this->Samples.end(),
    [this](const ViewSample& a, const ViewSample& b)
    { return this->Order.PlaceOf(a.patch) < this->Order.PlaceOf(b.patch); });
  this->WeighView(this->Nodes.front(), 0, static_cast<std::uint32_t>(this->Samples.size()));
  for (OpenId id = 0; id < this->Size(); ++id)
  {
    this->HandDownSamples(id);
  }
  this->SumEmissionInView();
}

void OpenTree::SumEmissionInView()
{
  this->SeenEmission = Color(0.0);
  for (const ViewSample& sample : this->Samples)
  {
    this->SeenEmission += sample.weight * this->Surfaces[sample.patch].emission;
  }
}

void OpenTree::Open(OpenId id)
{
  if (!this->Nodes[id].IsLeaf())
  {
    return;
  }
  const NodeId node = this->Nodes[id].node;
  if (this->Elements[node].IsLeaf())
  {
    this->Elements.Split(node);
  }
  const NodeId firstChild = this->Elements[node].firstChild;
  this->Nodes[id].firstChild = this->Size();
  this->Nodes[id].childCount = this->Elements[node].childCount;
  for (int c = 0; c < this->Elements[node].childCount; ++c)
  {
    OpenNode child = this->Make(firstChild + c, id);
    this->Probe(child);
    this->Nodes.push_back(child);
  }
  this->HandDownSamples(id);
}

void OpenTree::SumAreas()
{
  for (OpenId id = this->Size(); id-- > 0;)
  {
    OpenNode& node = this->Nodes[id];
    if (node.IsLeaf())
    {
      continue;
    }
    double sum = 0.0;
    for (OpenId c = node.firstChild; c < node.firstChild + node.childCount; ++c)
    {
      sum += this->Nodes[c].area;
    }
    // Probes of the parent may have found air that those of the children missed.
    node.area = sum > 0.0 ? sum : node.area;
  }
}

std::size_t OpenTree::Bytes() const
{
  return this->Elements.Size() * sizeof(Node) + this->Elements.Patches().size() * sizeof(Patch) +
         this->Surfaces.capacity() * sizeof(PatchOptics) + this->Order.Bytes() +
         this->Nodes.capacity() * sizeof(OpenNode) + this->Samples.capacity() * sizeof(ViewSample);
}

OpenNode OpenTree::Make(NodeId node, OpenId parent) const
{
  OpenNode made;
  made.node = node;
  made.parent = parent;
  const Node& element = this->Elements[node];
  made.patch = element.IsCluster() && element.HasShape()
                 ? this->Order[this->Order.RangeOf(node).first]
                 : element.patch;
  made.level = this->Elements[node].level;
  made.area = this->Elements[node].area;
  this->Measure(made);
  return made;
}

void OpenTree::Measure(OpenNode& node) const
{
  if (!node.IsCluster())
  {
    node.albedo = this->Surfaces[node.patch].albedo;
    node.emission = this->Surfaces[node.patch].emission;
    return;
  }
  const PatchRange range = this->Order.RangeOf(node.node);
  const double area = this->Order.Area(range);
  node.albedo = this->Order.AreaTimesAlbedo(range) / area;
  node.emission = this->Order.AreaTimesEmission(range) / area;
  node.emissionRms = std::sqrt(this->Order.AreaTimesSquaredEmission(range) / area);
}

void OpenTree::Probe(OpenNode& node)
{
  if (!this->Elements[node.node].IsSmooth())
  {
    this->ProbeCluster(node);
    return;
  }
  const bool isPartOfSurface =
    node.parent != None && this->Elements[this->Nodes[node.parent].node].IsSmooth();
  if (isPartOfSurface)
  {
    const OpenNode& parent = this->Nodes[node.parent];
    const bool isWholeInAir = parent.area == this->Elements[parent.node].area;
    if ((isWholeInAir && parent.escapeError == 0.0) || !parent.IsExposed())
    {
      node.area = parent.IsExposed() ? node.area : 0.0;
      return;
    }
  }
  const std::uint32_t points = isPartOfSurface ? ProbesOfElement : ProbesOfPatch;
  const ProbeResult met = this->ProbePoints(node, points);
  node.area *= static_cast<double>(met.exposed) / points;
  if (met.escaped > 0)
  {
    node.escaped = static_cast<double>(met.escaped) / met.exposed;
    node.escapeError =
      2.0 * std::sqrt((node.escaped * (1.0 - node.escaped) + 1.0 / met.exposed) / met.exposed);
  }
}

/// Points of a surface, drawn by area from the patches of a curved one.
OpenTree::ProbeResult OpenTree::ProbePoints(const OpenNode& node, std::uint32_t points)
{
  const std::uint64_t seed = Hash(node.node);
  ProbeResult met;
  for (std::uint32_t i = 0; i < points; ++i)
  {
    if (node.IsCluster())
    {
      const PatchRange range = this->Order.RangeOf(node.node);
      const Patch& drawn =
        this->Elements.Patches()[this->Order.ByArea(range, ScrambledSobol(i, Hash(seed, 0)).x)];
      this->ProbePoint(this->Elements.Shape(drawn.node), drawn, seed, i, met);
    }
    else
    {
      this->ProbePoint(
        this->Elements.Shape(node.node), this->Elements.Patches()[node.patch], seed, i, met);
    }
  }
  this->Rays += met.rays;
  return met;
}

/// The i-th of the points of a node, each with its own direction.
void OpenTree::ProbePoint(const Polygon& shape, const Patch& patch, std::uint64_t seed,
  std::uint32_t i, ProbeResult& result) const
{
  const Frame frame(patch.normal);
  const std::array<double, 4> u = ScrambledSobol4(i, seed);
  const Vec3 point = PointAt(shape, { u[0], u[1] });
  RandomStream random(seed, i);
  for (int k = 0; k < RaysToTellCovered; ++k)
  {
    ++result.rays;
    const Vec2 v = k == 0 ? Vec2(u[2], u[3]) : random.Next2();
    const auto hit =
      this->Occluders->Intersect(point, frame.ToWorld(CosineHemisphere(v)), patch.facet);
    const bool isActive = hit && this->Elements.Patches()[hit->Patch()].IsActive();
    if (!hit || isActive)
    {
      ++result.exposed;
      result.escaped += isActive && k == 0 ? 0 : 1;
      return;
    }
  }
}

/// Whether anything escapes: how much says little of what a cluster has in it. Where it does from
/// the parent, nothing is known of the parts.
void OpenTree::ProbeCluster(OpenNode& node)
{
  node.escapeError = 1.0;
  if (node.parent != None && this->Nodes[node.parent].IsUnprobed())
  {
    return;
  }
  const std::uint64_t seed = Hash(node.node);
  const PatchRange range = this->Order.RangeOf(node.node);
  ProbeResult met;
  for (std::uint32_t i = 0; i < ProbesOfCluster && met.escaped == 0; ++i)
  {
    const PatchId patch = this->Order.ByArea(range, ScrambledSobol(i, Hash(seed, 0)).x);
    const Patch& drawn = this->Elements.Patches()[patch];
    this->ProbePoint(this->Elements.Shape(drawn.node), drawn, seed, i, met);
  }
  this->Rays += met.rays;
  if (met.exposed > 0 && met.escaped == 0)
  {
    node.escapeError = 0.0;
  }
}

void OpenTree::HandDownSamples(OpenId id)
{
  const OpenNode parent = this->Nodes[id];
  std::uint32_t first = parent.firstSample;
  for (OpenId c = parent.firstChild; !parent.IsLeaf() && c < parent.firstChild + parent.childCount;
       ++c)
  {
    OpenNode& child = this->Nodes[c];
    const auto begin = this->Samples.begin() + first;
    const auto end = this->Samples.begin() + parent.lastSample;
    const auto isInside = [&](const ViewSample& sample)
    {
      return this->Elements[parent.node].IsCluster()
               ? this->Order.PlaceOf(sample.patch) < this->Order.RangeOf(child.node).last
               : this->Elements.ChildContaining(parent.node, sample.point) == child.node;
    };
    const auto middle = std::stable_partition(begin, end, isInside);
    this->WeighView(child, first, static_cast<std::uint32_t>(middle - this->Samples.begin()));
    first = child.lastSample;
  }
}

void OpenTree::WeighView(OpenNode& node, std::uint32_t firstSample, std::uint32_t lastSample) const
{
  node.firstSample = firstSample;
  node.lastSample = lastSample;
  node.view = 0.0;
  double squares = 0.0;
  // The samples of a cluster are sorted by patch.
  for (std::uint32_t i = firstSample; i < lastSample;)
  {
    const PatchId patch = this->Samples[i].patch;
    double weight = 0.0;
    for (; i < lastSample && this->Samples[i].patch == patch; ++i)
    {
      weight += this->Samples[i].weight;
    }
    node.view += weight;
    squares += weight * weight / this->Elements[this->Elements.Patches()[patch].node].area;
  }
  node.viewRms = node.IsCluster() ? std::sqrt(squares / node.area) : this->ViewRmsOfSurface(node);
}

/// From the view of each of a few equal parts: as uneven as the samples can tell.
double OpenTree::ViewRmsOfSurface(const OpenNode& node) const
{
  if (node.firstSample == node.lastSample || !node.IsExposed())
  {
    return 0.0;
  }
  constexpr int Side = 4;
  std::array<double, Side * Side> parts{};
  const PatchCoordinates coordinates(this->Elements.Shape(node.node));
  for (std::uint32_t i = node.firstSample; i < node.lastSample; ++i)
  {
    const Vec2 st = coordinates.Of(this->Samples[i].point) * static_cast<double>(Side);
    const auto column = static_cast<int>(std::clamp(st.x, 0.0, Side - 0.5));
    const auto row = static_cast<int>(std::clamp(st.y, 0.0, Side - 0.5));
    parts[row * Side + column] += this->Samples[i].weight;
  }
  double squares = 0.0;
  for (const double weight : parts)
  {
    squares += weight * weight;
  }
  return std::sqrt(squares * Side * Side) / node.area;
}

} // namespace vantage
