#include "core/view/LampCutter.h"

#include <algorithm>
#include <cmath>
#include <tuple>

namespace vantage
{

namespace
{

/// Parts that are cut by a shadow, in all: they take about twice the time of two hundred rays.
constexpr std::size_t MostEffort = 4000;
/// Cosine of the largest angle from the middle of an outline to its corners: beyond it they are too
/// far out in the plane that it is drawn in.
constexpr double LeastCosine = 0.05;

} // namespace

LampCutter::LampCutter(const LampSurface& lamp)
  : Lamp(&lamp)
  , Cones(lamp)
{
  if (lamp.Size() == 1)
  {
    this->Only.emplace(lamp.Face(0), lamp.PlaneOf(0));
  }
}

std::optional<double> LampCutter::Seen(
  const Vec2& x, const std::vector<Suspect>& suspects, Shadows& shadows) const
{
  shadows.All.clear();
  shadows.Sides.clear();
  shadows.AreCones = true;
  for (const Suspect& suspect : suspects)
  {
    const auto first = static_cast<std::uint32_t>(shadows.Sides.size());
    const Cover cover = this->Cones.Cast(suspect.occluder, x, shadows.Sides);
    if (cover == Cover::Whole)
    {
      shadows.All.clear();
      return 0.0;
    }
    if (cover == Cover::Part &&
        !(suspect.isSeenFromOutside && this->Cones.SeesInside(suspect.occluder, x)))
    {
      shadows.All.push_back({ first, static_cast<std::uint32_t>(shadows.Sides.size()) });
      shadows.AreCones = shadows.AreCones && this->Cones.IsCone(suspect.occluder);
    }
    else
    {
      shadows.Sides.resize(first);
    }
  }
  return shadows.All.empty() ? this->Lamp->At(x, shadows.Room) : this->SeenPast(x, shadows);
}

std::optional<double> LampCutter::SeenPast(const Vec2& x, Shadows& shadows) const
{
  shadows.Effort = 0;
  shadows.OfFace = shadows.All;
  if (this->Only) // it is the hull, which all of them cut
  {
    return SeenOfFace(*this->Only, x, shadows);
  }
  if (!this->Lamp->FindSeen(x, shadows.Room.seen))
  {
    return 0.0;
  }
  return shadows.AreCones && this->FindOutline(x, shadows)
           ? SeenOfFace(shadows.Silhouette, x, shadows)
           : this->SeenOfFaces(x, shadows);
}

/// The outline of what x sees, in a plane at unit distance. That it may be hollow does no harm:
/// what is cut off in several pieces is joined by lines that add nothing.
bool LampCutter::FindOutline(const Vec2& x, Shadows& shadows) const
{
  if (!this->Lamp->FindOutline(shadows.Room, shadows.Outline))
  {
    return false;
  }
  const Vec3 eye(x, 0.0);
  Vec3 middle(0.0);
  for (const Vec3& corner : shadows.Outline)
  {
    middle += corner - eye;
  }
  const Vec3 ahead = glm::normalize(middle);
  const Vec3 size = glm::abs(ahead);
  const Vec3 across = size.x <= std::min(size.y, size.z) ? Vec3(1.0, 0.0, 0.0)
                      : size.y <= size.z                 ? Vec3(0.0, 1.0, 0.0)
                                                         : Vec3(0.0, 0.0, 1.0);
  const Vec3 alongU = glm::normalize(glm::cross(ahead, across));
  const Vec3 alongV = glm::cross(ahead, alongU);
  shadows.Silhouette.Start(eye + ahead, alongU, alongV);
  for (const Vec3& corner : shadows.Outline)
  {
    const Vec3 way = corner - eye;
    const double depth = glm::dot(way, ahead);
    if (!(depth > LeastCosine * glm::length(way)))
    {
      return false;
    }
    shadows.Silhouette.Add({ glm::dot(way, alongU) / depth, glm::dot(way, alongV) / depth });
  }
  return true;
}

std::optional<double> LampCutter::SeenOfFaces(const Vec2& x, Shadows& shadows) const
{
  if (!this->SortFaces(shadows))
  {
    shadows.TooMany = true;
    return std::nullopt;
  }
  LampSurface::Workspace& room = shadows.Room;
  double seen = 0.0;
  for (auto first = shadows.Partly.begin(); first != shadows.Partly.end();)
  {
    const std::uint32_t face = first->face;
    shadows.OfFace.clear();
    for (; first != shadows.Partly.end() && first->face == face; ++first)
    {
      shadows.OfFace.push_back(first->shadow);
    }
    if (room.seen[face] == 0)
    {
      continue; // another shadow hides all of it
    }
    room.seen[face] = 0;
    const auto part = SeenOfFace({ this->Lamp->Face(face), this->Lamp->PlaneOf(face) }, x, shadows);
    if (!part)
    {
      return std::nullopt;
    }
    seen += *part;
  }
  return seen + this->Lamp->OfSeen(x, room.seen);
}

/// Those that a shadow hides as a whole are not seen; those that it hides in part are noted. False
/// when a shadow has too many sides.
bool LampCutter::SortFaces(Shadows& shadows) const
{
  shadows.Partly.clear();
  for (const Shadows::Shadow& shadow : shadows.All)
  {
    if (shadow.Count() > LampSurface::MostHalfSpaces)
    {
      return false;
    }
    shadows.Faces.clear();
    this->Lamp->Sort(
      &shadows.Sides[shadow.firstSide], shadow.Count(), shadows.Room.seen, shadows.Faces);
    for (const std::uint32_t face : shadows.Faces)
    {
      shadows.Partly.push_back({ face, shadow });
    }
  }
  std::stable_sort(shadows.Partly.begin(), shadows.Partly.end(),
    [](const auto& a, const auto& b) { return a.face < b.face; });
  return true;
}

/// Past shadows.OfFace. Those of few sides first: they hide most, and leave few parts to the
/// others.
std::optional<double> LampCutter::SeenOfFace(
  const FaceParts::Face& face, const Vec2& x, Shadows& shadows)
{
  using Shadow = Shadows::Shadow;
  std::sort(shadows.OfFace.begin(), shadows.OfFace.end(),
    [](const Shadow& a, const Shadow& b)
    { return std::make_tuple(a.Count(), a.firstSide) < std::make_tuple(b.Count(), b.firstSide); });
  shadows.Parts.Start(face);
  for (const Shadow& shadow : shadows.OfFace)
  {
    shadows.Effort += shadows.Parts.Size();
    if (shadows.Effort > MostEffort)
    {
      shadows.TooMany = true;
      return std::nullopt;
    }
    shadows.Parts.Take(&shadows.Sides[shadow.firstSide], shadow.Count());
  }
  return shadows.Parts.At(x);
}

} // namespace vantage
