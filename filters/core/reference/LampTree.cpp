#include "core/reference/LampTree.h"

#include <algorithm>
#include <cmath>

namespace vantage
{

namespace
{

/// Angle between two unit vectors.
double AngleBetween(const Vec3& a, const Vec3& b)
{
  return std::acos(std::clamp(glm::dot(a, b), -1.0, 1.0));
}

/// The largest cosine within `spread` of an angle, 0 beyond the horizon.
double LargestCosine(double angle, double spread)
{
  return std::max(0.0, std::cos(std::max(0.0, angle - spread)));
}

} // namespace

LampTree::LampTree(const Scene& scene, const FacetSet& facets)
{
  for (std::uint32_t f = 0; f < facets.facets.size(); ++f)
  {
    const Facet& facet = facets.facets[f];
    for (const Side side : { Side::Front, Side::Back })
    {
      const Color& emission = scene.materials[facet.MaterialOf(side)].emission;
      if (facet.IsPolygonFront(side) && MaxChannel(emission) > 0.0)
      {
        const Polygon shape = side == Side::Front ? facet.shape : Reversed(facet.shape);
        this->Lamps.push_back({ shape, UnitNormal(shape), emission, f });
      }
    }
  }
  if (!this->Lamps.empty())
  {
    this->Nodes.resize(1);
    this->Build(0, 0, static_cast<std::uint32_t>(this->Lamps.size()));
  }
}

void LampTree::Build(std::uint32_t id, std::uint32_t first, std::uint32_t last)
{
  Vec3 low = this->Lamps[first].shape[0];
  Vec3 high = low;
  Vec3 normals(0.0);
  double power = 0.0;
  for (std::uint32_t i = first; i < last; ++i)
  {
    const Lamp& lamp = this->Lamps[i];
    for (const Vec3& v : lamp.shape)
    {
      low = glm::min(low, v);
      high = glm::max(high, v);
    }
    normals += lamp.normal;
    power += Mean(lamp.emission) * Area(lamp.shape);
  }
  const double length = glm::length(normals);
  Node node;
  node.centre = 0.5 * (low + high);
  node.radius = 0.5 * glm::length(high - low);
  node.axis = length > 1e-6 ? normals / length : Vec3(0.0, 0.0, 1.0);
  node.angle = 0.0;
  node.power = power;
  node.isLamp = last - first == 1;
  node.first = node.isLamp ? first : static_cast<std::uint32_t>(this->Nodes.size());
  for (std::uint32_t i = first; i < last; ++i)
  {
    node.angle = std::max(node.angle, AngleBetween(node.axis, this->Lamps[i].normal));
  }
  this->Nodes[id] = node;
  if (node.isLamp)
  {
    return;
  }
  const Vec3 size = high - low;
  const int axis = size.x >= size.y ? (size.x >= size.z ? 0 : 2) : (size.y >= size.z ? 1 : 2);
  std::stable_sort(this->Lamps.begin() + first, this->Lamps.begin() + last,
    [axis](const Lamp& a, const Lamp& b)
    { return Centroid(a.shape)[axis] < Centroid(b.shape)[axis]; });
  const std::uint32_t middle = first + (last - first) / 2;
  this->Nodes.resize(this->Nodes.size() + 2);
  this->Build(node.first, first, middle);
  this->Build(node.first + 1, middle, last);
}

/// Power times the largest cosines at both ends over the squared distance, with the sphere seen
/// under the half angle `spread`. Inside of the sphere nothing is known of distance and angles.
double LampTree::Reach(const Node& node, const Vec3& point, const Vec3& normal)
{
  const Vec3 path = node.centre - point;
  const double distance = glm::length(path);
  if (distance <= node.radius)
  {
    return node.power / (node.radius * node.radius);
  }
  const Vec3 direction = path / distance;
  const double spread = std::asin(node.radius / distance);
  return node.power * LargestCosine(AngleBetween(normal, direction), spread) *
         LargestCosine(AngleBetween(node.axis, -direction), spread + node.angle) /
         (distance * distance);
}

std::optional<LampChoice> LampTree::Choose(const Vec3& point, const Vec3& normal, double u) const
{
  if (this->Nodes.empty() || !(Reach(this->Nodes[0], point, normal) > 0.0))
  {
    return std::nullopt;
  }
  const Node* node = &this->Nodes[0];
  double probability = 1.0;
  while (!node->isLamp)
  {
    const Node* children = &this->Nodes[node->first];
    const double left = Reach(children[0], point, normal);
    const double sum = left + Reach(children[1], point, normal);
    if (!(sum > 0.0))
    {
      return std::nullopt;
    }
    const double chance = left / sum;
    const bool goesLeft = u < chance;
    u = goesLeft ? u / chance : (u - chance) / (1.0 - chance);
    probability *= goesLeft ? chance : 1.0 - chance;
    node = &children[goesLeft ? 0 : 1];
  }
  return LampChoice{ &this->Lamps[node->first], probability };
}

} // namespace vantage
