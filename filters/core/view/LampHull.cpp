#include "core/view/LampHull.h"

#include "core/mesh/Bounds.h"

namespace vantage
{

/// The box around many faces has few corners.
LampHull::LampHull(const LampSurface& lamp)
  : TheLamp(&lamp)
  , Hull(lamp.Corners())
{
  if (lamp.Size() == 1)
  {
    return;
  }
  Bounds box;
  for (const Vec3& corner : lamp.Corners())
  {
    box.Add(corner);
  }
  this->Hull.clear();
  for (int k = 0; k < 8; ++k)
  {
    const auto choose = [&](int axis)
    { return (k >> axis & 1) != 0 ? box.High()[axis] : box.Low()[axis]; };
    this->Hull.emplace_back(choose(0), choose(1), choose(2));
  }
}

/// How much of the lamp itself is inside of a side.
Cover LampHull::LampBehind(const LampSurface::HalfSpace& side) const
{
  const Cover ofHull = this->HullBehind(side);
  if (ofHull != Cover::Part)
  {
    return ofHull;
  }
  return CoverOfHeights(
    this->TheLamp->Corners(), [&side](const Vec3& corner) { return side.Height(corner); });
}

bool LampHull::PassesBetween(const ShadowEdge& edge, double sign, const Polygon& points) const
{
  bool anyNone = false;
  bool anyWhole = false;
  for (const Vec3& x : points)
  {
    const Cover cover = this->LampBehind(edge.SideBehind(sign, x));
    anyNone = anyNone || cover == Cover::None;
    anyWhole = anyWhole || cover == Cover::Whole;
  }
  return anyNone && anyWhole;
}

std::optional<Plane> LampHull::FaceInFrontOf(const std::vector<Vec3>& corners) const
{
  for (std::uint32_t face = 0; face < this->TheLamp->Size(); ++face)
  {
    if (AreInFront(corners, this->TheLamp->PlaneOf(face)))
    {
      return this->TheLamp->PlaneOf(face);
    }
  }
  return std::nullopt;
}

} // namespace vantage
