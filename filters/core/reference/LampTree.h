#pragma once

#include "core/mesh/Facets.h"

#include <cstdint>
#include <optional>
#include <vector>

/// \file LampTree.h
/// Which of many lamps to ask for light.

namespace vantage
{

/// One emitting side of a facet.
struct Lamp
{
  Polygon shape; ///< counter-clockwise seen from where it shines
  Vec3 normal;
  Color emission; ///< W m^-2 sr^-1
  std::uint32_t facet;
};

/// A lamp, and with what probability it was chosen.
struct LampChoice
{
  const Lamp* lamp;
  double probability;
};

/// A binary tree over the lamps (Conty Estevez, Kulla 2018): each node knows a sphere around its
/// lamps, a cone around their normals and their power, and so an estimate from above of the light
/// it can send to a point. Choosing costs O(log n).
class LampTree
{
public:
  LampTree(const Scene& scene, const FacetSet& facets);

  /// Goes down the tree with the uniform number u, at each node in proportion to the estimates of
  /// the two children. Every lamp that can light the point has a chance; nothing when none can.
  std::optional<LampChoice> Choose(const Vec3& point, const Vec3& normal, double u) const;

  std::size_t Size() const { return this->Lamps.size(); }

private:
  struct Node
  {
    Vec3 centre; ///< of the sphere that holds the lamps
    double radius;
    Vec3 axis;           ///< of the cone that holds their normals
    double angle;        ///< half its opening
    double power;        ///< mean of channels, area times emission
    std::uint32_t first; ///< a lamp, or the first of two children
    bool isLamp;
  };

  void Build(std::uint32_t node, std::uint32_t first, std::uint32_t last);
  static double Reach(const Node& node, const Vec3& point, const Vec3& normal);

  std::vector<Lamp> Lamps;
  std::vector<Node> Nodes;
};

} // namespace vantage
