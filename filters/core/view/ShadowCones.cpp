#include "core/view/ShadowCones.h"

namespace vantage
{

ShadowCones::ShadowCones(const LampSurface& lamp)
  : Lamp(std::make_unique<LampHull>(lamp))
  , Plates(*this->Lamp)
  , Bodies(*this->Lamp)
{
}

std::uint32_t ShadowCones::Add(const Occluder& occluder)
{
  this->Occluders.push_back(occluder);
  return static_cast<std::uint32_t>(this->Occluders.size() - 1);
}

std::uint32_t ShadowCones::AddPlate(const Polygon& shape, std::optional<Side> inside)
{
  return this->Add({ false, this->Plates.Add(shape, inside) });
}

std::optional<std::uint32_t> ShadowCones::AddBody(const ConvexBody& body)
{
  const std::optional<std::uint32_t> index = this->Bodies.Add(body);
  return index ? std::optional(this->Add({ true, *index })) : std::nullopt;
}

bool ShadowCones::HidesAll(std::uint32_t occluder, const Polygon& points) const
{
  const auto [isBody, index] = this->Occluders[occluder];
  return isBody ? this->Bodies.HidesAll(index, points) : this->Plates.HidesAll(index, points);
}

bool ShadowCones::IsSharp(std::uint32_t occluder, const Polygon& points) const
{
  const auto [isBody, index] = this->Occluders[occluder];
  return isBody ? this->Bodies.IsSharp(index, points) : this->Plates.IsSharp(index, points);
}

bool ShadowCones::IsCone(std::uint32_t occluder) const
{
  const auto [isBody, index] = this->Occluders[occluder];
  return isBody || this->Plates.IsCone(index);
}

bool ShadowCones::SeesInside(std::uint32_t occluder, const Vec2& x) const
{
  const auto [isBody, index] = this->Occluders[occluder];
  return !isBody && this->Plates.SeesInside(index, x);
}

Cover ShadowCones::Cast(
  std::uint32_t occluder, const Vec2& x, std::vector<LampSurface::HalfSpace>& sides) const
{
  const auto [isBody, index] = this->Occluders[occluder];
  return isBody ? this->Bodies.Cast(index, x, sides) : this->Plates.Cast(index, x, sides);
}

} // namespace vantage
