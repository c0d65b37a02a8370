#pragma once

#include "core/view/DirectLight.h"
#include "core/view/LampObstacles.h"
#include "core/view/LampSurface.h"
#include "core/view/NamedLamps.h"
#include "core/view/PatchFrame.h"

#include <optional>
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
  /// All must outlive this. \param frame of the facet
  LampView(const OccluderScene& occluders, std::uint32_t facet, const PatchFrame& frame,
    const NamedLamp& lamp);

  /// Writes the integral of the cosine over what each spot sees of the lamp, in sr, to
  /// factors[index]. Changes the order of the spots.
  /// \param tolerance that spots may err by, relative to the most that spots around see; 0: none
  DirectCounters Look(LampSpot* first, LampSpot* last, double tolerance, double* factors) const;

private:
  /// All that may stand between the lamp and some points.
  struct Search
  {
    LampObstacles obstacles;
    double tolerance;
  };
  /// Spots, and those occluders of a search that may be in the way.
  struct Group
  {
    LampSpot* first;
    LampSpot* last;
    std::vector<LampCutter::Suspect> suspects;
  };

  LampOverPatch Place() const
  {
    return { this->Occluders, this->Facet, this->Frame, this->Named, this->Unit, &this->Lamp };
  }
  LampObstacles ObstaclesOf(const Group& all) const;
  std::vector<std::uint32_t> FacetsFrom(const Polygon& ground) const;
  bool Narrow(Group& group, const Search& search) const;
  void LookForBodies(Group& group, const Search& search, const Polygon& ground) const;
  DirectCounters Look(Group group, const Search& search, double* factors) const;
  DirectCounters LookHalves(const Group& group, const Search& search, double* factors) const;
  bool IsSmall(const Group& group, const Search& search) const;
  bool IsWorthAFit(const Group& group, const Search& search) const;
  bool LookSmoothly(
    const Group& group, const Search& search, double* factors, DirectCounters& counters) const;
  void LookAtEach(
    const Group& group, const Search& search, double* factors, DirectCounters& counters) const;
  double SeenFrom(const Vec2& place, const Group& group, const Search& search,
    LampCutter::Shadows& shadows, DirectCounters& counters) const;
  double SeenByRays(const Vec2& place, DirectCounters& counters) const;
  std::optional<ConvexRegion> ShaftFrom(const Polygon& ground) const;
  Polygon Bounds(const Group& group) const;
  Polygon ToWorld(const Polygon& local) const;

  const OccluderScene* Occluders;
  std::uint32_t Facet;
  const PatchFrame* Frame;
  const NamedLamp* Named;
  double Unit = 1.0;          ///< scene units in a local one
  LampSurface Lamp;           ///< what is in front of the patch, local
  std::optional<Plane> Front; ///< of the lamp, local, if it is flat
  std::vector<Vec3> Corners;  ///< of the lamp, in the scene
};

} // namespace vantage
