#include "core/formfactor/Shadows.h"

#include "core/formfactor/FormFactor.h"
#include "core/formfactor/Subdivision.h"

#include <algorithm>
#include <cmath>

namespace vantage
{
namespace
{

// An occluder whose plane passes the eye nearer than this, in units of the scene, is seen edge-on
// and hides nothing.
constexpr double EdgeOn = 1e-13;

/// The half-spaces whose intersection is the cone from x through an occluder.
struct ShadowCone
{
  std::array<Plane, MaxOccluderVertices + 1> sides;
  int count = 0;
};

/// Without sides when the occluder is seen edge-on.
ShadowCone ConeThrough(const Vec3& x, const Polygon& occluder)
{
  ShadowCone cone;
  const Vec3 normal = AreaNormal(occluder);
  const double height = glm::dot(normal, x - occluder[0]);
  if (std::abs(height) <= EdgeOn * glm::length(normal))
  {
    return cone;
  }
  for (int i = 0; i < occluder.Size(); ++i)
  {
    const Vec3 along = occluder[(i + 1) % occluder.Size()] - occluder[i];
    const Vec3 across = glm::cross(along, occluder[i] - x);
    const double length = std::copysign(glm::length(across), height);
    if (length != 0.0)
    {
      const Vec3 inward = across / length;
      cone.sides[cone.count++] = { inward, glm::dot(inward, x) };
    }
  }
  return cone;
}

bool Overlap(const Polygon& p, const ShadowCone& cone)
{
  for (int i = 0; i < cone.count; ++i)
  {
    const Plane& side = cone.sides[i];
    if (std::none_of(p.begin(), p.end(), [&](const Vec3& v) { return side.Distance(v) > 0.0; }))
    {
      return false;
    }
  }
  Polygon inside = p;
  for (int i = 0; i < cone.count && !inside.Empty(); ++i)
  {
    inside = ClipToFront(inside, cone.sides[i]);
  }
  return !inside.Empty();
}

/// What one point sees. The pieces are made, measured and dropped one after the other.
class View
{
public:
  View(const Vec3& x, const Vec3& n)
    : X(x)
    , Normal(n)
  {
  }

  void AddOccluder(const Polygon& occluder)
  {
    const ShadowCone cone = ConeThrough(this->X, occluder);
    if (cone.count > 0)
    {
      this->Cones.push_back(cone);
    }
  }

  double Seen(const Polygon& p) const { return this->Seen(p, 0); }

private:
  /// The part of the piece outside the cones from `first` on: outside the first side, inside that
  /// but outside the second, and so forth.
  double Seen(const Polygon& piece, std::size_t first) const
  {
    if (piece.Empty())
    {
      return 0.0;
    }
    if (first == this->Cones.size())
    {
      return PointToPolygon(this->X, this->Normal, piece);
    }
    const ShadowCone& cone = this->Cones[first];
    if (piece.Size() + cone.count > Polygon::Capacity)
    {
      // Clipping adds vertices, and a polygon has room for a few only.
      const std::array<Polygon, 2> halves = InHalves(piece);
      return this->Seen(halves[0], first) + this->Seen(halves[1], first);
    }
    if (first + 1 < this->Cones.size() && !Overlap(piece, cone))
    {
      // Cutting it along the sides would only make more pieces for the next cones to cut.
      return this->Seen(piece, first + 1);
    }
    double seen = 0.0;
    Polygon rest = piece;
    for (int i = 0; i < cone.count && !rest.Empty(); ++i)
    {
      const Plane& side = cone.sides[i];
      seen += this->Seen(ClipToFront(rest, { -side.normal, -side.offset }), first + 1);
      rest = ClipToFront(rest, side);
    }
    return seen;
  }

  Vec3 X, Normal;
  std::vector<ShadowCone> Cones;
};

} // namespace

double PointToVisiblePolygon(
  const Vec3& x, const Vec3& n, const Polygon& p, const std::vector<Polygon>& occluders)
{
  View view(x, n);
  // What is farther from the plane of p than x is behind x for all rays to p.
  const Vec3 toP = -UnitNormal(p);
  const Plane ahead{ toP, glm::dot(toP, x) };
  for (const Polygon& occluder : occluders)
  {
    const Polygon between = ClipToFront(occluder, ahead);
    if (!between.Empty())
    {
      view.AddOccluder(between);
    }
  }
  return view.Seen(p);
}

} // namespace vantage
