#include "core/view/FaceParts.h"

#include "core/view/LampKernel.h"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace vantage
{

namespace
{

/// Of a face: what rounding leaves between shadows of neighbours.
constexpr double LargestSliver = 1e-12;

} // namespace

FaceParts::Face::Face(const Polygon& shape, const Plane& plane)
{
  const Vec3 steep = glm::abs(plane.normal);
  this->W = steep.x >= std::max(steep.y, steep.z) ? 0 : (steep.y >= steep.z ? 1 : 2);
  this->U = (this->W + 1) % 3;
  this->V = (this->W + 2) % 3;
  const double perW = 1.0 / plane.normal[this->W];
  this->PerU = -plane.normal[this->U] * perW;
  this->PerV = -plane.normal[this->V] * perW;
  this->Constant = plane.offset * perW;
  for (const Vec3& corner : shape)
  {
    this->Corners[this->Count++] = { corner[this->U], corner[this->V] };
  }
  this->Sliver = LargestSliver * Area(this->Corners.data(), this->Count);
}

void FaceParts::Start(const Face& face)
{
  this->Whole = &face;
  this->Parts.assign(1, { face.Corners, face.Count });
}

void FaceParts::Take(const LampSurface::HalfSpace* sides, int count)
{
  const Shadow shadow = this->OnFace(sides, count);
  this->Rest.clear();
  for (const Part& part : this->Parts)
  {
    this->AppendOutside(part, shadow);
  }
  this->Parts.swap(this->Rest);
}

FaceParts::Shadow FaceParts::OnFace(const LampSurface::HalfSpace* sides, int count) const
{
  const Face& face = *this->Whole;
  Shadow shadow;
  assert(count <= static_cast<int>(shadow.sides.size()));
  for (; shadow.count < count; ++shadow.count)
  {
    const auto& [normal, offset] = sides[shadow.count];
    const double ofW = normal[face.W];
    shadow.sides[shadow.count] = { { normal[face.U] + ofW * face.PerU,
                                     normal[face.V] + ofW * face.PerV },
      offset + ofW * face.Constant };
  }
  return shadow;
}

/// The part on one side of a line, by the heights of the corners above it: `side` is 1 or -1. There
/// are corners on either side.
void FaceParts::CutAt(const Part& whole, const Heights& heights, double side, Part& cut)
{
  cut.count = 0;
  int last = whole.count - 1;
  for (int k = 0; k < whole.count; last = k++)
  {
    const bool isIn = side * heights[k] > 0.0;
    if (isIn != (side * heights[last] > 0.0) && cut.count < Polygon::Capacity)
    {
      const double t = heights[last] / (heights[last] - heights[k]);
      cut.corners[cut.count++] = whole.corners[last] + t * (whole.corners[k] - whole.corners[last]);
    }
    if (isIn && cut.count < Polygon::Capacity)
    {
      cut.corners[cut.count++] = whole.corners[k];
    }
  }
}

double FaceParts::Area(const Vec2* corners, int count)
{
  double twice = 0.0;
  for (int k = 2; k < count; ++k)
  {
    const Vec2 u = corners[k - 1] - corners[0];
    const Vec2 v = corners[k] - corners[0];
    twice += u.x * v.y - u.y * v.x;
  }
  return 0.5 * std::abs(twice);
}

/// What a shadow leaves of a part: all of it, or nothing, or what is outside of each side in turn.
void FaceParts::AppendOutside(const Part& part, const Shadow& shadow)
{
  const std::size_t before = this->Rest.size();
  std::array<Part, 2> room;
  const Part* rest = &part; // what is inside of the sides so far
  for (int s = 0; s < shadow.count; ++s)
  {
    const Shadow::Side& side = shadow.sides[s];
    Heights heights;
    int inside = 0;
    for (int k = 0; k < rest->count; ++k)
    {
      heights[k] = glm::dot(side.normal, rest->corners[k]) + side.offset;
      inside += heights[k] > 0.0 ? 1 : 0;
    }
    if (inside == rest->count)
    {
      continue;
    }
    if (inside == 0) // none of the part is in the shadow
    {
      this->Rest.resize(before);
      this->Rest.push_back(part);
      return;
    }
    this->Rest.emplace_back();
    Part& outside = this->Rest.back();
    CutAt(*rest, heights, -1.0, outside);
    if (Area(outside.corners.data(), outside.count) <= this->Whole->Sliver)
    {
      this->Rest.pop_back();
    }
    Part& next = room[rest == &room[0] ? 1 : 0];
    CutAt(*rest, heights, 1.0, next);
    rest = &next;
  }
}

double FaceParts::At(const Vec2& x) const
{
  const Face& face = *this->Whole;
  double sum = 0.0;
  for (const Part& part : this->Parts)
  {
    Polygon shape;
    for (int i = 0; i < part.count; ++i)
    {
      const Vec2& corner = part.corners[i];
      Vec3 place;
      place[face.U] = corner.x;
      place[face.V] = corner.y;
      place[face.W] = face.Constant + face.PerU * corner.x + face.PerV * corner.y;
      shape.Add(place);
    }
    sum += LampKernel(shape).At(x);
  }
  return sum;
}

} // namespace vantage
