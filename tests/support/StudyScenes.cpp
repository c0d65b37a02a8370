#include "support/StudyScenes.h"

#include "core/Error.h"
#include "core/scene/Labyrinth.h"
#include "support/CornellBox.h"
#include "support/RandomRoom.h"
#include "support/SceneParts.h"
#include "support/TestScenes.h"

#include <glm/vector_relational.hpp>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <functional>
#include <limits>
#include <numeric>
#include <optional>

namespace vantage::test
{

namespace
{

struct Entry
{
  std::string name;
  std::function<StudyScene()> make;
};

/// A scene with a single camera.
Entry Single(const std::string& name, Scene (*make)())
{
  return { name, [name, make]
    {
      StudyScene study{ name, make(), {}, {} };
      study.camera = study.scene.cameras.front().name;
      return study;
    } };
}

const std::vector<Entry>& Entries()
{
  static const std::vector<Entry> entries = []
  {
    std::vector<Entry> list;
    for (const std::uint64_t seed : { 1, 2, 3 })
    {
      for (const int view : { 1, 2 })
      {
        list.push_back({ "labyrinth-" + std::to_string(seed) + "-view" + std::to_string(view),
          [seed, view] { return MakeLabyrinthStudy(seed, view); } });
      }
    }
    list.push_back(Single("cornell-box", MakeCornellBox));
    list.push_back({ "gap-room", []
      {
        // All light comes through a small part of every hemisphere.
        ReferenceSettings reference;
        reference.gatherRays *= 4;
        reference.mapRays *= 8;
        return StudyScene{ "gap-room", MakeGapRoom(), "inside", reference };
      } });
    list.push_back(Single("courtyard", MakeCourtyard));
    list.push_back(Single("free-blocks", MakeFreeBlocks));
    list.push_back(Single("gallery", MakeGallery));
    list.push_back(Single("unequal-lamps", MakeUnequalLamps));
    list.push_back(Single("lamp-hall", MakeLampHall));
    list.push_back(Single("round-bodies", MakeRoundBodies));
    list.push_back(Single("luminaires", MakeLuminaires));
    return list;
  }();
  return entries;
}

/// The number behind "room-", if the name is of that kind.
std::optional<std::uint64_t> RoomSeed(const std::string& name)
{
  const std::string prefix = "room-";
  std::uint64_t seed = 0;
  const char* const end = name.data() + name.size();
  if (name.rfind(prefix, 0) != 0)
  {
    return std::nullopt;
  }
  const auto result = std::from_chars(name.data() + prefix.size(), end, seed);
  return result.ec == std::errc() && result.ptr == end ? std::optional(seed) : std::nullopt;
}

/// Of 5 x 4 x 3 m, empty.
SceneParts LightRoom()
{
  SceneParts parts;
  const std::uint32_t wall = parts.SurfaceMaterial({ 0.7, 0.7, 0.65 });
  parts.AddRoom(Vec3(0.0), Vec3(5.0, 4.0, 3.0), parts.SurfaceMaterial({ 0.5, 0.4, 0.3 }),
    parts.SurfaceMaterial(Color(0.8)), wall);
  return parts;
}

} // namespace

Camera StudyScene::View() const
{
  Camera view = this->scene.FindCamera(this->camera);
  view.aspect = 1.0;
  return view;
}

Scene MakeLabyrinthOf(int rooms, std::uint64_t seed)
{
  LabyrinthSettings settings;
  settings.rows = static_cast<int>(std::sqrt(rooms));
  while (rooms % settings.rows != 0)
  {
    --settings.rows;
  }
  settings.columns = rooms / settings.rows;
  settings.seed = seed;
  return MakeLabyrinth(settings);
}

Scene PartAround(const Scene& scene, const Vec3& centre, double distance)
{
  Scene part;
  part.materials = scene.materials;
  for (std::size_t p = 0; p < scene.PolygonCount(); ++p)
  {
    std::vector<Vec3> points;
    Vec3 low(std::numeric_limits<double>::infinity());
    Vec3 high = -low;
    for (std::uint32_t i = scene.offsets[p]; i < scene.offsets[p + 1]; ++i)
    {
      points.push_back(scene.vertices[scene.indices[i]]);
      low = glm::min(low, points.back() - centre);
      high = glm::max(high, points.back() - centre);
    }
    if (glm::all(glm::lessThan(low, Vec3(distance))) &&
        glm::all(glm::greaterThan(high, Vec3(-distance))))
    {
      part.AddPolygon(points, scene.materialOfPolygon[p]);
    }
  }
  return part;
}

StudyScene MakeLabyrinthStudy(std::uint64_t seed, int view)
{
  const std::string camera = "view" + std::to_string(view);
  return { "labyrinth-" + std::to_string(seed) + "-" + camera, MakeLabyrinthOf(20, seed), camera,
    {} };
}

Scene MakeGapRoom()
{
  constexpr double Height = 2.8;
  SceneParts parts;
  const std::uint32_t floor = parts.SurfaceMaterial({ 0.5, 0.45, 0.4 });
  const std::uint32_t white = parts.SurfaceMaterial(Color(0.75));
  const std::uint32_t blue = parts.SurfaceMaterial({ 0.4, 0.5, 0.7 });
  parts.AddRoom(Vec3(0.0), Vec3(5.5, 4.0, Height), floor, white, white);
  // The wall between room and chamber, around the slit.
  const Vec3 up(0.0, 0.0, 1.0);
  const Vec3 along(0.0, 1.0, 0.0);
  parts.AddPanel(Vec3(4.0, 0.0, 0.0), Height * up, 1.8 * along, blue);
  parts.AddPanel(Vec3(4.0, 2.2, 0.0), Height * up, 1.8 * along, blue);
  parts.AddPanel(Vec3(4.0, 1.8, 2.2), 0.6 * up, 0.4 * along, blue);
  parts.AddPanel(Vec3(4.1, 0.6, 1.0), 0.6 * along, 0.8 * up, parts.LampMaterial(Color(80.0)));
  parts.AddBlock(
    Vec3(2.4, 2.6, 0.0), Vec2(0.8, 0.6), 0.4, 0.9, parts.SolidMaterial({ 0.6, 0.35, 0.25 }));
  parts.AddTable(Vec2(2.2, 1.1), Vec2(1.2, 0.7), 0.75, parts.SolidMaterial({ 0.5, 0.5, 0.4 }));
  parts.AddCamera("inside", Vec3(0.3, 0.4, 1.6), Vec3(4.0, 2.4, 0.8));
  return parts.scene;
}

Scene MakeCourtyard()
{
  SceneParts parts;
  const std::uint32_t ground = parts.SurfaceMaterial({ 0.4, 0.4, 0.35 });
  const std::uint32_t wall = parts.SurfaceMaterial({ 0.7, 0.6, 0.5 });
  const std::uint32_t stone = parts.SolidMaterial({ 0.55, 0.55, 0.6 });
  const std::uint32_t brick = parts.SolidMaterial({ 0.6, 0.3, 0.2 });
  parts.AddFloor(Vec2(0.0), Vec2(12.0, 10.0), 0.0, ground);
  parts.AddWalls(Vec2(0.0), Vec2(12.0, 10.0), 3.0, wall);
  parts.AddDownward(Vec3(4.0, 7.0, 2.6), Vec2(0.6), parts.LampMaterial({ 90.0, 80.0, 60.0 }));
  // A lamp that shines along the ground.
  parts.AddPanel(Vec3(11.8, 2.0, 1.2), Vec3(0.0, 0.0, 0.5), Vec3(0.0, 0.8, 0.0),
    parts.LampMaterial({ 30.0, 40.0, 50.0 }));
  parts.AddBlock(Vec3(6.0, 5.0, 0.0), Vec2(1.5, 1.0), 0.5, 1.4, stone);
  parts.AddBlock(Vec3(8.5, 7.5, 0.0), Vec2(1.0, 1.0), 0.2, 2.2, brick);
  parts.AddBlock(Vec3(3.0, 4.2, 0.0), Vec2(0.7, 0.7), 1.1, 0.6, brick);
  parts.AddBlock(Vec3(9.0, 3.0, 0.0), Vec2(2.0, 0.4), 0.9, 1.0, stone);
  parts.AddCamera("inside", Vec3(0.8, 0.8, 1.7), Vec3(6.5, 6.0, 0.8));
  return parts.scene;
}

Scene MakeFreeBlocks()
{
  SceneParts parts;
  parts.AddFloor(Vec2(-10.0), Vec2(10.0), 0.0, parts.SurfaceMaterial({ 0.5, 0.5, 0.45 }));
  const std::uint32_t red = parts.SolidMaterial({ 0.7, 0.25, 0.2 });
  const std::uint32_t grey = parts.SolidMaterial(Color(0.6));
  parts.AddBlock(Vec3(0.0, 0.0, 0.0), Vec2(1.5, 1.5), 0.3, 2.0, grey);
  parts.AddBlock(Vec3(2.5, 1.0, 0.0), Vec2(1.0, 2.5), -0.4, 1.2, red);
  parts.AddBlock(Vec3(-2.0, 1.8, 0.0), Vec2(0.8, 0.8), 0.8, 3.0, red);
  parts.AddBlock(Vec3(1.2, -2.2, 0.0), Vec2(1.6, 0.6), 0.1, 0.5, grey);
  parts.AddDownward(Vec3(-1.0, -3.0, 5.0), Vec2(1.0), parts.LampMaterial(Color(60.0)));
  parts.AddCamera("outside", Vec3(-5.0, -6.0, 2.5), Vec3(0.5, 0.5, 0.6), 50.0);
  return parts.scene;
}

Scene MakeGallery()
{
  constexpr double Height = 3.5;
  SceneParts parts;
  const std::uint32_t floor = parts.SurfaceMaterial({ 0.45, 0.4, 0.35 });
  const std::uint32_t ceiling = parts.SurfaceMaterial(Color(0.8));
  const std::uint32_t wall = parts.SurfaceMaterial({ 0.7, 0.68, 0.6 });
  const std::uint32_t column = parts.SolidMaterial({ 0.65, 0.6, 0.6 });
  const std::vector<Vec2> outline{ Vec2(0.0, 0.0), Vec2(12.0, 0.0), Vec2(12.0, 4.0),
    Vec2(12.0, 12.0), Vec2(8.0, 12.0), Vec2(8.0, 4.0), Vec2(0.0, 4.0) };
  for (std::size_t k = 0; k < outline.size(); ++k)
  {
    parts.AddWall(outline[k], outline[(k + 1) % outline.size()], Height, wall);
  }
  parts.AddFloor(Vec2(0.0), Vec2(12.0, 4.0), 0.0, floor);
  parts.AddFloor(Vec2(8.0, 4.0), Vec2(12.0, 12.0), 0.0, floor);
  parts.AddCeiling(Vec2(0.0), Vec2(12.0, 4.0), Height, ceiling);
  parts.AddCeiling(Vec2(8.0, 4.0), Vec2(12.0, 12.0), Height, ceiling);
  for (int k = 0; k < 4; ++k)
  {
    const double at = 1.5 + 2.0 * k;
    for (const double across : { 0.9, 3.1 })
    {
      parts.AddBlock(Vec3(at, across, 0.0), Vec2(0.4), 0.0, Height, column, false);
      parts.AddBlock(Vec3(8.0 + across, at + 4.0, 0.0), Vec2(0.4), 0.0, Height, column, false);
    }
  }
  const std::uint32_t weak = parts.LampMaterial({ 12.0, 11.0, 9.0 });
  const std::uint32_t strong = parts.LampMaterial({ 80.0, 75.0, 65.0 });
  parts.AddDownward(Vec3(4.5, 2.0, Height - 0.05), Vec2(0.5), weak);
  parts.AddDownward(Vec3(10.0, 6.5, Height - 0.05), Vec2(0.5), strong);
  parts.AddDownward(Vec3(10.0, 9.5, Height - 0.05), Vec2(0.5), strong);
  parts.AddCamera("along", Vec3(0.3, 1.6, 1.7), Vec3(12.0, 2.6, 1.3));
  return parts.scene;
}

Scene MakeUnequalLamps()
{
  SceneParts parts = LightRoom();
  parts.AddTable(Vec2(3.2, 2.2), Vec2(1.4, 0.8), 0.75, parts.SolidMaterial({ 0.6, 0.45, 0.3 }));
  parts.AddBlock(
    Vec3(2.9, 2.1, 0.75), Vec2(0.15, 0.1), 0.5, 0.3, parts.SolidMaterial({ 0.3, 0.5, 0.4 }));
  parts.AddBlock(
    Vec3(4.2, 0.8, 0.0), Vec2(0.8, 0.6), 0.3, 1.1, parts.SolidMaterial({ 0.4, 0.45, 0.55 }));
  parts.AddDownward(Vec3(3.2, 2.3, 1.35), Vec2(0.01), parts.LampMaterial(Color(60000.0)));
  parts.AddDownward(Vec3(2.5, 2.0, 2.95), Vec2(3.0), parts.LampMaterial(Color(2.0)));
  parts.AddCamera("inside", Vec3(0.4, 0.5, 1.6), Vec3(4.0, 2.5, 0.7));
  return parts.scene;
}

Scene MakeRoundBodies()
{
  SceneParts parts = LightRoom();
  AddBall(parts.scene, Vec3(3.4, 2.4, 0.6), 0.6, 32, parts.SurfaceMaterial(Color(0.7)));
  AddBall(parts.scene, Vec3(2.3, 1.3, 0.4), 0.4, 24, parts.SurfaceMaterial({ 0.7, 0.2, 0.1 }));
  AddBall(parts.scene, Vec3(2.0, 3.0, 2.2), 0.15, 6, parts.LampMaterial(Color(20.0)));
  parts.AddDownward(Vec3(3.5, 1.5, 2.95), Vec2(0.8), parts.LampMaterial(Color(6.0)));
  // Half a tube around the larger ball, open at both ends.
  constexpr int Strips = 40;
  const std::uint32_t screen = parts.SurfaceMaterial({ 0.3, 0.5, 0.6 });
  const auto foot = [](int strip)
  {
    const double angle = Pi * (static_cast<double>(strip) / Strips - 0.25);
    return Vec3(3.4 + std::cos(angle), 2.4 + std::sin(angle), 0.3);
  };
  for (int strip = 0; strip < Strips; ++strip)
  {
    const Vec3 height(0.0, 0.0, 0.3);
    for (int k = 0; k < 4; ++k)
    {
      const Vec3 low = static_cast<double>(k) * height;
      parts.scene.AddPolygon({ foot(strip) + low, foot(strip + 1) + low,
                               foot(strip + 1) + low + height, foot(strip) + low + height },
        screen);
    }
  }
  parts.AddCamera("inside", Vec3(0.4, 0.5, 1.6), Vec3(3.4, 2.4, 0.6));
  return parts.scene;
}

/// Lamps as modellers make them, of many facets: globes, round panels and a tube.
Scene MakeLuminaires()
{
  SceneParts parts = LightRoom();
  parts.AddTable(Vec2(3.2, 2.2), Vec2(1.4, 0.8), 0.75, parts.SolidMaterial({ 0.6, 0.45, 0.3 }));
  parts.AddBlock(
    Vec3(4.2, 0.8, 0.0), Vec2(0.8, 0.6), 0.3, 1.1, parts.SolidMaterial({ 0.4, 0.45, 0.55 }));
  const std::uint32_t globe = parts.LampMaterial({ 12.0, 11.0, 9.0 });
  for (int i = 0; i < 4; ++i)
  {
    AddBall(parts.scene, Vec3(2.75 + 0.3 * i, 2.2, 1.9), 0.08, 8, globe);
  }
  const auto circle = [](int k, int corners)
  {
    const double angle = 2.0 * Pi * (k % corners) / corners;
    return Vec2(std::cos(angle), std::sin(angle));
  };
  constexpr int Corners = 24;
  const std::uint32_t panel = parts.LampMaterial(Color(14.0));
  for (const Vec3& centre : { Vec3(0.8, 0.8, 2.95), Vec3(0.8, 3.2, 2.95), Vec3(4.2, 3.2, 2.95) })
  {
    for (int k = 0; k < Corners; ++k)
    {
      parts.scene.AddPolygon({ centre, centre + Vec3(0.15 * circle(k + 1, Corners), 0.0),
                               centre + Vec3(0.15 * circle(k, Corners), 0.0) },
        panel);
    }
  }
  constexpr int Strips = 16;
  const std::uint32_t tube = parts.LampMaterial({ 8.0, 9.0, 10.0 });
  const auto at = [&](int strip, double x)
  {
    const Vec2 across = 0.02 * circle(strip, Strips);
    return Vec3(x, 3.9 + across.x, 2.4 + across.y);
  };
  for (int k = 0; k < Strips; ++k)
  {
    parts.scene.AddPolygon({ at(k, 1.5), at(k, 3.0), at(k + 1, 3.0), at(k + 1, 1.5) }, tube);
    parts.scene.AddPolygon({ at(k, 1.5), at(k + 1, 1.5), Vec3(1.5, 3.9, 2.4) }, tube);
    parts.scene.AddPolygon({ at(k, 3.0), Vec3(3.0, 3.9, 2.4), at(k + 1, 3.0) }, tube);
  }
  parts.AddCamera("inside", Vec3(0.4, 0.5, 1.6), Vec3(4.0, 2.5, 0.9));
  return parts.scene;
}

Scene MakeLampHall()
{
  constexpr int LampsAlong = 20;
  constexpr int LampsAcross = 10;
  const Vec3 size(30.0, 20.0, 4.0);
  SceneParts parts;
  const std::uint32_t wall = parts.SurfaceMaterial({ 0.65, 0.65, 0.6 });
  parts.AddRoom(Vec3(0.0), size, parts.SurfaceMaterial({ 0.4, 0.38, 0.35 }),
    parts.SurfaceMaterial(Color(0.75)), wall);
  RandomStream random(200);
  const std::uint32_t screen = parts.SurfaceMaterial({ 0.5, 0.6, 0.55 });
  const std::uint32_t block = parts.SolidMaterial({ 0.6, 0.5, 0.4 });
  for (int k = 0; k < 6; ++k)
  {
    const Vec2 foot(5.0 + 4.0 * k, Between(4.0, 12.0, random));
    parts.AddWall(foot, foot + Vec2(Between(-1.0, 1.0, random), 4.0), 2.4, screen);
    const Vec3 blockFoot(7.0 + 4.0 * k, Between(3.0, 17.0, random), 0.0);
    const double turn = Pi * random.Next();
    parts.AddBlock(blockFoot, Vec2(0.9), turn, Between(0.6, 1.6, random), block);
  }
  for (int lamp = 0; lamp < LampsAlong * LampsAcross; ++lamp)
  {
    const int row = lamp / LampsAlong;
    const Vec2 centre =
      (Vec2(lamp % LampsAlong, row) + 0.5) * Vec2(size) / Vec2(LampsAlong, LampsAcross);
    const double strength = LogBetween(1.0, 100.0, random);
    const std::uint32_t material = parts.LampMaterial(strength * ColorBetween(0.6, 1.0, random));
    parts.AddDownward(Vec3(centre, size.z - 0.1), Vec2(0.3), material);
  }
  parts.AddCamera("inside", Vec3(1.0, 1.5, 1.7), Vec3(20.0, 12.0, 1.0));
  return parts.scene;
}

std::vector<std::string> StudySceneNames()
{
  std::vector<std::string> names;
  for (const Entry& entry : Entries())
  {
    names.push_back(entry.name);
  }
  return names;
}

StudyScene MakeStudyScene(const std::string& name)
{
  for (const Entry& entry : Entries())
  {
    if (entry.name == name)
    {
      return entry.make();
    }
  }
  if (const auto seed = RoomSeed(name))
  {
    ReferenceSettings reference;
    reference.size = 32;
    reference.gatherRays /= 2;
    reference.mapCells /= 4;
    return { name, MakeRandomRoom(*seed), "inside", reference };
  }
  const std::vector<std::string> names = StudySceneNames();
  throw UnknownNameError("scene", name,
    std::accumulate(names.begin(), names.end(), std::string("room-N"),
      [](const std::string& list, const std::string& next) { return list + ", " + next; }));
}

} // namespace vantage::test
