#include "core/formfactor/Subdivision.h"

#include <cassert>

namespace vantage
{

std::array<Polygon, 2> InHalves(const Polygon& p)
{
  assert(p.Size() > 3);
  const int middle = p.Size() / 2;
  std::array<Polygon, 2> halves;
  for (int i = 0; i <= middle; ++i)
  {
    halves[0].Add(p[i]);
  }
  for (int i = middle; i < p.Size(); ++i)
  {
    halves[1].Add(p[i]);
  }
  halves[1].Add(p[0]);
  return halves;
}

std::array<Polygon, 2> AcrossTheMiddle(const Polygon& p)
{
  const Vec3 centre = Centroid(p);
  Vec3 farthest(0.0);
  for (const Vec3& v : p)
  {
    const Vec3 d = v - centre;
    if (glm::dot(d, d) > glm::dot(farthest, farthest))
    {
      farthest = d;
    }
  }
  const Vec3 along = glm::normalize(farthest);
  const Plane middle{ along, glm::dot(along, centre) };
  return { ClipToFront(p, middle), ClipToFront(p, { -middle.normal, -middle.offset }) };
}

std::array<Polygon, 4> InFour(const Polygon& p)
{
  assert(p.Size() == 3 || p.Size() == 4);
  const auto middle = [&p](int i, int j) { return 0.5 * (p[i] + p[j]); };
  if (p.Size() == 3)
  {
    const Vec3 m01 = middle(0, 1);
    const Vec3 m12 = middle(1, 2);
    const Vec3 m20 = middle(2, 0);
    return { Polygon{ p[0], m01, m20 }, Polygon{ m01, p[1], m12 }, Polygon{ m20, m12, p[2] },
      Polygon{ m01, m12, m20 } };
  }
  const Vec3 m01 = middle(0, 1);
  const Vec3 m12 = middle(1, 2);
  const Vec3 m23 = middle(2, 3);
  const Vec3 m30 = middle(3, 0);
  const Vec3 centre = 0.5 * (m01 + m23);
  return { Polygon{ p[0], m01, centre, m30 }, Polygon{ m01, p[1], m12, centre },
    Polygon{ centre, m12, p[2], m23 }, Polygon{ m30, centre, m23, p[3] } };
}

} // namespace vantage
