#pragma once

#include "core/mesh/ElementTree.h"
#include "core/transport/PatchOptics.h"

#include <cstdint>
#include <vector>

/// \file PatchOrder.h
/// The patches in the order of the clusters, so that every cluster is a range of them.

namespace vantage
{

/// Places [first, last) of a PatchOrder.
struct PatchRange
{
  std::uint32_t first = 0;
  std::uint32_t last = 0;
};

/// Patches sorted so that those of a cluster follow each other. Sums over a cluster are differences
/// of running sums, and a patch is drawn from a cluster in O(log n), so nothing needs to be stored
/// for clusters that no one looks into.
class PatchOrder
{
public:
  /// O(nodes).
  PatchOrder(const ElementTree& tree, const std::vector<PatchOptics>& optics);

  PatchRange RangeOf(NodeId clusterOrPatch) const { return this->Ranges[clusterOrPatch]; }
  PatchId operator[](std::uint32_t place) const { return this->Patches[place]; }
  std::uint32_t PlaceOf(PatchId patch) const { return this->Places[patch]; }

  /// Sums over a range.
  double Area(const PatchRange& range) const { return Between(this->AreaBefore, range); }
  Color AreaTimesAlbedo(const PatchRange& range) const
  {
    return Between(this->AlbedoBefore, range);
  }
  Color AreaTimesEmission(const PatchRange& range) const
  {
    return Between(this->EmissionBefore, range);
  }
  /// Of the mean channel's square.
  double AreaTimesSquaredEmission(const PatchRange& range) const
  {
    return Between(this->SquareBefore, range);
  }

  /// Those of a range that emit.
  std::vector<PatchId> LampsIn(const PatchRange& range) const;
  /// How many, where those that are one surface (Node::IsSmooth) count once. O(log lamps).
  std::uint32_t LampCount(const PatchRange& range) const
  {
    const std::uint32_t first = this->LampsBefore(range.first);
    const std::uint32_t last = this->LampsBefore(range.last);
    return first < last ? this->LampNumbers[last - 1] - this->LampNumbers[first] + 1 : 0;
  }

  /// A patch drawn from a range, half of the chances by area and half by emitted power (all by area
  /// where nothing emits), and the density of a point drawn uniformly on it, per area.
  struct Draw
  {
    PatchId patch;
    double density;
  };
  Draw At(const PatchRange& range, double u) const;
  /// A patch drawn by area alone.
  PatchId ByArea(const PatchRange& range, double u) const;

  std::size_t Bytes() const;

private:
  template <typename T>
  static T Between(const std::vector<T>& before, const PatchRange& range)
  {
    return before[range.last] - before[range.first];
  }

  std::uint32_t LampsBefore(std::uint32_t place) const;

  std::vector<PatchRange> Ranges; ///< of clusters and patches; elements have none
  std::vector<PatchId> Patches;
  std::vector<std::uint32_t> Places; ///< of each patch
  std::vector<double> AreaBefore;    ///< sums over the places before one
  std::vector<double> PowerBefore;   ///< area times mean emission
  std::vector<double> SquareBefore;  ///< area times squared mean emission
  std::vector<Color> AlbedoBefore;
  std::vector<Color> EmissionBefore;
  std::vector<std::uint32_t> LampPlaces;  ///< of the patches that emit; ascending
  std::vector<std::uint32_t> LampNumbers; ///< of these; the same on one curved surface
};

} // namespace vantage
