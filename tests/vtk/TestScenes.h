#pragma once

#include "core/scene/Scene.h"

namespace vantage
{

/// A unit box seen from inside, a lamp of radiance (8, 6, 4) below its ceiling, and a camera
/// "door". Materials: 0 grey walls, 1 reddish floor, 2 lamp (one-sided).
inline Scene MakeLitBox()
{
  Scene scene;
  Material walls, floor, lamp;
  walls.name = "walls";
  walls.albedo = Color(0.5);
  floor.name = "floor";
  floor.albedo = Color(0.7, 0.3, 0.2);
  lamp.name = "lamp";
  lamp.albedo = Color(0.0);
  lamp.emission = Color(8.0, 6.0, 4.0);
  lamp.twoSided = false;
  scene.materials = { walls, floor, lamp };
  scene.AddPolygon({ { 0, 0, 0 }, { 1, 0, 0 }, { 1, 1, 0 }, { 0, 1, 0 } }, 1); // up
  scene.AddPolygon({ { 0, 0, 1 }, { 0, 1, 1 }, { 1, 1, 1 }, { 1, 0, 1 } }, 0); // down
  scene.AddPolygon({ { 0, 0, 0 }, { 0, 1, 0 }, { 0, 1, 1 }, { 0, 0, 1 } }, 0); // +x
  scene.AddPolygon({ { 1, 0, 0 }, { 1, 0, 1 }, { 1, 1, 1 }, { 1, 1, 0 } }, 0); // -x
  scene.AddPolygon({ { 0, 0, 0 }, { 0, 0, 1 }, { 1, 0, 1 }, { 1, 0, 0 } }, 0); // +y
  scene.AddPolygon({ { 0, 1, 0 }, { 1, 1, 0 }, { 1, 1, 1 }, { 0, 1, 1 } }, 0); // -y
  scene.AddPolygon({ { .3, .3, .9 }, { .3, .7, .9 }, { .7, .7, .9 }, { .7, .3, .9 } }, 2);

  Camera door;
  door.name = "door";
  door.eye = Vec3(0.1, 0.1, 0.5);
  door.lookAt = Vec3(0.9, 0.8, 0.1);
  door.up = Vec3(0.0, 0.0, 1.0);
  door.fieldOfView = 60.0;
  door.aspect = 1.25;
  scene.cameras.push_back(door);
  return scene;
}

} // namespace vantage
