#include "core/formfactor/SlowThroughput.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>

namespace vantage
{
namespace
{

using Real = long double;

struct Vector
{
  Real x, y, z;
};

Vector operator+(const Vector& a, const Vector& b)
{
  return { a.x + b.x, a.y + b.y, a.z + b.z };
}
Vector operator-(const Vector& a, const Vector& b)
{
  return { a.x - b.x, a.y - b.y, a.z - b.z };
}
Vector operator*(Real s, const Vector& a)
{
  return { s * a.x, s * a.y, s * a.z };
}
Real Dot(const Vector& a, const Vector& b)
{
  return a.x * b.x + a.y * b.y + a.z * b.z;
}
Vector Cross(const Vector& a, const Vector& b)
{
  return { a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x };
}
Real Length(const Vector& a)
{
  return std::sqrt(Dot(a, a));
}
Vector Unit(const Vector& a)
{
  const Real length = Length(a);
  return length > 0 ? (1 / length) * a : a;
}

using Vertices = std::vector<Vector>;

Vertices VerticesOf(const Polygon& p)
{
  Vertices vertices;
  for (const Vec3& v : p)
  {
    vertices.push_back({ v.x, v.y, v.z });
  }
  return vertices;
}

Vector NormalOf(const Vertices& p)
{
  return Unit(Cross(p[1] - p[0], p[2] - p[0]));
}

/// What is left in front of the plane through `point`.
Vertices InFront(const Vertices& p, const Vector& point, const Vector& normal)
{
  Vertices kept;
  for (std::size_t i = 0; i < p.size(); ++i)
  {
    const Vector& from = p[i];
    const Vector& to = p[(i + 1) % p.size()];
    const Real heightFrom = Dot(normal, from - point);
    const Real heightTo = Dot(normal, to - point);
    if (heightFrom >= 0)
    {
      kept.push_back(from);
    }
    if (heightFrom * heightTo < 0)
    {
      kept.push_back(from + (heightFrom / (heightFrom - heightTo)) * (to - from));
    }
  }
  return kept;
}

/// Lambert's formula with unit vectors; the angle between them as Kahan has it.
Real Irradiance(const Vector& x, const Vector& n, const Vertices& p)
{
  Real sum = 0;
  for (std::size_t i = 0; i < p.size(); ++i)
  {
    const Vector from = Unit(p[i] - x);
    const Vector to = Unit(p[(i + 1) % p.size()] - x);
    const Real angle = 2 * std::atan2(Length(to - from), Length(to + from));
    sum -= angle * Dot(n, Unit(Cross(from, to)));
  }
  return sum / 2;
}

/// Gauss-Legendre rule on [0, 1], by Newton's method on the Legendre polynomial.
struct Rule
{
  static constexpr int Count = 10;
  std::array<Real, Count> nodes, weights;

  Rule()
  {
    const Real pi = std::acos(Real(-1));
    for (int k = 0; k < Count; ++k)
    {
      Real x = std::cos(pi * (k + 0.75L) / (Count + 0.5L));
      Real slope = 0;
      for (int step = 0; step < 20; ++step)
      {
        Real before = 1;
        Real value = x;
        for (int n = 2; n <= Count; ++n)
        {
          const Real next = ((2 * n - 1) * x * value - (n - 1) * before) / n;
          before = value;
          value = next;
        }
        slope = Count * (before - x * value) / (1 - x * x);
        x -= value / slope;
      }
      this->nodes[k] = (1 + x) / 2;
      this->weights[k] = 1 / ((1 - x * x) * slope * slope);
    }
  }
};

using Function = std::function<Real(Real)>;

Real Gauss(const Function& f, Real from, Real to)
{
  static const Rule rule;
  Real sum = 0;
  for (int k = 0; k < Rule::Count; ++k)
  {
    sum += rule.weights[k] * f(from + rule.nodes[k] * (to - from));
  }
  return sum * (to - from);
}

Real Adaptive(const Function& f, Real from, Real to, Real whole, Real tolerance, int depth)
{
  const Real middle = (from + to) / 2;
  const Real left = Gauss(f, from, middle);
  const Real right = Gauss(f, middle, to);
  if (depth == 0 || std::abs(left + right - whole) <= tolerance)
  {
    return left + right;
  }
  return Adaptive(f, from, middle, left, tolerance, depth - 1) +
         Adaptive(f, middle, to, right, tolerance, depth - 1);
}

Real Integral(const Function& f, Real tolerance)
{
  constexpr int deepest = 30;
  return Adaptive(f, 0, 1, Gauss(f, 0, 1), tolerance, deepest);
}

} // namespace

double SlowThroughput(const Polygon& a, const Polygon& b, double tolerance)
{
  const Vector normalA = NormalOf(VerticesOf(a));
  const Vector normalB = NormalOf(VerticesOf(b));
  const Vertices pa = InFront(VerticesOf(a), VerticesOf(b)[0], normalB);
  const Vertices pb = InFront(VerticesOf(b), VerticesOf(a)[0], normalA);
  if (pa.size() < 3 || pb.size() < 3)
  {
    return 0.0;
  }
  Real sum = 0;
  for (std::size_t i = 1; i + 1 < pa.size(); ++i)
  {
    const Vector e = pa[i] - pa[0];
    const Vector f = pa[i + 1] - pa[i];
    const Real twiceArea = Length(Cross(e, f));
    if (twiceArea < 1e-18L)
    {
      continue; // left over by clipping at a vertex
    }
    // x = vertex + u (e + v f): lines through the first vertex. The inner error must be well below
    // the outer one, or the outer rule chases it.
    const Function overU = [&](Real u)
    {
      const Function overV = [&](Real v)
      { return u * Irradiance(pa[0] + u * (e + v * f), normalA, pb); };
      return Integral(overV, tolerance / 20);
    };
    sum += twiceArea * Integral(overU, tolerance);
  }
  return static_cast<double>(sum);
}

namespace
{

bool Blocks(const Polygon& occluder, const Vec3& from, const Vec3& to)
{
  const Vec3 n = AreaNormal(occluder);
  const double t = glm::dot(n, occluder[0] - from) / glm::dot(n, to - from);
  if (!(t > 0.0 && t < 1.0))
  {
    return false;
  }
  const Vec3 hit = from + t * (to - from);
  for (int i = 0; i < occluder.Size(); ++i)
  {
    const Vec3 along = occluder[(i + 1) % occluder.Size()] - occluder[i];
    if (glm::dot(glm::cross(along, hit - occluder[i]), n) < 0.0)
    {
      return false;
    }
  }
  return true;
}

struct Sample
{
  Vec3 point;
  double area;
};

std::vector<Sample> Grid(const Polygon& quad, int cells)
{
  std::vector<Sample> samples;
  for (int i = 0; i < cells; ++i)
  {
    for (int j = 0; j < cells; ++j)
    {
      const double u = (i + 0.5) / cells;
      const double v = (j + 0.5) / cells;
      const Vec3 du = (1.0 - v) * (quad[1] - quad[0]) + v * (quad[2] - quad[3]);
      const Vec3 dv = (1.0 - u) * (quad[3] - quad[0]) + u * (quad[2] - quad[1]);
      samples.push_back(
        { PointAt(quad, { u, v }), glm::length(glm::cross(du, dv)) / (cells * cells) });
    }
  }
  return samples;
}

} // namespace

double SlowVisibleThroughput(
  const Polygon& a, const Polygon& b, const std::vector<Polygon>& occluders, int cells)
{
  const Vec3 normalA = UnitNormal(a);
  const Vec3 normalB = UnitNormal(b);
  const std::vector<Sample> onB = Grid(b, cells);
  double sum = 0.0;
  for (const Sample& x : Grid(a, cells))
  {
    for (const Sample& y : onB)
    {
      const Vec3 d = y.point - x.point;
      const double r2 = glm::dot(d, d);
      const double cosines =
        std::max(glm::dot(normalA, d), 0.0) * std::max(-glm::dot(normalB, d), 0.0);
      bool blocked = false;
      for (const Polygon& occluder : occluders)
      {
        blocked = blocked || Blocks(occluder, x.point, y.point);
      }
      sum += blocked ? 0.0 : cosines / (r2 * r2) * x.area * y.area;
    }
  }
  return sum;
}

} // namespace vantage
