#include "core/goal/PatchOrder.h"

#include "core/mesh/CurvedSurfaces.h"

#include <algorithm>

namespace vantage
{

namespace
{

/// The place in [range.first, range.last) where the running sum passes the target.
std::uint32_t PlaceWhere(const std::vector<double>& before, const PatchRange& range, double target)
{
  const auto first = before.begin() + range.first + 1;
  const auto last = before.begin() + range.last;
  return range.first + static_cast<std::uint32_t>(std::upper_bound(first, last, target) - first);
}

} // namespace

PatchOrder::PatchOrder(const ElementTree& tree, const std::vector<PatchOptics>& optics)
  : Ranges(tree.Size())
  , Places(tree.Patches().size(), None)
{
  const auto visit = [&](const auto& self, NodeId node) -> void
  {
    const auto first = static_cast<std::uint32_t>(this->Patches.size());
    if (tree[node].IsCluster())
    {
      self(self, tree[node].firstChild);
      self(self, tree[node].firstChild + 1);
    }
    else
    {
      this->Places[tree[node].patch] = first;
      this->Patches.push_back(tree[node].patch);
    }
    this->Ranges[node] = { first, static_cast<std::uint32_t>(this->Patches.size()) };
  };
  visit(visit, tree.Root());
  const std::size_t count = this->Patches.size() + 1;
  this->AreaBefore.reserve(count);
  this->PowerBefore.reserve(count);
  this->SquareBefore.reserve(count);
  this->AlbedoBefore.reserve(count);
  this->EmissionBefore.reserve(count);
  this->AreaBefore.push_back(0.0);
  this->PowerBefore.push_back(0.0);
  this->SquareBefore.push_back(0.0);
  this->AlbedoBefore.emplace_back(0.0);
  this->EmissionBefore.emplace_back(0.0);
  NodeId lastSurface = None; // with a lamp
  for (std::uint32_t place = 0; place < this->Patches.size(); ++place)
  {
    const PatchId patch = this->Patches[place];
    const double area = tree[tree.Patches()[patch].node].area;
    const PatchOptics& surface = optics[patch];
    this->AreaBefore.push_back(this->AreaBefore.back() + area);
    const double emission = Mean(surface.emission);
    this->PowerBefore.push_back(this->PowerBefore.back() + area * emission);
    this->SquareBefore.push_back(this->SquareBefore.back() + area * emission * emission);
    this->AlbedoBefore.push_back(this->AlbedoBefore.back() + area * surface.albedo);
    this->EmissionBefore.push_back(this->EmissionBefore.back() + area * surface.emission);
    if (emission > 0.0)
    {
      const NodeId itsSurface = SurfaceAbove(tree, tree.Patches()[patch].node);
      const std::uint32_t lastNumber = this->LampNumbers.empty() ? 0 : this->LampNumbers.back();
      this->LampNumbers.push_back(lastNumber + (itsSurface != lastSurface ? 1 : 0));
      lastSurface = itsSurface;
      this->LampPlaces.push_back(place);
    }
  }
}

PatchOrder::Draw PatchOrder::At(const PatchRange& range, double u) const
{
  const double area = this->Area(range);
  const double power = Between(this->PowerBefore, range);
  const double shareOfPower = power > 0.0 ? 0.5 : 0.0;
  const bool isByPower = u < shareOfPower;
  const double v = isByPower ? u / shareOfPower : (u - shareOfPower) / (1.0 - shareOfPower);
  const std::uint32_t place =
    isByPower ? PlaceWhere(this->PowerBefore, range, this->PowerBefore[range.first] + v * power)
              : PlaceWhere(this->AreaBefore, range, this->AreaBefore[range.first] + v * area);
  const PatchRange one{ place, place + 1 };
  double density = (1.0 - shareOfPower) / area;
  if (shareOfPower > 0.0)
  {
    density += shareOfPower * Between(this->PowerBefore, one) / (power * this->Area(one));
  }
  return { this->Patches[place], density };
}

PatchId PatchOrder::ByArea(const PatchRange& range, double u) const
{
  const double target = this->AreaBefore[range.first] + u * this->Area(range);
  return this->Patches[PlaceWhere(this->AreaBefore, range, target)];
}

std::uint32_t PatchOrder::LampsBefore(std::uint32_t place) const
{
  const auto found = std::lower_bound(this->LampPlaces.begin(), this->LampPlaces.end(), place);
  return static_cast<std::uint32_t>(found - this->LampPlaces.begin());
}

std::vector<PatchId> PatchOrder::LampsIn(const PatchRange& range) const
{
  std::vector<PatchId> lamps;
  for (std::uint32_t k = this->LampsBefore(range.first); k < this->LampsBefore(range.last); ++k)
  {
    lamps.push_back(this->Patches[this->LampPlaces[k]]);
  }
  return lamps;
}

std::size_t PatchOrder::Bytes() const
{
  return this->Ranges.capacity() * sizeof(PatchRange) +
         (this->Patches.capacity() + this->Places.capacity() + this->LampPlaces.capacity() +
           this->LampNumbers.capacity()) *
           sizeof(std::uint32_t) +
         3 * this->AreaBefore.capacity() * sizeof(double) +
         2 * this->AlbedoBefore.capacity() * sizeof(Color);
}

} // namespace vantage
