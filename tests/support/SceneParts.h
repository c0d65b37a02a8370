#pragma once

#include "core/math/Sampling.h"
#include "core/scene/Scene.h"

#include <string>
#include <vector>

/// \file SceneParts.h
/// What the study scenes are put together from. Lengths in metres, z up, unless a scene says else.

namespace vantage::test
{

/// A scene that grows: each Add... appends polygons, each ...Material a material.
class SceneParts
{
public:
  /// A wall, floor or ceiling: both sides reflect.
  std::uint32_t SurfaceMaterial(const Color& albedo);
  /// The faces of a solid body, which nobody sees from inside.
  std::uint32_t SolidMaterial(const Color& albedo);
  /// Shines from its front; the back reflects like the front.
  std::uint32_t LampMaterial(const Color& radiance, const Color& albedo = Color(0.5));

  /// The parallelogram origin, origin + u, origin + u + v, origin + v; its front is where u x v
  /// points.
  void AddPanel(const Vec3& origin, const Vec3& u, const Vec3& v, std::uint32_t material);
  /// A horizontal rectangle about a centre that faces down: a lamp under a ceiling.
  void AddDownward(const Vec3& centre, const Vec2& size, std::uint32_t material);
  /// The inside of a room, with or without its ceiling. Floor, ceiling, walls.
  void AddRoom(const Vec3& low, const Vec3& high, std::uint32_t floor, std::uint32_t ceiling,
    std::uint32_t walls);
  void AddFloor(const Vec2& low, const Vec2& high, double z, std::uint32_t material);
  void AddCeiling(const Vec2& low, const Vec2& high, double z, std::uint32_t material);
  /// A wall from floor to `height` along the line from a to b; its front is to the left of it.
  void AddWall(const Vec2& a, const Vec2& b, double height, std::uint32_t material);
  /// Four walls around a rectangle, fronts inwards.
  void AddWalls(const Vec2& low, const Vec2& high, double height, std::uint32_t material);
  /// An upright body on a turned rectangle about a point of the floor, or of what else it stands
  /// on: four sides and, where wanted, a top. It has no bottom.
  void AddBlock(const Vec3& foot, const Vec2& size, double turn, double height,
    std::uint32_t material, bool hasTop = true);
  /// A closed slab on four posts.
  void AddTable(const Vec2& centre, const Vec2& size, double height, std::uint32_t material);

  void AddCamera(
    const std::string& name, const Vec3& eye, const Vec3& lookAt, double fieldOfView = 60.0);

  Scene scene;

private:
  std::uint32_t AddMaterial(Material material);
};

/// A uniform number in [low, high).
double Between(double low, double high, RandomStream& random);
/// Between low and high with a uniform logarithm.
double LogBetween(double low, double high, RandomStream& random);
/// Each channel on its own.
Color ColorBetween(double low, double high, RandomStream& random);

} // namespace vantage::test
