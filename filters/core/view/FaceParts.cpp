#include "core/view/FaceParts.h"

#include "core/view/LampKernel.h"

#include <algorithm>
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
  const int w = steep.x >= std::max(steep.y, steep.z) ? 0 : (steep.y >= steep.z ? 1 : 2);
  const int u = (w + 1) % 3;
  const int v = (w + 2) % 3;
  const double perW = 1.0 / plane.normal[w];
  Vec3 origin(0.0), alongU(0.0), alongV(0.0);
  origin[w] = plane.offset * perW;
  alongU[u] = 1.0;
  alongU[w] = -plane.normal[u] * perW;
  alongV[v] = 1.0;
  alongV[w] = -plane.normal[v] * perW;
  this->Start(origin, alongU, alongV);
  for (const Vec3& corner : shape)
  {
    this->Add({ corner[u], corner[v] });
  }
}

void FaceParts::Face::Start(const Vec3& origin, const Vec3& alongU, const Vec3& alongV)
{
  this->Origin = origin;
  this->AlongU = alongU;
  this->AlongV = alongV;
  this->Corners.clear();
}

void FaceParts::Start(const Face& face)
{
  this->Whole = &face;
  this->Parts.corners = face.Corners;
  this->Parts.parts.assign(1, { 0, face.Corners.size() });
  this->Sliver = LargestSliver * Area({ face.Corners.data(), face.Corners.size() });
}

void FaceParts::Take(const LampSurface::HalfSpace* sides, std::size_t count)
{
  const Face& face = *this->Whole;
  this->Sides.clear();
  for (std::size_t s = 0; s < count; ++s)
  {
    const Vec3& normal = sides[s].normal;
    this->Sides.push_back({ { glm::dot(normal, face.AlongU), glm::dot(normal, face.AlongV) },
      sides[s].Height(face.Origin) });
  }
  this->Rest.parts.clear();
  this->Rest.corners.clear();
  for (const Part& part : this->Parts.parts)
  {
    this->AppendOutside({ this->Parts.corners.data() + part.first, part.count });
  }
  std::swap(this->Parts, this->Rest);
}

/// Appends the part on one side of a line, by the heights of the corners above it: `side` is 1 or
/// -1. There are corners on either side.
void FaceParts::CutAt(const Span& whole, double side, std::vector<Vec2>& cut) const
{
  std::size_t last = whole.count - 1;
  for (std::size_t k = 0; k < whole.count; last = k++)
  {
    const double height = this->Heights[k];
    const double before = this->Heights[last];
    const bool isIn = side * height > 0.0;
    if (isIn != (side * before > 0.0))
    {
      const double t = before / (before - height);
      cut.push_back(whole.first[last] + t * (whole.first[k] - whole.first[last]));
    }
    if (isIn)
    {
      cut.push_back(whole.first[k]);
    }
  }
}

double FaceParts::Area(const Span& part)
{
  double twice = 0.0;
  for (std::size_t k = 2; k < part.count; ++k)
  {
    const Vec2 u = part.first[k - 1] - part.first[0];
    const Vec2 v = part.first[k] - part.first[0];
    twice += u.x * v.y - u.y * v.x;
  }
  return 0.5 * std::abs(twice);
}

/// Returns how many corners are inside.
std::size_t FaceParts::FindHeights(const Span& part, const Side& side)
{
  this->Heights.resize(part.count);
  std::size_t inside = 0;
  for (std::size_t k = 0; k < part.count; ++k)
  {
    this->Heights[k] = glm::dot(side.normal, part.first[k]) + side.offset;
    inside += this->Heights[k] > 0.0 ? 1 : 0;
  }
  return inside;
}

/// What a shadow leaves of a part: all of it, or nothing, or what is outside of each side in turn.
void FaceParts::AppendOutside(const Span& part)
{
  PartList& rest = this->Rest;
  const std::size_t partsBefore = rest.parts.size();
  const std::size_t cornersBefore = rest.corners.size();
  Span within = part; // of the sides so far
  int next = 0;
  for (const Side& side : this->Sides)
  {
    const std::size_t inside = this->FindHeights(within, side);
    if (inside == within.count)
    {
      continue;
    }
    if (inside == 0) // none of the part is in the shadow
    {
      rest.parts.resize(partsBefore);
      rest.corners.resize(cornersBefore);
      rest.parts.push_back({ cornersBefore, part.count });
      rest.corners.insert(rest.corners.end(), part.first, part.first + part.count);
      return;
    }
    const std::size_t first = rest.corners.size();
    this->CutAt(within, -1.0, rest.corners);
    const std::size_t count = rest.corners.size() - first;
    if (Area({ rest.corners.data() + first, count }) > this->Sliver)
    {
      rest.parts.push_back({ first, count });
    }
    else
    {
      rest.corners.resize(first);
    }
    std::vector<Vec2>& cut = this->Inside[next];
    next = 1 - next;
    cut.clear();
    this->CutAt(within, 1.0, cut);
    within = { cut.data(), cut.size() };
  }
}

double FaceParts::At(const Vec2& x)
{
  const Face& face = *this->Whole;
  const Vec3 origin = face.Origin - Vec3(x, 0.0);
  double sum = 0.0;
  for (const Part& part : this->Parts.parts)
  {
    this->Places.clear();
    this->Lengths.clear();
    for (std::size_t k = part.first; k < part.first + part.count; ++k)
    {
      const Vec2& corner = this->Parts.corners[k];
      this->Places.push_back(origin + corner.x * face.AlongU + corner.y * face.AlongV);
      this->Lengths.push_back(glm::length(this->Places.back()));
    }
    double ofPart = 0.0;
    std::size_t last = part.count - 1;
    for (std::size_t k = 0; k < part.count; last = k++)
    {
      const Vec3& from = this->Places[last];
      const Vec3 along = this->Places[k] - from;
      ofPart += LambertTerm(this->Lengths[last], this->Lengths[k], glm::dot(along, along),
        along.x * from.y - along.y * from.x);
    }
    sum += std::max(0.5 * ofPart, 0.0);
  }
  return std::min(sum, Pi);
}

} // namespace vantage
