#include "support/CornellBox.h"

#include <array>
#include <cmath>

namespace vantage::test
{

namespace
{

enum MaterialId : std::uint32_t
{
  White,
  Red,
  Green,
  Light
};

Material Diffuse(const char* name, const Color& albedo, const Color& emission = Color(0.0))
{
  Material material;
  material.name = name;
  material.albedo = albedo;
  material.emission = emission;
  material.twoSided = false; // behind the walls and within the blocks there is nothing
  return material;
}

/// The ceiling around the lamp: four trapezia that share their slanting edges.
void AddCeiling(Scene& scene)
{
  constexpr double Height = 548.8;
  const std::array<Vec2, 4> outer{ Vec2(556.0, 0.0), Vec2(556.0, 559.2), Vec2(0.0, 559.2),
    Vec2(0.0, 0.0) };
  const std::array<Vec2, 4> hole{ Vec2(343.0, 227.0), Vec2(343.0, 332.0), Vec2(213.0, 332.0),
    Vec2(213.0, 227.0) };
  const auto at = [](const Vec2& xz) { return Vec3(xz.x, Height, xz.y); };
  for (int k = 0; k < 4; ++k)
  {
    const int next = (k + 1) % 4;
    scene.AddPolygon({ at(outer[k]), at(outer[next]), at(hole[next]), at(hole[k]) }, White);
  }
  scene.AddPolygon({ at(hole[0]), at(hole[1]), at(hole[2]), at(hole[3]) }, Light);
}

void AddBlock(Scene& scene, const std::array<Vec2, 4>& top, double height)
{
  std::vector<Vec3> lid;
  for (int k = 0; k < 4; ++k)
  {
    const Vec2& a = top[k];
    const Vec2& b = top[(k + 1) % 4];
    lid.emplace_back(a.x, height, a.y);
    scene.AddPolygon(
      { Vec3(b.x, 0.0, b.y), Vec3(b.x, height, b.y), Vec3(a.x, height, a.y), Vec3(a.x, 0.0, a.y) },
      White);
  }
  scene.AddPolygon(lid, White);
}

} // namespace

Scene MakeCornellBox()
{
  Scene scene;
  scene.materials = { Diffuse("white", { 0.725, 0.71, 0.68 }),
    Diffuse("red", { 0.63, 0.065, 0.05 }), Diffuse("green", { 0.14, 0.45, 0.091 }),
    Diffuse("light", Color(0.78), { 17.0, 12.0, 4.0 }) };
  const Vec3 frontLeft(552.8, 0.0, 0.0);
  const Vec3 backLeft(549.6, 0.0, 559.2);
  const Vec3 frontRight(0.0, 0.0, 0.0);
  const Vec3 backRight(0.0, 0.0, 559.2);
  const Vec3 frontLeftTop(556.0, 548.8, 0.0);
  const Vec3 backLeftTop(556.0, 548.8, 559.2);
  const Vec3 frontRightTop(0.0, 548.8, 0.0);
  const Vec3 backRightTop(0.0, 548.8, 559.2);
  scene.AddPolygon({ frontLeft, frontRight, backRight, backLeft }, White);
  scene.AddPolygon({ backLeft, backRight, backRightTop, backLeftTop }, White);
  scene.AddPolygon({ backRight, frontRight, frontRightTop, backRightTop }, Green);
  scene.AddPolygon({ frontLeft, backLeft, backLeftTop }, Red);
  scene.AddPolygon({ frontLeft, backLeftTop, frontLeftTop }, Red);
  AddCeiling(scene);
  AddBlock(
    scene, { Vec2(130.0, 65.0), Vec2(82.0, 225.0), Vec2(240.0, 272.0), Vec2(290.0, 114.0) }, 165.0);
  AddBlock(scene,
    { Vec2(423.0, 247.0), Vec2(265.0, 296.0), Vec2(314.0, 456.0), Vec2(472.0, 406.0) }, 330.0);
  Camera camera;
  camera.name = "front";
  camera.eye = Vec3(278.0, 273.0, -800.0);
  camera.lookAt = Vec3(278.0, 273.0, 0.0);
  // A film of 25 mm behind a lens of 35 mm.
  camera.fieldOfView = 2.0 * std::atan(0.5 * 25.0 / 35.0) * 180.0 / Pi;
  scene.cameras.push_back(camera);
  return scene;
}

} // namespace vantage::test
