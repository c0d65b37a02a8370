#include "core/view/LampCutter.h"

#include "core/view/PatchFrame.h"

#include <algorithm>
#include <cmath>

namespace vantage
{

namespace
{

/// Parts that are cut by a shadow, in all: they take about twice the time of two hundred rays.
constexpr std::size_t MostEffort = 4000;
/// Of the lamp: what rounding leaves between shadows of neighbours.
constexpr double LargestSliver = 1e-12;

} // namespace

LampCutter::LampCutter(const Polygon& lamp)
  : Kernel(lamp)
  , Shape(lamp)
{
  const PatchFrame frame(lamp);
  this->Origin = frame.origin;
  this->A = frame.x;
  this->B = frame.y;
  for (const Vec3& v : lamp)
  {
    this->Lamp.corners[this->Lamp.count++] = frame.InPlane(v);
  }
  this->Sliver = LargestSliver * Area(this->Lamp);
}

std::uint32_t LampCutter::AddOccluder(const Polygon& shape, std::optional<Side> inside)
{
  const Vec3 normal = AreaNormal(shape);
  const auto first = static_cast<std::uint32_t>(this->Edges.size());
  this->Occluders.push_back(
    { { -glm::dot(normal, shape[0]), normal.x, normal.y }, first, first + shape.Size(), inside });
  for (int i = 0; i < shape.Size(); ++i)
  {
    // The normal of the plane through x and the edge, n(x) = moment - along x x, towards a place
    // y: dot(n(x), y - x), of which the products with x alone are linear as well.
    const Vec3 along = shape[(i + 1) % shape.Size()] - shape[i];
    const Vec3 moment = glm::cross(along, shape[i]);
    const auto towards = [&](const Vec3& v)
    {
      return Affine{ glm::dot(moment, v), along.y * v.z - along.z * v.y,
        along.z * v.x - along.x * v.z };
    };
    const auto height = [&](const Vec3& place)
    {
      const Affine d = towards(place);
      return Affine{ d.constant, d.x - moment.x, d.y - moment.y };
    };
    this->Edges.push_back({ towards(this->A), towards(this->B), height(this->Origin) });
    for (const Vec3& corner : this->Shape)
    {
      this->CornerHeights.push_back(height(corner));
    }
  }
  return static_cast<std::uint32_t>(this->Occluders.size() - 1);
}

/// The segments from the points to the lamp meet the plane of the occluder within the convex hull
/// of those between corners, so these decide.
bool LampCutter::HidesAll(std::uint32_t occluder, const Polygon& points) const
{
  Shadow shadow;
  return std::all_of(points.begin(), points.end(),
    [&](const Vec3& x)
    { return this->Cast(this->Occluders[occluder], x, shadow) == Cover::Whole; });
}

std::optional<double> LampCutter::Seen(
  const Vec2& x, const std::vector<Suspect>& suspects, Shadows& shadows) const
{
  shadows.All.clear();
  Shadow shadow;
  for (const Suspect& suspect : suspects)
  {
    const Occluder& occluder = this->Occluders[suspect.occluder];
    const Cover cover = this->Cast(occluder, x, shadow);
    if (cover == Cover::Whole)
    {
      shadows.All.clear();
      return 0.0;
    }
    if (cover == Cover::Part && !(suspect.isSeenFromOutside && IsInside(occluder, x)))
    {
      shadows.All.push_back(shadow);
    }
  }
  return shadows.All.empty() ? this->Kernel.At(x) : this->SeenPast(shadows, x);
}

/// Whether the side that x sees is the inside of a body.
bool LampCutter::IsInside(const Occluder& occluder, const Vec2& x)
{
  return occluder.inside == (occluder.side.At(x) > 0.0 ? Side::Front : Side::Back);
}

/// How much of the lamp is inside of an edge as x sees it. \param sign of the side of the occluder
/// that x is on
LampCutter::Cover LampCutter::CoverBehind(std::uint32_t edge, double sign, const Vec2& x) const
{
  const Affine* height = &this->CornerHeights[edge * this->Lamp.count];
  bool anyInside = false;
  bool anyOutside = false;
  for (int k = 0; k < this->Lamp.count; ++k)
  {
    const double d = sign * height[k].At(x);
    anyInside = anyInside || d > 0.0;
    anyOutside = anyOutside || d < 0.0;
  }
  return anyInside ? (anyOutside ? Cover::Part : Cover::Whole) : Cover::None;
}

/// The cone from x through the occluder, as lines in the plane of the lamp.
LampCutter::Cover LampCutter::Cast(const Occluder& occluder, const Vec2& x, Shadow& shadow) const
{
  shadow.count = 0;
  const double side = occluder.side.At(x);
  if (side == 0.0)
  {
    return Cover::None; // seen edge-on
  }
  const double sign = side < 0.0 ? -1.0 : 1.0;
  for (std::uint32_t e = occluder.firstEdge; e < occluder.lastEdge; ++e)
  {
    const Cover cover = this->CoverBehind(e, sign, x);
    if (cover == Cover::None)
    {
      return Cover::None;
    }
    if (cover == Cover::Part)
    {
      const Edge& edge = this->Edges[e];
      shadow.sides[shadow.count++] = { { sign * edge.towardsA.At(x), sign * edge.towardsB.At(x) },
        sign * edge.height.At(x) };
    }
  }
  return shadow.count == 0 ? Cover::Whole : Cover::Part;
}

/// The side of the occluder that all points are on: 1 or -1, or 0 when they are not on one side.
double LampCutter::CommonSide(const Occluder& occluder, const Polygon& points) const
{
  bool anyAbove = false;
  bool anyBelow = false;
  for (const Vec3& x : points)
  {
    const double side = occluder.side.At(x);
    anyAbove = anyAbove || side >= 0.0;
    anyBelow = anyBelow || side <= 0.0;
  }
  return anyAbove == anyBelow ? 0.0 : (anyAbove ? 1.0 : -1.0);
}

bool LampCutter::IsSharp(std::uint32_t index, const Polygon& points) const
{
  const Occluder& occluder = this->Occluders[index];
  const double side = this->CommonSide(occluder, points);
  if (side == 0.0)
  {
    return true;
  }
  for (std::uint32_t e = occluder.firstEdge; e < occluder.lastEdge; ++e)
  {
    bool anyNone = false;
    bool anyWhole = false;
    for (const Vec3& x : points)
    {
      const Cover cover = this->CoverBehind(e, side, x);
      anyNone = anyNone || cover == Cover::None;
      anyWhole = anyWhole || cover == Cover::Whole;
    }
    if (anyNone && anyWhole)
    {
      return true;
    }
  }
  return false;
}

/// The part on one side of a line, by the heights of the corners above it: `side` is 1 or -1. There
/// are corners on either side.
void LampCutter::CutAt(const Flat& whole, const Heights& heights, double side, Flat& cut)
{
  cut.count = 0;
  int last = whole.count - 1;
  for (int k = 0; k < whole.count; last = k++)
  {
    const bool isIn = side * heights[k] > 0.0;
    if (isIn != (side * heights[last] > 0.0) && cut.count < MostCorners)
    {
      const double t = heights[last] / (heights[last] - heights[k]);
      cut.corners[cut.count++] = whole.corners[last] + t * (whole.corners[k] - whole.corners[last]);
    }
    if (isIn && cut.count < MostCorners)
    {
      cut.corners[cut.count++] = whole.corners[k];
    }
  }
}

double LampCutter::Area(const Flat& part)
{
  double twice = 0.0;
  for (int k = 2; k < part.count; ++k)
  {
    const Vec2 u = part.corners[k - 1] - part.corners[0];
    const Vec2 v = part.corners[k] - part.corners[0];
    twice += u.x * v.y - u.y * v.x;
  }
  return 0.5 * std::abs(twice);
}

/// What a shadow leaves of a part: all of it, or nothing, or what is outside of each side in turn.
void LampCutter::AppendOutside(
  const Flat& part, const Shadow& shadow, std::vector<Flat>& parts) const
{
  const std::size_t before = parts.size();
  std::array<Flat, 2> room;
  const Flat* rest = &part; // what is inside of the sides so far
  for (int s = 0; s < shadow.count; ++s)
  {
    const Line& line = shadow.sides[s];
    Heights heights;
    int inside = 0;
    for (int k = 0; k < rest->count; ++k)
    {
      heights[k] = glm::dot(line.normal, rest->corners[k]) + line.offset;
      inside += heights[k] > 0.0 ? 1 : 0;
    }
    if (inside == rest->count)
    {
      continue;
    }
    if (inside == 0) // none of the part is in the shadow
    {
      parts.resize(before);
      parts.push_back(part);
      return;
    }
    parts.emplace_back();
    CutAt(*rest, heights, -1.0, parts.back());
    if (Area(parts.back()) <= this->Sliver)
    {
      parts.pop_back();
    }
    Flat& next = room[rest == &room[0] ? 1 : 0];
    CutAt(*rest, heights, 1.0, next);
    rest = &next;
  }
}

void LampCutter::Cut(Shadows& shadows, const Shadow& shadow) const
{
  shadows.Rest.clear();
  for (const Flat& part : shadows.Parts)
  {
    this->AppendOutside(part, shadow, shadows.Rest);
  }
  shadows.Parts.swap(shadows.Rest);
}

/// Shadows of few sides first: these hide most, and leave few parts to the others.
std::optional<double> LampCutter::SeenPast(Shadows& shadows, const Vec2& x) const
{
  std::size_t effort = 0;
  shadows.Parts.assign(1, this->Lamp);
  for (int sides = 1; sides <= MostCorners; ++sides)
  {
    for (const Shadow& shadow : shadows.All)
    {
      if (shadow.count == sides)
      {
        effort += shadows.Parts.size();
        this->Cut(shadows, shadow);
      }
      if (effort > MostEffort)
      {
        shadows.TooMany = true;
        return std::nullopt;
      }
    }
  }
  double seen = 0.0;
  for (const Flat& part : shadows.Parts)
  {
    seen += this->Measure(part, x);
  }
  return seen;
}

double LampCutter::Measure(const Flat& part, const Vec2& x) const
{
  Polygon shape;
  for (int i = 0; i < part.count; ++i)
  {
    shape.Add(this->Origin + part.corners[i].x * this->A + part.corners[i].y * this->B);
  }
  return LampKernel(shape).At(x);
}

} // namespace vantage
