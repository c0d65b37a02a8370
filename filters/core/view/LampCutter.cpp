#include "core/view/LampCutter.h"

#include "core/view/PatchFrame.h"

#include <algorithm>
#include <cmath>

namespace vantage
{

namespace
{

/// In clippings of a part by a shadow: what measuring and cutting a part costs, and two hundred
/// rays.
constexpr int EffortOfMeasure = 8;
constexpr int MostEffort = 2000;
/// Of the lamp: what rounding leaves between shadows of neighbours.
constexpr double LargestSliver = 1e-12;

} // namespace

LampCutter::LampCutter(const Polygon& lamp)
  : Kernel(lamp)
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

std::uint32_t LampCutter::AddOccluder(const Polygon& shape)
{
  Occluder occluder;
  occluder.normal = AreaNormal(shape);
  occluder.offset = glm::dot(occluder.normal, shape[0]);
  occluder.count = shape.Size();
  for (int i = 0; i < shape.Size(); ++i)
  {
    const Vec3 along = shape[(i + 1) % shape.Size()] - shape[i];
    occluder.edges[i] = { along, glm::cross(along, shape[i]) };
  }
  this->Occluders.push_back(occluder);
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
  const Vec2& x, const std::vector<std::uint32_t>& occluders, Shadows& shadows) const
{
  shadows.All.clear();
  const Vec3 point(x, 0.0);
  Shadow shadow;
  for (const std::uint32_t occluder : occluders)
  {
    const Cover cover = this->Cast(this->Occluders[occluder], point, shadow);
    if (cover == Cover::Whole)
    {
      shadows.All.clear();
      return 0.0;
    }
    if (cover == Cover::Part)
    {
      shadows.All.push_back(shadow);
    }
  }
  return this->SeenPast(shadows, x);
}

/// The cone from x through the occluder, as lines in the plane of the lamp.
LampCutter::Cover LampCutter::Cast(const Occluder& occluder, const Vec3& x, Shadow& shadow) const
{
  shadow.count = 0;
  const double side = glm::dot(occluder.normal, x) - occluder.offset;
  if (side == 0.0)
  {
    return Cover::None; // seen edge-on
  }
  const double sign = side < 0.0 ? -1.0 : 1.0;
  const Vec3 toLamp = this->Origin - x;
  for (int i = 0; i < occluder.count; ++i)
  {
    const Edge& edge = occluder.edges[i];
    const Vec3 inward = sign * (edge.moment - glm::cross(edge.along, x));
    const Line line{ { glm::dot(inward, this->A), glm::dot(inward, this->B) },
      glm::dot(inward, toLamp) };
    bool anyInside = false;
    bool anyOutside = false;
    for (int k = 0; k < this->Lamp.count; ++k)
    {
      const double d = glm::dot(line.normal, this->Lamp.corners[k]) + line.offset;
      anyInside = anyInside || d > 0.0;
      anyOutside = anyOutside || d < 0.0;
    }
    if (!anyInside)
    {
      return Cover::None;
    }
    if (anyOutside)
    {
      shadow.sides[shadow.count++] = line;
    }
  }
  return shadow.count == 0 ? Cover::Whole : Cover::Part;
}

/// The part of a convex polygon that lies in a shadow, and how much that is.
LampCutter::Cover LampCutter::Clip(const Flat& part, const Shadow& shadow, Flat& inside)
{
  const Flat* whole = &part;
  Flat spare;
  for (int s = 0; s < shadow.count; ++s)
  {
    const Line& line = shadow.sides[s];
    std::array<double, MostCorners> heights;
    int count = 0;
    for (int k = 0; k < whole->count; ++k)
    {
      heights[k] = glm::dot(line.normal, whole->corners[k]) + line.offset;
      count += heights[k] > 0.0 ? 1 : 0;
    }
    if (count == 0)
    {
      return Cover::None;
    }
    if (count == whole->count)
    {
      continue;
    }
    Flat& cut = whole == &inside ? spare : inside;
    CutAt(*whole, heights, cut);
    whole = &cut;
  }
  if (whole == &spare)
  {
    inside = spare;
  }
  return whole == &part ? Cover::Whole : Cover::Part;
}

/// The part where the heights of the corners above a line are positive: some are, some are not.
void LampCutter::CutAt(const Flat& whole, const std::array<double, MostCorners>& heights, Flat& cut)
{
  cut.count = 0;
  int last = whole.count - 1;
  for (int k = 0; k < whole.count; last = k++)
  {
    if ((heights[last] > 0.0) != (heights[k] > 0.0) && cut.count < MostCorners)
    {
      const double t = heights[last] / (heights[last] - heights[k]);
      cut.corners[cut.count++] = whole.corners[last] + t * (whole.corners[k] - whole.corners[last]);
    }
    if (heights[k] > 0.0 && cut.count < MostCorners)
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

/// What a shadow leaves of a part that it reaches into, in convex parts: one outside of each side.
void LampCutter::AppendOutside(
  const Flat& part, const Shadow& shadow, std::vector<Flat>& parts) const
{
  Flat rest = part;
  for (int s = 0; s < shadow.count; ++s)
  {
    const Line& line = shadow.sides[s];
    std::array<double, MostCorners> heights;
    std::array<double, MostCorners> depths;
    int inside = 0;
    for (int k = 0; k < rest.count; ++k)
    {
      heights[k] = glm::dot(line.normal, rest.corners[k]) + line.offset;
      depths[k] = -heights[k];
      inside += heights[k] > 0.0 ? 1 : 0;
    }
    if (inside == 0 || inside == rest.count)
    {
      continue; // this side does not cut it: all is inside, or outside by rounding alone
    }
    Flat outside;
    CutAt(rest, depths, outside);
    if (Area(outside) > this->Sliver)
    {
      parts.push_back(outside);
    }
    const Flat whole = rest;
    CutAt(whole, heights, rest);
  }
}

std::optional<double> LampCutter::SeenPast(Shadows& shadows, const Vec2& x) const
{
  double seen = this->Kernel.At(x);
  int effort = 0;
  shadows.Parts.assign(1, this->Lamp);
  for (const Shadow& shadow : shadows.All)
  {
    shadows.Rest.clear();
    for (const Flat& part : shadows.Parts)
    {
      Flat hidden;
      const Cover cover = Clip(part, shadow, hidden);
      if (cover == Cover::None)
      {
        shadows.Rest.push_back(part);
        continue;
      }
      seen -= this->Measure(cover == Cover::Whole ? part : hidden, x);
      effort += EffortOfMeasure;
      if (cover == Cover::Part)
      {
        this->AppendOutside(part, shadow, shadows.Rest);
      }
    }
    effort += static_cast<int>(shadows.Parts.size());
    shadows.Parts.swap(shadows.Rest);
    if (shadows.Parts.empty())
    {
      return 0.0;
    }
    if (effort > MostEffort)
    {
      return std::nullopt;
    }
  }
  return std::max(seen, 0.0);
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
