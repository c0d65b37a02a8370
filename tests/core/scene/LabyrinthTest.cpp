#include "core/scene/Labyrinth.h"
#include "core/Error.h"
#include "core/math/Sampling.h"
#include "core/mesh/Facets.h"
#include "core/visibility/OccluderScene.h"

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <set>

namespace vantage
{
namespace
{

constexpr double RoomSize = 4.0;
constexpr double RoomHeight = 2.8;
constexpr double DoorHeight = 2.1;

std::vector<Vec3> PointsOf(const Scene& scene, std::size_t polygon)
{
  std::vector<Vec3> points;
  for (std::uint32_t i = scene.offsets[polygon]; i < scene.offsets[polygon + 1]; ++i)
  {
    points.push_back(scene.vertices[scene.indices[i]]);
  }
  return points;
}

Polygon ShapeOf(const Scene& scene, std::size_t polygon)
{
  Polygon shape;
  for (const Vec3& p : PointsOf(scene, polygon))
  {
    shape.Add(p);
  }
  return shape;
}

const std::string& MaterialOf(const Scene& scene, std::size_t polygon)
{
  return scene.materials[scene.materialOfPolygon[polygon]].name;
}

std::size_t CountOf(const Scene& scene, const std::string& material)
{
  std::size_t count = 0;
  for (std::size_t p = 0; p < scene.PolygonCount(); ++p)
  {
    count += MaterialOf(scene, p) == material ? 1 : 0;
  }
  return count;
}

LabyrinthSettings WithSeed(std::uint64_t seed)
{
  LabyrinthSettings settings;
  settings.seed = seed;
  return settings;
}

TEST(Labyrinth, HasAsManyPatchesAsThePapersForEverySeed)
{
  for (std::uint64_t seed = 1; seed <= 20; ++seed)
  {
    SCOPED_TRACE("seed " + std::to_string(seed));
    const Scene scene = MakeLabyrinth(WithSeed(seed));
    EXPECT_EQ(scene.PolygonCount(), 378u);
    EXPECT_EQ(CountOf(scene, "lamp"), 18u);
    EXPECT_EQ(CountOf(scene, "floor"), 20u);
    EXPECT_NO_THROW(scene.Validate());
  }
}

TEST(Labyrinth, DependsOnTheSeedAlone)
{
  const Scene scene = MakeLabyrinth(WithSeed(7));
  EXPECT_EQ(scene.vertices, MakeLabyrinth(WithSeed(7)).vertices);
  EXPECT_EQ(scene.materialOfPolygon, MakeLabyrinth(WithSeed(7)).materialOfPolygon);
  EXPECT_NE(scene.vertices, MakeLabyrinth(WithSeed(8)).vertices);
}

TEST(Labyrinth, IsTheSameOnAllMachines)
{
  // A hash of the coordinates in millimetres, made once: a change of it changes every figure that
  // was measured on this scene.
  const Scene scene = MakeLabyrinth();
  std::uint64_t hash = 0;
  for (const Vec3& v : scene.vertices)
  {
    for (int k = 0; k < 3; ++k)
    {
      EXPECT_EQ(v[k], std::round(v[k] * 1000.0) / 1000.0);
      hash = Hash(hash, static_cast<std::uint64_t>(std::lround(v[k] * 1000.0)));
    }
  }
  EXPECT_EQ(hash, 141961152391621136u);
}

TEST(Labyrinth, NeedsNoMending)
{
  for (std::uint64_t seed = 1; seed <= 10; ++seed)
  {
    SCOPED_TRACE("seed " + std::to_string(seed));
    const Scene scene = MakeLabyrinth(WithSeed(seed));
    const FacetSet facets = BuildFacets(scene);
    EXPECT_EQ(facets.facets.size(), scene.PolygonCount());
    EXPECT_EQ(facets.report.weldedVertices, 0u);
    EXPECT_EQ(facets.report.nonPlanarPolygons, 0u);
    EXPECT_EQ(facets.report.duplicateFacets, 0u);
  }
}

/// Area that two coplanar polygons share; 0 when they are not coplanar.
double SharedArea(const Polygon& a, const Polygon& b)
{
  const Vec3 normal = UnitNormal(b);
  constexpr double Tolerance = 1e-6; // far below a millimetre, far above round-off
  for (const Vec3& v : a)
  {
    if (std::abs(glm::dot(v - b[0], normal)) > Tolerance)
    {
      return 0.0;
    }
  }
  Polygon rest = a;
  for (int k = 0; k < b.Size(); ++k)
  {
    const Vec3 inward = glm::cross(normal, b[(k + 1) % b.Size()] - b[k]);
    const Vec3 unit = glm::normalize(inward);
    rest = ClipToFront(rest, { unit, glm::dot(unit, b[k]) });
  }
  return rest.Empty() ? 0.0 : Area(rest);
}

TEST(Labyrinth, NoTwoFacesCoincide)
{
  for (std::uint64_t seed = 1; seed <= 5; ++seed)
  {
    const Scene scene = MakeLabyrinth(WithSeed(seed));
    for (std::size_t p = 0; p < scene.PolygonCount(); ++p)
    {
      for (std::size_t q = p + 1; q < scene.PolygonCount(); ++q)
      {
        // Neighbours share edges; round-off makes slivers of them.
        EXPECT_LT(SharedArea(ShapeOf(scene, p), ShapeOf(scene, q)), 1e-9)
          << "seed " << seed << ", polygons " << p << " and " << q;
      }
    }
  }
}

TEST(Labyrinth, RoomsAreClosed)
{
  for (std::uint64_t seed = 1; seed <= 3; ++seed)
  {
    SCOPED_TRACE("seed " + std::to_string(seed));
    const Scene scene = MakeLabyrinth(WithSeed(seed));
    const FacetSet facets = BuildFacets(scene);
    const OccluderScene occluders(facets);
    RandomStream random(seed);
    // From under every lamp and beside it: at random, then at the corners of everything, where a
    // gap would be.
    for (int room = 0; room < 20; ++room)
    {
      const Vec3 eye(RoomSize * (room % 5) + 2.0, RoomSize * (room / 5) + 2.0, 2.5);
      for (int ray = 0; ray < 2000; ++ray)
      {
        const Vec3 direction(random.Next() - 0.5, random.Next() - 0.5, random.Next() - 0.5);
        EXPECT_TRUE(occluders.Intersect(eye, direction));
      }
      for (const Vec3& corner : scene.vertices)
      {
        const auto hit = occluders.Intersect(eye, corner - eye);
        ASSERT_TRUE(hit);
        // At most as far as the corner, but for single precision; a ray past the edge of furniture
        // goes on to the shell, one past a corner of the shell must not.
        const bool isShell = corner.z == 0.0 || corner.z == RoomHeight;
        EXPECT_LE(hit->distance, isShell ? 1.0 + 1e-4 : 1e3);
      }
    }
  }
}

TEST(Labyrinth, EveryRoomCanBeReached)
{
  for (const double extraDoors : { 0.0, 1.0 })
  {
    LabyrinthSettings settings;
    settings.rows = 6;
    settings.columns = 7;
    settings.extraDoors = extraDoors;
    const Scene scene = MakeLabyrinth(settings);
    // A lintel tells of a doorway; a step to both sides of its middle, of the rooms it joins.
    std::vector<std::pair<int, int>> doors;
    for (std::size_t p = 0; p < scene.PolygonCount(); ++p)
    {
      const Polygon shape = ShapeOf(scene, p);
      const auto isAbove = [](const Vec3& v) { return v.z >= DoorHeight; };
      if (MaterialOf(scene, p).substr(0, 4) == "wall" &&
          std::all_of(shape.begin(), shape.end(), isAbove))
      {
        const auto room = [&](double step)
        {
          const Vec3 x = Centroid(shape) + step * UnitNormal(shape);
          return static_cast<int>(x.y / RoomSize) * 7 + static_cast<int>(x.x / RoomSize);
        };
        doors.emplace_back(room(0.1), room(-0.1));
      }
    }
    // A tree has one door less than rooms; all doors of a 6 x 7 grid are 6 * 6 + 5 * 7.
    EXPECT_EQ(doors.size(), extraDoors == 0.0 ? 41u : 71u);
    std::set<int> reached = { 0 };
    for (std::size_t round = 0; round < 42; ++round)
    {
      for (const auto& [a, b] : doors)
      {
        if (reached.count(a) + reached.count(b) == 1)
        {
          reached.insert({ a, b });
        }
      }
    }
    EXPECT_EQ(reached.size(), 42u);
  }
}

TEST(Labyrinth, ViewsLookPastFurnitureThroughADoorway)
{
  for (std::uint64_t seed = 1; seed <= 10; ++seed)
  {
    SCOPED_TRACE("seed " + std::to_string(seed));
    const Scene scene = MakeLabyrinth(WithSeed(seed));
    const FacetSet facets = BuildFacets(scene);
    const OccluderScene occluders(facets);
    for (const char* name : { "view1", "view2" })
    {
      const Camera& camera = scene.FindCamera(name);
      const ImagePlane plane(camera);
      const auto centre = occluders.Intersect(plane.eye, camera.lookAt - camera.eye);
      ASSERT_TRUE(centre);
      EXPECT_GT(centre->distance, 1.0) << name << " does not see the doorway";
      int furniture = 0;
      constexpr int Size = 60;
      for (int ray = 0; ray < Size * Size; ++ray)
      {
        const double s = 2.0 * (ray % Size + 0.5) / Size - 1.0;
        const double t = 2.0 * (ray / Size + 0.5) / Size - 1.0;
        const auto hit = occluders.Intersect(plane.eye, plane.Direction(s, t));
        ASSERT_TRUE(hit);
        const std::string& material = MaterialOf(scene, facets.facets[hit->facet].scenePolygon);
        furniture += material.substr(0, 5) == "table" && hit->distance < 4.0 ? 1 : 0;
      }
      EXPECT_GT(furniture, Size * Size / 100) << name << " does not see a table";
    }
    const Vec3 apart = scene.FindCamera("view1").eye - scene.FindCamera("view2").eye;
    EXPECT_GT(glm::length(apart), 16.0);
  }
}

TEST(Labyrinth, GrowsWithTheNumberOfRooms)
{
  LabyrinthSettings settings;
  settings.rows = 100;
  settings.columns = 100;
  const Scene scene = MakeLabyrinth(settings);
  EXPECT_EQ(CountOf(scene, "floor"), 10000u);
  EXPECT_NEAR(static_cast<double>(scene.PolygonCount()) / 10000.0, 19.0, 1.0);
  for (const int size : { 1, 2 })
  {
    settings.rows = 1;
    settings.columns = size;
    EXPECT_NO_THROW(MakeLabyrinth(settings).Validate());
  }
}

TEST(Labyrinth, RefusesImpossibleSettings)
{
  LabyrinthSettings settings;
  settings.rows = 0;
  EXPECT_THROW(MakeLabyrinth(settings), InputError);
  settings = {};
  settings.extraDoors = 1.5;
  EXPECT_THROW(MakeLabyrinth(settings), InputError);
  settings = {};
  settings.lampRadiance = std::nan("");
  EXPECT_THROW(MakeLabyrinth(settings), InputError);
}

TEST(Labyrinth, AlbedosArePlausible)
{
  for (const Material& material : MakeLabyrinth().materials)
  {
    for (int k = 0; k < 3; ++k)
    {
      EXPECT_GE(material.albedo[k], 0.3) << material.name;
      EXPECT_LE(material.albedo[k], 0.8) << material.name;
    }
  }
}

} // namespace
} // namespace vantage
