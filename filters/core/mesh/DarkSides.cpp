#include "core/mesh/DarkSides.h"

#include "core/math/PointInPolygon.h"
#include "core/mesh/PackedLists.h"
#include "core/mesh/Shells.h"

#include <algorithm>
#include <cmath>

namespace vantage
{

namespace
{

using Shell = PackedLists<PatchId>::List;

/// Volume of a shell that encloses air, over the sum of its parts without their signs, at least.
/// That of a sheet, which has both its sides, is next to zero.
constexpr double LeastVolume = 1e-9;
/// Times that a shell winds around what is outside of it at most, and around its own sides at
/// least: both are whole numbers.
constexpr double OutsideWinding = 0.25;
constexpr double InsideWinding = 0.75;
/// Sides of a shell that are looked at.
constexpr std::ptrdiff_t SidesToTell = 8;
/// Solid angles that are taken to find out whether lamps around a shell are outside of it: a
/// second.
constexpr std::ptrdiff_t MostWork = 20'000'000;

double SignOf(PatchId patch)
{
  return patch % 2 == 0 ? 1.0 : -1.0;
}

Bounds BoundsOf(PolygonView shape)
{
  Bounds bounds;
  for (const Vec3& corner : shape)
  {
    bounds.Add(corner);
  }
  return bounds;
}

/// Solid angle of a convex polygon, positive for who sees its front (Van Oosterom, Strackee 1983).
double SolidAngle(PolygonView shape, const Vec3& eye)
{
  double sum = 0.0;
  const Vec3 a = shape[0] - eye;
  for (int i = 1; i + 1 < shape.Size(); ++i)
  {
    const Vec3 b = shape[i] - eye;
    const Vec3 c = shape[i + 1] - eye;
    const double la = glm::length(a);
    const double lb = glm::length(b);
    const double lc = glm::length(c);
    sum += 2.0 * std::atan2(-glm::dot(a, glm::cross(b, c)),
                   la * lb * lc + glm::dot(a, b) * lc + glm::dot(b, c) * la + glm::dot(c, a) * lb);
  }
  return sum;
}

/// Whether an edge passes through the other one, from one side of its plane to the other.
bool PassesThrough(PolygonView shape, PolygonView other, double tolerance)
{
  const Vec3 normal = UnitNormal(other);
  for (int i = 0; i < shape.Size(); ++i)
  {
    const Vec3& from = shape[i];
    const Vec3& to = shape[(i + 1) % shape.Size()];
    const double before = glm::dot(normal, from - other[0]);
    const double after = glm::dot(normal, to - other[0]);
    const bool isThrough =
      std::min(before, after) < -tolerance && std::max(before, after) > tolerance;
    if (isThrough && Contains(other, normal, from + before / (before - after) * (to - from)))
    {
      return true;
    }
  }
  return false;
}

/// The lamps of a scene, to be found by where they are.
class LampFinder
{
public:
  LampFinder(const FacetSet& facets, const std::vector<Material>& materials)
    : IsLamp(2 * facets.facets.size(), false)
  {
    for (PatchId id = 0; id < this->IsLamp.size(); ++id)
    {
      const Facet& facet = facets.facets[id / 2];
      const Side side = SideOf(id);
      if (facet.IsPolygonFront(side) && MaxChannel(materials[facet.MaterialOf(side)].emission) > 0)
      {
        this->IsLamp[id] = true;
        this->Lamps.push_back({ id, BoundsOf(facet.shape) });
        this->Widest = std::max(this->Widest, this->Lamps.back().bounds.Extent().x);
      }
    }
    std::sort(this->Lamps.begin(), this->Lamps.end(),
      [](const Lamp& a, const Lamp& b) { return a.bounds.Low().x < b.bounds.Low().x; });
  }

  bool Empty() const { return this->Lamps.empty(); }
  bool Has(PatchId patch) const { return this->IsLamp[patch]; }

  /// Whether `isFound` says so of any lamp whose box meets the bounds.
  template <typename IsFound>
  bool AnyIn(const Bounds& bounds, const IsFound& isFound) const
  {
    auto lamp = std::lower_bound(this->Lamps.begin(), this->Lamps.end(),
      bounds.Low().x - this->Widest, [](const Lamp& a, double x) { return a.bounds.Low().x < x; });
    for (; lamp != this->Lamps.end() && lamp->bounds.Low().x <= bounds.High().x; ++lamp)
    {
      if (lamp->bounds.Meets(bounds) && isFound(lamp->patch))
      {
        return true;
      }
    }
    return false;
  }

private:
  struct Lamp
  {
    PatchId patch;
    Bounds bounds;
  };

  std::vector<bool> IsLamp; ///< of each patch
  std::vector<Lamp> Lamps;  ///< by the least x
  double Widest = 0.0;      ///< extent along x
};

class DarknessFinder
{
public:
  DarknessFinder(const FacetSet& facets, const std::vector<Material>& materials)
    : Facets(facets.facets)
    , Tolerance(facets.Tolerance())
    , Lamps(facets, materials)
  {
  }

  bool HasLamps() const { return !this->Lamps.Empty(); }

  bool IsDark(const Shell& shell) const
  {
    return std::none_of(
             shell.begin(), shell.end(), [&](PatchId p) { return this->Lamps.Has(p); }) &&
           this->EnclosesAir(shell) && !this->MayHaveLamps(shell) && this->IsOneSpace(shell);
  }

  Bounds BoundsOfShell(const Shell& shell) const
  {
    Bounds bounds;
    for (const PatchId patch : shell)
    {
      bounds.Add(BoundsOf(this->Shape(patch)));
    }
    return bounds;
  }

private:
  PolygonView Shape(PatchId patch) const { return this->Facets[patch / 2].shape; }

  /// Its volume is negative: the sides look inwards.
  bool EnclosesAir(const Shell& shell) const
  {
    const Vec3 origin = this->Shape(*shell.begin())[0];
    double volume = 0.0;
    double unsignedVolume = 0.0;
    for (const PatchId patch : shell)
    {
      const PolygonView shape = this->Shape(patch);
      const double part = SignOf(patch) * glm::dot(shape[0] - origin, AreaNormal(shape));
      volume += part;
      unsignedVolume += std::abs(part);
    }
    return volume < -LeastVolume * unsignedVolume;
  }

  /// How many times the shell winds around the air in front of a patch.
  double Winding(const Shell& shell, PatchId patch) const
  {
    const Vec3 point = Centroid(this->Shape(patch));
    double sum = 0.0;
    for (const PatchId side : shell)
    {
      const bool isSameFacet = side / 2 == patch / 2;
      const double inFront = side == patch ? 2.0 * Pi : -2.0 * Pi;
      sum += isSameFacet ? inFront : SignOf(side) * SolidAngle(this->Shape(side), point);
    }
    return sum / (4.0 * Pi);
  }

  /// Where that is too much to find out, it may.
  bool MayHaveLamps(const Shell& shell) const
  {
    std::ptrdiff_t work = 0;
    return this->Lamps.AnyIn(this->BoundsOfShell(shell),
      [&](PatchId lamp)
      {
        work += shell.end() - shell.begin();
        return work > MostWork || this->MayLight(lamp, shell);
      });
  }

  bool MayLight(PatchId lamp, const Shell& shell) const
  {
    const PolygonView shape = this->Shape(lamp);
    const Bounds bounds = BoundsOf(shape);
    const auto isCrossed = [&](PatchId side)
    {
      const PolygonView other = this->Shape(side);
      return BoundsOf(other).Meets(bounds) && (PassesThrough(shape, other, this->Tolerance) ||
                                                PassesThrough(other, shape, this->Tolerance));
    };
    return std::abs(this->Winding(shell, lamp)) > OutsideWinding ||
           std::any_of(shell.begin(), shell.end(), isCrossed);
  }

  bool IsOneSpace(const Shell& shell) const
  {
    const std::ptrdiff_t size = shell.end() - shell.begin();
    const std::ptrdiff_t count = std::min(size, SidesToTell);
    for (std::ptrdiff_t i = 0; i < count; ++i)
    {
      if (this->Winding(shell, shell.begin()[i * size / count]) < InsideWinding)
      {
        return false;
      }
    }
    return true;
  }

  const std::vector<Facet>& Facets;
  double Tolerance;
  LampFinder Lamps;
};

} // namespace

DarkSides FindDarkSides(const FacetSet& facets, const std::vector<Material>& materials)
{
  DarkSides dark{ std::vector<std::uint32_t>(2 * facets.facets.size(), None), {} };
  const DarknessFinder finder(facets, materials);
  if (!finder.HasLamps())
  {
    return dark;
  }
  const std::vector<PatchId> shellOf = ShellsOf(facets, EdgesOf(facets.facets));
  const PackedLists<PatchId> shells(shellOf.size(),
    [&](const auto& visit)
    {
      for (PatchId patch = 0; patch < shellOf.size(); ++patch)
      {
        visit(shellOf[patch], patch);
      }
    });
  for (PatchId first = 0; first < shellOf.size(); ++first)
  {
    if (shellOf[first] != first)
    {
      continue;
    }
    const Shell shell = shells.Of(first);
    if (finder.IsDark(shell))
    {
      for (const PatchId patch : shell)
      {
        dark.bodyOf[patch] = static_cast<std::uint32_t>(dark.bodies.size());
      }
      dark.bodies.push_back(finder.BoundsOfShell(shell));
    }
  }
  return dark;
}

} // namespace vantage
