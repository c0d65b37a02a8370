#pragma once

#include "core/scene/Scene.h"

#include <vector>

/// \file TestRooms.h
/// Small scenes whose light is known or can be solved.

namespace vantage::testing
{

inline Material Diffuse(const Color& albedo, const Color& emission = Color(0.0))
{
  Material material;
  material.albedo = albedo;
  material.emission = emission;
  return material;
}

/// Adds an axis-aligned box, fronts towards the inside.
inline void AddBox(Scene& scene, const Vec3& a, const Vec3& b, std::uint32_t material)
{
  const auto add = [&](const std::vector<Vec3>& points) { scene.AddPolygon(points, material); };
  add({ { a.x, a.y, a.z }, { b.x, a.y, a.z }, { b.x, b.y, a.z }, { a.x, b.y, a.z } });
  add({ { a.x, a.y, b.z }, { a.x, b.y, b.z }, { b.x, b.y, b.z }, { b.x, a.y, b.z } });
  add({ { a.x, a.y, a.z }, { a.x, a.y, b.z }, { b.x, a.y, b.z }, { b.x, a.y, a.z } });
  add({ { a.x, b.y, a.z }, { b.x, b.y, a.z }, { b.x, b.y, b.z }, { a.x, b.y, b.z } });
  add({ { a.x, a.y, a.z }, { a.x, b.y, a.z }, { a.x, b.y, b.z }, { a.x, a.y, b.z } });
  add({ { b.x, a.y, a.z }, { b.x, a.y, b.z }, { b.x, b.y, b.z }, { b.x, b.y, a.z } });
}

/// A closed box of one material: its radiance is emission / (1 - albedo) everywhere.
inline Scene Furnace(const Color& albedo, const Color& emission)
{
  Scene scene;
  scene.materials = { Diffuse(albedo, emission) };
  AddBox(scene, { 0, 0, 0 }, { 2, 1, 1.5 }, 0);
  return scene;
}

/// A closed room with a lamp under the ceiling and a horizontal pane that shades the floor.
inline Scene ShadedRoom(const Color& emission = Color(10.0, 8.0, 6.0))
{
  Scene scene;
  scene.materials = { Diffuse({ 0.6, 0.5, 0.4 }), Diffuse(Color(0.2), emission),
    Diffuse({ 0.3, 0.6, 0.3 }) };
  AddBox(scene, { 0, 0, 0 }, { 2, 2, 2 }, 0);
  scene.AddPolygon(
    { { 0.5, 0.5, 1.9 }, { 0.5, 1.5, 1.9 }, { 1.5, 1.5, 1.9 }, { 1.5, 0.5, 1.9 } }, 1);
  scene.AddPolygon(
    { { 0.0, 0.5, 1.0 }, { 1.0, 0.5, 1.0 }, { 1.0, 1.5, 1.0 }, { 0.0, 1.5, 1.0 } }, 2);
  return scene;
}

inline Camera LookingAt(const Vec3& eye, const Vec3& target, const Vec3& up, double fieldOfView)
{
  Camera camera;
  camera.eye = eye;
  camera.lookAt = target;
  camera.up = up;
  camera.fieldOfView = fieldOfView;
  return camera;
}

} // namespace vantage::testing
