#pragma once

#include "core/transport/RadianceSolution.h"
#include "core/view/LampSurface.h"
#include "core/visibility/OccluderScene.h"

#include <cstdint>
#include <vector>

/// \file NamedLamps.h
/// The lamps that a solution names, with what was cut joined again.

namespace vantage
{

/// Patches that are one lamp: of one convex part of a lamp's surface (LampParts.h), and of one
/// emission.
struct NamedLamp
{
  std::vector<PatchId> patches;          ///< ascending
  std::vector<Polygon> shapes;           ///< of each, counter-clockwise from its side
  LampSurface surface;                   ///< made of these
  Color emission;                        ///< W m^-2 sr^-1
  std::vector<std::uint32_t> convexPart; ///< facets of all of that, ascending
  std::vector<std::uint32_t> whole;      ///< and of the surface that it is a part of

  bool IsOfConvexPart(std::uint32_t facet) const;
  bool IsOfWhole(std::uint32_t facet) const;
};

/// Of each element the lamps that it names: a lamp is what it names of a convex part. Refers to
/// nothing.
class NamedLamps
{
public:
  /// O(elements + names log names).
  NamedLamps(const OccluderScene& occluders, const RadianceSolution& solution);

  using List = std::vector<std::uint32_t>; ///< of lamps, ascending
  const List& Of(RadianceSolution::NodeIndex leaf) const
  {
    return this->Lists[this->ListOfElement[leaf]];
  }
  const NamedLamp& operator[](std::uint32_t lamp) const { return this->Lamps[lamp]; }
  std::uint32_t Size() const { return static_cast<std::uint32_t>(this->Lamps.size()); }

private:
  std::vector<NamedLamp> Lamps;
  std::vector<List> Lists;
  std::vector<std::uint32_t> ListOfElement;
};

} // namespace vantage
