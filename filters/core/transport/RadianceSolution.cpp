#include "core/transport/RadianceSolution.h"

#include <algorithm>
#include <cmath>

namespace vantage
{

namespace
{

/// Relative twist below which a quadrilateral is a parallelogram: its coordinates are off by no
/// more than that.
constexpr double NoTwist = 1e-9;

/// ToQuarter() of (s, t) on a quadrilateral.
std::uint32_t ToQuarterOfQuadrilateral(Vec2& place)
{
  const bool right = place.x >= 0.5;
  const bool upper = place.y >= 0.5;
  place = 2.0 * place - Vec2(right ? 1.0 : 0.0, upper ? 1.0 : 0.0);
  return 2u * upper + (right != upper); // without a branch: it could not be foretold
}

/// The same of the barycentric coordinates of corners 1 and 2 of a triangle.
std::uint32_t ToQuarterOfTriangle(Vec2& place)
{
  if (place.x + place.y <= 0.5)
  {
    place *= 2.0;
    return 0;
  }
  if (place.x >= 0.5 || place.y >= 0.5)
  {
    const bool second = place.y > place.x;
    place = 2.0 * place - (second ? Vec2(0.0, 1.0) : Vec2(1.0, 0.0));
    return second ? 2 : 1;
  }
  place = 1.0 - 2.0 * place;
  return 3;
}

template <typename T>
std::size_t BytesOf(const std::vector<T>& values)
{
  return values.capacity() * sizeof(T);
}

} // namespace

PatchCoordinates::PatchCoordinates(const Polygon& shape)
  : Origin(shape[0])
  , Corners(static_cast<std::uint8_t>(shape.Size()))
{
  const Vec3 u = shape[1] - shape[0];
  const Vec3 v = shape[shape.Size() - 1] - shape[0];
  const Vec3 normal = glm::cross(u, v);
  const double square = glm::dot(normal, normal);
  this->DualU = glm::cross(v, normal) / square;
  this->DualV = glm::cross(normal, u) / square;
  if (shape.Size() == 4)
  {
    const Vec3 twist = shape[2] - shape[1] - v;
    this->Twist = Vec2(glm::dot(twist, this->DualU), glm::dot(twist, this->DualV));
    this->IsAffine = std::abs(this->Twist.x) + std::abs(this->Twist.y) <= NoTwist;
  }
}

/// With the twist k, the affine coordinates are p = s + k.x s t and q = t + k.y s t; without s it
/// is a quadratic equation for t, of which the root that stays finite when k vanishes is wanted.
Vec2 PatchCoordinates::Bilinear(const Vec2& affine) const
{
  const Vec2& k = this->Twist;
  const double b = 1.0 + k.y * affine.x - k.x * affine.y;
  const double root = std::sqrt(std::max(b * b + 4.0 * k.x * affine.y, 0.0));
  const double denominator = b + root;
  const double t = denominator != 0.0 ? 2.0 * affine.y / denominator : affine.y;
  const double slope = 1.0 + k.x * t;
  return { slope != 0.0 ? affine.x / slope : affine.x, t };
}

std::uint32_t ToQuarter(bool isTriangle, Vec2& place)
{
  return isTriangle ? ToQuarterOfTriangle(place) : ToQuarterOfQuadrilateral(place);
}

void RadianceSolution::SetPatches(const std::vector<PatchOptics>& optics)
{
  this->elementOfPatch.assign(optics.size(), None);
  this->coordinatesOfPatch.assign(optics.size(), None);
  this->emission.reserve(optics.size());
  this->albedo.reserve(optics.size());
  for (const PatchOptics& patch : optics)
  {
    this->emission.push_back(patch.emission);
    this->albedo.push_back(patch.albedo);
  }
}

void RadianceSolution::StartAt(PatchId patch, const Polygon& shape, NodeIndex element)
{
  this->elementOfPatch[patch] = element;
  if (this->elements[element].childCount != 0)
  {
    this->coordinatesOfPatch[patch] = static_cast<std::uint32_t>(this->coordinates.size());
    this->coordinates.emplace_back(shape);
  }
}

RadianceSolution::NodeIndex RadianceSolution::LeafAt(PatchId patch, const Vec3& point) const
{
  NodeIndex index = this->elementOfPatch[patch];
  const Element* element = &this->elements[index];
  if (element->childCount == 0)
  {
    return index;
  }
  const PatchCoordinates& map = this->coordinates[this->coordinatesOfPatch[patch]];
  Vec2 place = map.Of(point);
  while (element->childCount != 0)
  {
    index = element->firstChild + ToQuarter(map.IsTriangle(), place);
    element = &this->elements[index];
  }
  return index;
}

std::size_t RadianceSolution::Bytes() const
{
  return BytesOf(this->elements) + BytesOf(this->elementOfPatch) + BytesOf(this->coordinates) +
         BytesOf(this->coordinatesOfPatch) + BytesOf(this->lamps) + BytesOf(this->emission) +
         BytesOf(this->albedo);
}

} // namespace vantage
