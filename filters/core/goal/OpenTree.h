#pragma once

#include "core/goal/PatchOrder.h"
#include "core/transport/ViewWeights.h"
#include "core/visibility/OccluderScene.h"

#include <cstdint>
#include <vector>

/// \file OpenTree.h
/// The part of the element tree that has been looked into.

namespace vantage
{

using OpenId = std::uint32_t;

/// A cluster, patch or element that takes part. A flat cluster (CutSurfaces.h) counts as a surface,
/// like a patch. Where it has no children here it is a leaf, whatever the element tree has below
/// it: a cluster that is a leaf is known by its means only.
struct OpenNode
{
  NodeId node = None;
  OpenId parent = None;
  OpenId firstChild = None;
  std::uint8_t childCount = 0;
  std::uint8_t level = 0;   ///< below the patch
  PatchId patch = None;     ///< of a flat cluster: one of its patches; None for other clusters
  double area = 0.0;        ///< exposed to the air: not under furniture
  double escaped = 0.0;     ///< part of what it sees that is outside the scene (probed)
  double escapeError = 0.0; ///< two standard deviations of that; 0: known exactly, 1: not at all
  double view = 0.0;        ///< area times V, sr
  double viewRms = 0.0;     ///< root mean square of V: how unevenly it lies in the node, sr m^-2
  double emissionRms = 0.0; ///< of a cluster, the same of the mean channel of the emission
  Color albedo{ 0.0 };      ///< means over the area
  Color emission{ 0.0 };    ///< W m^-2 sr^-1
  std::uint32_t firstSample = 0; ///< the view samples on it
  std::uint32_t lastSample = 0;

  bool IsLeaf() const { return this->childCount == 0; }
  bool IsCluster() const { return this->patch == None; }
  bool IsExposed() const { return this->area > 0.0; }
  bool IsUnprobed() const { return this->escapeError == 1.0; }
};

/// Opened from the root on demand. A parent has a smaller id than its children. Memory and time are
/// proportional to what was opened, but for one pass over the patches at the beginning.
class OpenTree
{
public:
  /// All must outlive this. `optics` of each patch.
  OpenTree(ElementTree tree, const OccluderScene& occluders, std::vector<PatchOptics> optics);

  /// Other materials for the same patches.
  void SetOptics(std::vector<PatchOptics> optics);
  /// Another view.
  void SetView(std::vector<ViewSample> samples);

  /// Makes the children of a node; nothing happens when it has some. Those of a patch or element
  /// are probed for what covers them, as are parts of a curved surface; other clusters in a closed
  /// one for whether they are closed as well.
  /// \pre MaySplit
  void Open(OpenId id);

  /// Makes the area of every inner node the sum of its children's. O(nodes).
  void SumAreas();

  OpenId Size() const { return static_cast<OpenId>(this->Nodes.size()); }
  const OpenNode& operator[](OpenId id) const { return this->Nodes[id]; }
  const Node& Geometry(OpenId id) const { return this->Elements[this->Nodes[id].node]; }
  Polygon Shape(OpenId id) const { return this->Elements.Shape(this->Nodes[id].node); }
  const Patch& PatchOf(OpenId id) const { return this->Elements.Patches()[this->Nodes[id].patch]; }
  PatchRange RangeOf(OpenId id) const { return this->Order.RangeOf(this->Nodes[id].node); }

  const ElementTree& Tree() const { return this->Elements; }
  const PatchOrder& Patches() const { return this->Order; }
  const std::vector<PatchOptics>& Optics() const { return this->Surfaces; }
  /// Emission that the view sees, times its solid angle: sum of V E A over the patches.
  const Color& EmissionInView() const { return this->SeenEmission; }
  std::uint64_t ProbeRays() const { return this->Rays; }
  std::size_t Bytes() const;

private:
  OpenNode Make(NodeId node, OpenId parent) const;
  void Measure(OpenNode& node) const;
  /// What the rays from points of a surface met.
  struct ProbeResult
  {
    std::uint32_t exposed = 0; ///< points in the air
    std::uint32_t escaped = 0; ///< of those, whose first ray met no side that takes part
    std::uint32_t rays = 0;
  };
  void Probe(OpenNode& node);
  ProbeResult ProbePoints(const OpenNode& node, std::uint32_t points);
  void ProbePoint(const Polygon& shape, const Patch& patch, std::uint64_t seed, std::uint32_t i,
    ProbeResult& result) const;
  void ProbeCluster(OpenNode& node);
  void HandDownSamples(OpenId id);
  void SumEmissionInView();
  double ViewRmsOfSurface(const OpenNode& node) const;
  void WeighView(OpenNode& node, std::uint32_t firstSample, std::uint32_t lastSample) const;

  ElementTree Elements;
  const OccluderScene* Occluders;
  std::vector<PatchOptics> Surfaces;
  PatchOrder Order;
  std::vector<OpenNode> Nodes;
  std::vector<ViewSample> Samples; ///< those of a node follow each other
  Color SeenEmission{ 0.0 };
  std::uint64_t Rays = 0;
};

} // namespace vantage
