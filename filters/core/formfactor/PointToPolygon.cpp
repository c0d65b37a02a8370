#include "core/formfactor/FormFactor.h"

#include <algorithm>
#include <cmath>

namespace vantage
{
namespace
{

/// Lambert's sum over the edges of a polygon seen from the origin: the angle an edge subtends times
/// the cosine between n and the normal of the plane through the origin and the edge. Takes the
/// vertices one after the other.
class CosineSum
{
public:
  explicit CosineSum(const Vec3& n)
    : Normal(n)
  {
  }

  void AddVertex(const Vec3& v)
  {
    if (this->Started)
    {
      this->AddEdge(v);
    }
    else
    {
      this->First = v;
      this->Started = true;
    }
    this->Last = v;
  }

  double Close()
  {
    if (this->Started)
    {
      this->AddEdge(this->First);
    }
    return std::clamp(0.5 * this->Sum, 0.0, Pi);
  }

private:
  void AddEdge(const Vec3& to)
  {
    // The edge instead of its end keeps all digits when the polygon is small and far away.
    const Vec3 wedge = glm::cross(to - this->Last, this->Last);
    const double sine = glm::length(wedge);
    if (sine > 0.0)
    {
      const double angle = std::atan2(sine, glm::dot(this->Last, to));
      this->Sum += angle * glm::dot(this->Normal, wedge) / sine;
    }
  }

  Vec3 Normal;
  Vec3 First{ 0.0 };
  Vec3 Last{ 0.0 };
  double Sum = 0.0;
  bool Started = false;
};

} // namespace

double PointToPolygon(const Vec3& x, const Vec3& n, const Polygon& p)
{
  if (p.Empty() || glm::dot(AreaNormal(p), x - p[0]) <= 0.0)
  {
    return 0.0;
  }
  CosineSum sum(n);
  Vec3 from = p[p.Size() - 1] - x;
  double heightFrom = glm::dot(n, from);
  for (const Vec3& vertex : p)
  {
    const Vec3 to = vertex - x;
    const double heightTo = glm::dot(n, to);
    if ((heightFrom < 0.0) != (heightTo < 0.0))
    {
      // The horizon cuts this edge.
      sum.AddVertex(from + (heightFrom / (heightFrom - heightTo)) * (to - from));
    }
    if (heightTo >= 0.0)
    {
      sum.AddVertex(to);
    }
    from = to;
    heightFrom = heightTo;
  }
  return sum.Close();
}

} // namespace vantage
