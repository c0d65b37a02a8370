#pragma once

#include "core/view/DirectLight.h"
#include "core/view/LampCutter.h"
#include "core/view/LampKernel.h"
#include "core/view/PatchFrame.h"

#include <vector>

/// \file LampView.h
/// What the points of one patch see of one lamp.

namespace vantage
{

/// A point of the patch that asks, in the plane of its frame.
struct LampSpot
{
  Vec2 place;
  std::uint32_t index; ///< where the answer goes
};

/// One lamp over one patch, and what stands in between.
class LampView
{
public:
  /// \param lampShape counter-clockwise from the side that shines
  LampView(const OccluderScene& occluders, std::uint32_t facet, const PatchFrame& frame,
    std::uint32_t lampFacet, const Polygon& lampShape);

  /// Writes the integral of the cosine over what each spot sees of the lamp, in sr, to
  /// factors[index]. Changes the order of the spots.
  DirectCounters Look(LampSpot* first, LampSpot* last, double* factors) const;

private:
  /// All that may stand between the lamp and some points.
  struct Search
  {
    std::vector<std::uint32_t> facets; ///< of each occluder in the cutter
    LampCutter cutter;
  };
  /// Spots, and those occluders of a search that may be in the way.
  struct Group
  {
    LampSpot* first;
    LampSpot* last;
    std::vector<std::uint32_t> occluders;
  };

  Search SearchAround(const Group& all) const;
  bool Narrow(Group& group, const Search& search) const;
  DirectCounters Look(Group group, const Search& search, double* factors) const;
  DirectCounters LookHalves(const Group& group, const Search& search, double* factors) const;
  void LookAtEach(
    const Group& group, const Search& search, double* factors, DirectCounters& counters) const;
  double SeenByRays(const LampSpot& spot, DirectCounters& counters) const;
  Polygon Bounds(const Group& group) const;
  Polygon Between(std::uint32_t facet) const;
  Polygon ToWorld(const Polygon& local) const;

  const OccluderScene* Occluders;
  std::uint32_t Facet;
  std::uint32_t LampFacet;
  const PatchFrame* Frame;
  Polygon LampShape;
  double Unit = 1.0; ///< scene units in a local one
  Polygon Lamp;      ///< what is in front of the patch, local
  Plane LampPlane;   ///< local
  LampKernel Kernel;
};

} // namespace vantage
