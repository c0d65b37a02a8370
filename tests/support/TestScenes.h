#pragma once

#include "core/math/Polygon.h"
#include "core/scene/Scene.h"

#include <array>
#include <cmath>

/// \file TestScenes.h
/// Small scenes that several tests share.

namespace vantage::test
{

/// Appends the six faces of an axis-aligned box, fronts inwards or outwards:
/// floor, ceiling, then the walls at low x, high x, low y, high y.
inline void AddBox(Scene& scene, const Vec3& low, const Vec3& high, bool facesInwards,
  const std::array<std::uint32_t, 6>& materials)
{
  const auto corner = [&](int i)
  { return Vec3(i & 1 ? high.x : low.x, i & 2 ? high.y : low.y, i & 4 ? high.z : low.z); };
  // Counter-clockwise from inside.
  constexpr int Faces[6][4] = { { 0, 1, 3, 2 }, { 4, 6, 7, 5 }, { 0, 2, 6, 4 }, { 1, 5, 7, 3 },
    { 0, 4, 5, 1 }, { 2, 3, 7, 6 } };
  for (int f = 0; f < 6; ++f)
  {
    std::vector<Vec3> points;
    for (int k = 0; k < 4; ++k)
    {
      points.push_back(corner(Faces[f][facesInwards ? k : 3 - k]));
    }
    scene.AddPolygon(points, materials[f]);
  }
}

/// A ball of triangles, fronts outwards: as many rings of them from pole to pole, twice as many
/// around.
inline void AddBall(
  Scene& scene, const Vec3& centre, double radius, int rings, std::uint32_t material)
{
  const auto at = [&](int ring, int column)
  {
    const double polar = Pi * ring / rings;
    const double around = Pi * (column % (2 * rings)) / rings;
    const double sine = ring == rings ? 0.0 : std::sin(polar);
    return centre +
           radius * Vec3(sine * std::cos(around), sine * std::sin(around), std::cos(polar));
  };
  for (int r = 0; r < rings; ++r)
  {
    for (int c = 0; c < 2 * rings; ++c)
    {
      if (r > 0)
      {
        scene.AddPolygon({ at(r, c), at(r + 1, c), at(r, c + 1) }, material);
      }
      if (r + 1 < rings)
      {
        scene.AddPolygon({ at(r + 1, c), at(r + 1, c + 1), at(r, c + 1) }, material);
      }
    }
  }
}

/// The corners of polygon `p`.
inline std::vector<Vec3> CornersOf(const Scene& scene, std::size_t p)
{
  std::vector<Vec3> points;
  for (std::uint32_t i = scene.offsets[p]; i < scene.offsets[p + 1]; ++i)
  {
    points.push_back(scene.vertices[scene.indices[i]]);
  }
  return points;
}

/// All of its polygons, of 16 corners at most.
inline std::vector<Polygon> FacesOf(const Scene& scene)
{
  std::vector<Polygon> faces;
  for (std::size_t p = 0; p < scene.PolygonCount(); ++p)
  {
    const std::vector<Vec3> corners = CornersOf(scene, p);
    faces.emplace_back(PolygonView(corners.data(), static_cast<int>(corners.size())));
  }
  return faces;
}

/// The same scene with every quadrilateral cut into n x n pieces, or these into two triangles each.
inline Scene CutIntoPieces(const Scene& whole, int n, bool triangles = false)
{
  Scene cut;
  cut.materials = whole.materials;
  cut.cameras = whole.cameras;
  for (std::size_t p = 0; p < whole.PolygonCount(); ++p)
  {
    const std::vector<Vec3> points = CornersOf(whole, p);
    const auto at = [&](double i, double j)
    {
      const Vec3 low = points[0] + i / n * (points[1] - points[0]);
      const Vec3 high = points[3] + i / n * (points[2] - points[3]);
      return low + j / n * (high - low);
    };
    for (int i = 0; i < n * n; ++i)
    {
      const int x = i % n;
      const int y = i / n;
      const std::array<Vec3, 4> c{ at(x, y), at(x + 1, y), at(x + 1, y + 1), at(x, y + 1) };
      const std::uint32_t material = whole.materialOfPolygon[p];
      if (triangles)
      {
        cut.AddPolygon({ c[0], c[1], c[2] }, material);
        cut.AddPolygon({ c[0], c[2], c[3] }, material);
      }
      else
      {
        cut.AddPolygon({ c[0], c[1], c[2], c[3] }, material);
      }
    }
  }
  return cut;
}

inline Material MakeMaterial(
  const Color& albedo, const Color& emission = Color(0.0), bool twoSided = false)
{
  Material material;
  material.name = "m";
  material.albedo = albedo;
  material.emission = emission;
  material.twoSided = twoSided;
  return material;
}

/// A camera inside the unit box that sees floor and walls.
inline Camera InsideCamera()
{
  Camera camera;
  camera.name = "inside";
  camera.eye = Vec3(0.2, 0.3, 0.8);
  camera.lookAt = Vec3(0.7, 0.6, 0.1);
  camera.up = Vec3(0.0, 0.0, 1.0);
  camera.fieldOfView = 60.0;
  return camera;
}

/// Closed unit box in which everything has one albedo and emits one radiance: the furnace, where
/// radiance is emission / (1 - albedo) everywhere.
inline Scene MakeFurnace(const Color& albedo, const Color& emission = Color(1.0))
{
  Scene scene;
  scene.materials.push_back(MakeMaterial(albedo, emission));
  AddBox(scene, Vec3(0.0), Vec3(1.0), true, { 0, 0, 0, 0, 0, 0 });
  scene.cameras.push_back(InsideCamera());
  return scene;
}

/// The same over any floor, with its walls: floor and ceiling have as many corners as there are
/// walls. The floor is counter-clockwise.
inline Scene MakeGlowingRoom(const std::vector<Vec2>& plan, double height, double albedo)
{
  Scene scene;
  scene.materials = { MakeMaterial(Color(albedo), Color(1.0)) };
  std::vector<Vec3> floor, ceiling;
  for (const Vec2& p : plan)
  {
    floor.emplace_back(p.x, p.y, 0.0);
    ceiling.emplace(ceiling.begin(), p.x, p.y, height);
  }
  scene.AddPolygon(floor, 0);
  scene.AddPolygon(ceiling, 0);
  for (std::size_t k = 0; k < plan.size(); ++k)
  {
    const Vec2& a = plan[k];
    const Vec2& b = plan[(k + 1) % plan.size()];
    scene.AddPolygon(
      { Vec3(a.x, a.y, 0), Vec3(a.x, a.y, height), Vec3(b.x, b.y, height), Vec3(b.x, b.y, 0) }, 0);
  }
  scene.cameras = { InsideCamera() };
  return scene;
}

/// A floor of 22 corners: teeth and gaps of half a metre.
inline std::vector<Vec2> CombPlan()
{
  std::vector<Vec2> comb = { { 0, 0 }, { 5, 0 } };
  for (int k = 4; k >= 0; --k)
  {
    comb.insert(comb.end(), { { k + 1.0, 3 }, { k + 0.5, 3 }, { k + 0.5, 1 }, { k + 0.0, 1 } });
  }
  return comb;
}

/// Closed unit box with coloured walls, a lamp below the ceiling and a block on the floor: direct
/// and indirect light, shadows, both sides of the lamp.
inline Scene MakeLitBox()
{
  Scene scene;
  scene.materials = { MakeMaterial(Color(0.7)), MakeMaterial(Color(0.6, 0.2, 0.1)),
    MakeMaterial(Color(0.1, 0.5, 0.2)), MakeMaterial(Color(0.3), Color(30.0, 25.0, 20.0), true),
    MakeMaterial(Color(0.5)) };
  AddBox(scene, Vec3(0.0), Vec3(1.0), true, { 0, 0, 1, 2, 0, 0 });
  AddBox(scene, Vec3(0.55, 0.5, 0.0), Vec3(0.85, 0.8, 0.4), false, { 4, 4, 4, 4, 4, 4 });
  scene.AddPolygon(
    { Vec3(0.4, 0.4, 0.95), Vec3(0.4, 0.6, 0.95), Vec3(0.6, 0.6, 0.95), Vec3(0.6, 0.4, 0.95) }, 3);
  scene.cameras.push_back(InsideCamera());
  return scene;
}

} // namespace vantage::test
