#include "core/mesh/Shells.h"

#include "core/mesh/DisjointSets.h"

#include <algorithm>
#include <cmath>

namespace vantage
{

namespace
{

/// A facet at an edge, by its two sides.
struct AtEdge
{
  PatchId ahead;  ///< the side that a rotation about the edge leaves from
  PatchId behind; ///< the side that it comes to
  double angle = 0.0;
};

/// Facets around an edge in the direction in which the first of them runs along it.
class EdgeStar
{
public:
  explicit EdgeStar(const std::vector<Facet>& facets)
    : Facets(&facets)
  {
  }

  /// Joins sides that follow each other. One facet alone has its own two sides there.
  template <typename Iterator>
  void Join(Iterator first, Iterator last, DisjointSets& shells)
  {
    this->Around.clear();
    for (Iterator use = first; use != last; ++use)
    {
      this->Around.push_back(this->Sides(*first, *use));
    }
    if (this->Around.size() > 2)
    {
      this->SortByAngle(first);
    }
    for (std::size_t i = 0; i < this->Around.size(); ++i)
    {
      shells.Join(this->Around[i].ahead, this->Around[(i + 1) % this->Around.size()].behind);
    }
  }

private:
  const Vec3& Start(const FacetEdge& use) const
  {
    return (*this->Facets)[use.facet].shape[static_cast<int>(use.corner)];
  }

  /// Who runs along an edge sees the facet to the left: its front is ahead.
  AtEdge Sides(const FacetEdge& first, const FacetEdge& use) const
  {
    const bool isAlong = this->Start(use) == this->Start(first);
    return { PatchOf(use.facet, isAlong ? Side::Front : Side::Back),
      PatchOf(use.facet, isAlong ? Side::Back : Side::Front) };
  }

  template <typename Iterator>
  void SortByAngle(Iterator first)
  {
    const TriangleOrQuadrilateral& shape = (*this->Facets)[first->facet].shape;
    const int corner = static_cast<int>(first->corner);
    const Vec3 along = glm::normalize(shape[(corner + 1) % shape.Size()] - shape[corner]);
    // The normal of the side ahead turns with the facet.
    const Vec3 start = this->Ahead(this->Around[0]);
    const Vec3 quarter = glm::cross(along, start);
    for (AtEdge& facet : this->Around)
    {
      const Vec3 normal = this->Ahead(facet);
      const double angle = std::atan2(glm::dot(normal, quarter), glm::dot(normal, start));
      facet.angle = angle < 0.0 ? angle + 2.0 * Pi : angle;
    }
    std::stable_sort(this->Around.begin(), this->Around.end(),
      [](const AtEdge& a, const AtEdge& b) { return a.angle < b.angle; });
  }

  Vec3 Ahead(const AtEdge& facet) const
  {
    const Vec3 front = UnitNormal((*this->Facets)[facet.ahead / 2].shape);
    return facet.ahead % 2 == 0 ? front : -front;
  }

  const std::vector<Facet>* Facets;
  std::vector<AtEdge> Around; ///< of one edge
};

} // namespace

std::vector<PatchId> ShellsOf(const FacetSet& facets, const std::vector<FacetEdge>& edges)
{
  DisjointSets shells(2 * facets.facets.size());
  EdgeStar star(facets.facets);
  ForEachEdge(edges, [&](const auto first, const auto last) { star.Join(first, last, shells); });
  std::vector<PatchId> shellOf(2 * facets.facets.size());
  for (PatchId id = 0; id < shellOf.size(); ++id)
  {
    shellOf[id] = shells.Find(id);
  }
  return shellOf;
}

} // namespace vantage
