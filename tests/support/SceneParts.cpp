#include "support/SceneParts.h"

#include <array>
#include <cmath>
#include <utility>

namespace vantage::test
{

std::uint32_t SceneParts::AddMaterial(Material material)
{
  material.name = "m" + std::to_string(this->scene.materials.size());
  this->scene.materials.push_back(std::move(material));
  return static_cast<std::uint32_t>(this->scene.materials.size() - 1);
}

std::uint32_t SceneParts::SurfaceMaterial(const Color& albedo)
{
  Material material;
  material.albedo = albedo;
  return this->AddMaterial(material);
}

std::uint32_t SceneParts::SolidMaterial(const Color& albedo)
{
  Material material;
  material.albedo = albedo;
  material.twoSided = false;
  return this->AddMaterial(material);
}

std::uint32_t SceneParts::LampMaterial(const Color& radiance, const Color& albedo)
{
  Material material;
  material.albedo = albedo;
  material.emission = radiance;
  return this->AddMaterial(material);
}

void SceneParts::AddPanel(const Vec3& origin, const Vec3& u, const Vec3& v, std::uint32_t material)
{
  // Neighbours reach their common corners by different sums: what rounding makes of them is
  // dropped.
  constexpr double Grid = 0x1.0p-30;
  std::vector<Vec3> corners{ origin, origin + u, origin + u + v, origin + v };
  for (Vec3& corner : corners)
  {
    corner = Grid * glm::round(corner / Grid);
  }
  this->scene.AddPolygon(corners, material);
}

void SceneParts::AddDownward(const Vec3& centre, const Vec2& size, std::uint32_t material)
{
  this->AddPanel(
    centre - Vec3(0.5 * size, 0.0), Vec3(0.0, size.y, 0.0), Vec3(size.x, 0.0, 0.0), material);
}

void SceneParts::AddFloor(const Vec2& low, const Vec2& high, double z, std::uint32_t material)
{
  const Vec2 size = high - low;
  this->AddPanel(Vec3(low, z), Vec3(size.x, 0.0, 0.0), Vec3(0.0, size.y, 0.0), material);
}

void SceneParts::AddCeiling(const Vec2& low, const Vec2& high, double z, std::uint32_t material)
{
  this->AddDownward(Vec3(0.5 * (low + high), z), high - low, material);
}

void SceneParts::AddWall(const Vec2& a, const Vec2& b, double height, std::uint32_t material)
{
  this->AddPanel(Vec3(b, 0.0), Vec3(a - b, 0.0), Vec3(0.0, 0.0, height), material);
}

void SceneParts::AddWalls(const Vec2& low, const Vec2& high, double height, std::uint32_t material)
{
  const std::array<Vec2, 4> corners{ low, Vec2(high.x, low.y), high, Vec2(low.x, high.y) };
  for (int k = 0; k < 4; ++k)
  {
    this->AddWall(corners[k], corners[(k + 1) % 4], height, material);
  }
}

void SceneParts::AddRoom(const Vec3& low, const Vec3& high, std::uint32_t floor,
  std::uint32_t ceiling, std::uint32_t walls)
{
  this->AddFloor(low, high, low.z, floor);
  this->AddCeiling(low, high, high.z, ceiling);
  this->AddWalls(low, high, high.z, walls);
}

void SceneParts::AddBlock(const Vec3& foot, const Vec2& size, double turn, double height,
  std::uint32_t material, bool hasTop)
{
  const Vec3 x = 0.5 * size.x * Vec3(std::cos(turn), std::sin(turn), 0.0);
  const Vec3 y = 0.5 * size.y * Vec3(-std::sin(turn), std::cos(turn), 0.0);
  const Vec3 up(0.0, 0.0, height);
  const std::array<Vec3, 4> base{ foot - x - y, foot + x - y, foot + x + y, foot - x + y };
  for (int k = 0; k < 4; ++k)
  {
    this->AddPanel(base[k], base[(k + 1) % 4] - base[k], up, material);
  }
  if (hasTop)
  {
    this->AddPanel(base[0] + up, 2.0 * x, 2.0 * y, material);
  }
}

void SceneParts::AddTable(
  const Vec2& centre, const Vec2& size, double height, std::uint32_t material)
{
  constexpr double Thickness = 0.04;
  constexpr double Inset = 0.06;
  constexpr double LegWidth = 0.06;
  const Vec2 low = centre - 0.5 * size;
  const Vec2 high = centre + 0.5 * size;
  const double bottom = height - Thickness;
  const std::array<Vec2, 4> corners{ low, Vec2(high.x, low.y), high, Vec2(low.x, high.y) };
  for (int k = 0; k < 4; ++k)
  {
    this->AddPanel(Vec3(corners[k], bottom), Vec3(corners[(k + 1) % 4] - corners[k], 0.0),
      Vec3(0.0, 0.0, Thickness), material);
    const Vec2 inwards = glm::sign(centre - corners[k]);
    this->AddBlock(
      Vec3(corners[k] + Inset * inwards, 0.0), Vec2(LegWidth), 0.0, bottom, material, false);
  }
  this->AddFloor(low, high, height, material);
  this->AddCeiling(low, high, bottom, material);
}

void SceneParts::AddCamera(
  const std::string& name, const Vec3& eye, const Vec3& lookAt, double fieldOfView)
{
  Camera camera;
  camera.name = name;
  camera.eye = eye;
  camera.lookAt = lookAt;
  camera.up = Vec3(0.0, 0.0, 1.0);
  camera.fieldOfView = fieldOfView;
  this->scene.cameras.push_back(camera);
}

double Between(double low, double high, RandomStream& random)
{
  return low + (high - low) * random.Next();
}

double LogBetween(double low, double high, RandomStream& random)
{
  return low * std::pow(high / low, random.Next());
}

Color ColorBetween(double low, double high, RandomStream& random)
{
  const double red = Between(low, high, random);
  const double green = Between(low, high, random);
  return { red, green, Between(low, high, random) };
}

} // namespace vantage::test
