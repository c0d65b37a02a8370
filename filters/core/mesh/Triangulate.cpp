#include "core/mesh/Triangulate.h"

#include <algorithm>
#include <limits>
#include <numeric>

namespace vantage
{

namespace
{

/// Twice the area of the triangle a b c, positive when counter-clockwise.
double Cross(const Vec2& a, const Vec2& b, const Vec2& c)
{
  return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

double SquaredLength(const Vec2& v)
{
  return glm::dot(v, v);
}

constexpr double NoEar = -std::numeric_limits<double>::infinity();

/// The corners that are left, as a ring, and how good an ear each of them is.
class Ring
{
public:
  explicit Ring(const std::vector<Vec2>& corners)
    : Corners(corners)
    , Previous(corners.size())
    , Next(corners.size())
    , Qualities(corners.size())
    , Left(static_cast<int>(corners.size()))
  {
    for (int i = 0; i < this->Left; ++i)
    {
      this->Previous[i] = (i + this->Left - 1) % this->Left;
      this->Next[i] = (i + 1) % this->Left;
    }
    this->RateAll();
  }

  int Size() const { return this->Left; }

  /// The corner to cut off next. A ring without an ear is no simple polygon: there the most convex
  /// corner goes, so that there always is an end.
  int BestEar()
  {
    int best = this->Best();
    if (this->Qualities[best] == NoEar)
    {
      // Ears that were blocked by a corner that is gone by now are only found here.
      this->RateAll();
      best = this->Best();
    }
    return this->Qualities[best] == NoEar ? this->MostConvex() : best;
  }

  std::array<int, 3> Triangle(int i) const { return { this->Previous[i], i, this->Next[i] }; }

  void CutOff(int i)
  {
    const int before = this->Previous[i];
    const int after = this->Next[i];
    this->Next[before] = after;
    this->Previous[after] = before;
    this->First = before;
    --this->Left;
    this->Qualities[before] = this->Quality(before);
    this->Qualities[after] = this->Quality(after);
  }

private:
  template <typename Visit>
  void ForEach(const Visit& visit) const
  {
    int i = this->First;
    for (int k = 0; k < this->Left; ++k, i = this->Next[i])
    {
      visit(i);
    }
  }

  void RateAll()
  {
    this->ForEach([this](int i) { this->Qualities[i] = this->Quality(i); });
  }

  /// The best rated corner, the first of the polygon among equals.
  int Best() const
  {
    int best = this->First;
    this->ForEach(
      [&](int i)
      {
        if (this->Qualities[i] > this->Qualities[best] ||
            (this->Qualities[i] == this->Qualities[best] && i < best))
        {
          best = i;
        }
      });
    return best;
  }

  int MostConvex() const
  {
    int best = this->First;
    this->ForEach([&](int i) { best = this->Shape(i) > this->Shape(best) ? i : best; });
    return best;
  }

  /// Height over the longest edge relative to that edge, below zero at a reflex corner.
  double Shape(int i) const
  {
    const auto [a, b, c] = this->Triangle(i);
    const Vec2& p = this->Corners[a];
    const Vec2& q = this->Corners[b];
    const Vec2& r = this->Corners[c];
    const double longest =
      std::max({ SquaredLength(q - p), SquaredLength(r - q), SquaredLength(p - r) });
    return longest > 0.0 ? Cross(p, q, r) / longest : 0.0;
  }

  double Quality(int i) const
  {
    const double shape = this->Shape(i);
    return shape > 0.0 && !this->IsBlocked(i) ? shape : NoEar;
  }

  /// Whether another corner lies in the ear. Corners in the same place as one of the ear's own, as
  /// at a bridge to a hole, do not count.
  bool IsBlocked(int i) const
  {
    const auto [a, b, c] = this->Triangle(i);
    const Vec2& p = this->Corners[a];
    const Vec2& q = this->Corners[b];
    const Vec2& r = this->Corners[c];
    bool isBlocked = false;
    this->ForEach(
      [&](int k)
      {
        const Vec2& x = this->Corners[k];
        isBlocked = isBlocked || (x != p && x != q && x != r && Cross(p, q, x) >= 0.0 &&
                                   Cross(q, r, x) >= 0.0 && Cross(r, p, x) >= 0.0);
      });
    return isBlocked;
  }

  const std::vector<Vec2>& Corners;
  std::vector<int> Previous;
  std::vector<int> Next;
  std::vector<double> Qualities;
  int First = 0;
  int Left;
};

} // namespace

std::vector<std::array<int, 3>> Triangulate(const std::vector<Vec2>& corners)
{
  std::vector<std::array<int, 3>> triangles;
  Ring ring(corners);
  while (ring.Size() >= 3)
  {
    const int ear = ring.BestEar();
    const std::array<int, 3> triangle = ring.Triangle(ear);
    if (Cross(corners[triangle[0]], corners[triangle[1]], corners[triangle[2]]) > 0.0)
    {
      triangles.push_back(triangle);
    }
    ring.CutOff(ear);
  }
  return triangles;
}

} // namespace vantage
