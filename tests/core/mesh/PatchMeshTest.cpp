#include "core/mesh/PatchMesh.h"

#include "core/mesh/DisjointSets.h"
#include "core/mesh/MeshScenes.h"

#include <gtest/gtest.h>

#include <set>

namespace vantage
{
namespace
{

using test::AddQuad;
using test::AddRoom;
using test::Named;

/// Everything that the mesh is made of.
struct Meshed
{
  FacetSet facets;
  ElementTree tree;
  PatchMesh mesh;

  explicit Meshed(const Scene& scene)
    : facets(BuildFacets(scene))
    , tree(this->facets, scene.materials)
    , mesh(this->tree, this->facets)
  {
  }

  void SplitAtRandom(int count, RandomStream& random)
  {
    test::SplitAtRandom(this->tree, count, random);
    this->mesh.Follow(this->tree);
  }

  /// V - E + F.
  long EulerCharacteristic() const
  {
    return static_cast<long>(this->mesh.VertexCount()) - static_cast<long>(this->mesh.EdgeCount()) +
           static_cast<long>(this->mesh.FaceCount());
  }
};

Polygon PolygonOf(const ElementSurface& surface, std::size_t p)
{
  Polygon polygon;
  for (std::uint32_t i = surface.offsets[p]; i < surface.offsets[p + 1]; ++i)
  {
    polygon.Add(surface.points[surface.indices[i]]);
  }
  return polygon;
}

double AreaOf(const ElementSurface& surface, std::size_t p)
{
  Vec3 sum(0.0);
  const Vec3& origin = surface.points[surface.indices[surface.offsets[p]]];
  for (std::uint32_t i = surface.offsets[p] + 2; i < surface.offsets[p + 1]; ++i)
  {
    sum += glm::cross(
      surface.points[surface.indices[i - 1]] - origin, surface.points[surface.indices[i]] - origin);
  }
  return 0.5 * glm::length(sum);
}

/// Each leaf once, in order, from its corner 0 on, with its own area.
void ExpectLeaves(const ElementTree& tree, const ElementSurface& surface)
{
  ASSERT_EQ(surface.PolygonCount(), tree.LeafElementCount());
  ASSERT_EQ(surface.offsets.size(), surface.PolygonCount() + 1);
  for (std::size_t p = 0; p < surface.PolygonCount(); ++p)
  {
    const Node& node = tree[surface.elements[p]];
    ASSERT_TRUE(node.IsLeaf() && !node.IsCluster());
    ASSERT_TRUE(p == 0 || surface.elements[p - 1] < surface.elements[p]);
    ASSERT_EQ(surface.points[surface.indices[surface.offsets[p]]], node.corners[0]);
    ASSERT_NEAR(AreaOf(surface, p), node.area, 1e-12 * node.area); // round-off
  }
}

/// Which connected part of the surface each point belongs to.
std::vector<std::uint32_t> PartOfPoint(const ElementSurface& surface)
{
  DisjointSets parts(surface.points.size());
  for (std::size_t p = 0; p < surface.PolygonCount(); ++p)
  {
    for (std::uint32_t i = surface.offsets[p] + 1; i < surface.offsets[p + 1]; ++i)
    {
      parts.Join(surface.indices[i - 1], surface.indices[i]);
    }
  }
  std::vector<std::uint32_t> result;
  for (std::uint32_t i = 0; i < surface.points.size(); ++i)
  {
    result.push_back(parts.Find(i));
  }
  return result;
}

bool IsInsideSegment(const Vec3& x, const Vec3& a, const Vec3& b)
{
  const double t = glm::dot(x - a, b - a) / glm::dot(b - a, b - a);
  return t > 1e-9 && t < 1.0 - 1e-9 && glm::length(x - (a + t * (b - a))) < 1e-9;
}

/// No point of a part lies within an edge of that part without being one of its ends.
void ExpectNoTVertices(const ElementSurface& surface)
{
  const std::vector<std::uint32_t> part = PartOfPoint(surface);
  for (std::size_t p = 0; p < surface.PolygonCount(); ++p)
  {
    const std::uint32_t first = surface.offsets[p];
    const std::uint32_t n = surface.offsets[p + 1] - first;
    for (std::uint32_t i = 0; i < n; ++i)
    {
      const std::uint32_t from = surface.indices[first + i];
      const std::uint32_t to = surface.indices[first + (i + 1) % n];
      for (std::uint32_t x = 0; x < surface.points.size(); ++x)
      {
        ASSERT_FALSE(part[x] == part[from] &&
                     IsInsideSegment(surface.points[x], surface.points[from], surface.points[to]));
      }
    }
  }
}

/// A scene and the Euler characteristic of its mesh: 2 for each shell of a union of thickened
/// walls that encloses a piece of air without handles.
struct Case
{
  const char* name;
  Scene scene;
  long characteristic;
  std::size_t boundaryEdges;
  /// A wall that ends inside a floor: the floor is one part around its end, yet not joined below
  /// it.
  bool hasSlit = false;
};

Scene LoneTable(bool twoSided = true)
{
  Scene scene;
  scene.materials.push_back(Named("table", twoSided));
  AddQuad(scene, { 0, 0, 0 }, { 2, 0, 0 }, { 0, 1, 0 });
  return scene;
}

/// A door of no thickness, two polygons back to back, in a wall of three parts.
Scene RoomsWithDoor()
{
  Scene scene = test::RoomGrid(2, 1);
  scene.materials.push_back(Named("door", false));
  const auto isWallBetween = [&](std::size_t p)
  {
    for (std::uint32_t i = scene.offsets[p]; i < scene.offsets[p + 1]; ++i)
    {
      if (scene.vertices[scene.indices[i]].x != 1.0)
      {
        return false;
      }
    }
    return true;
  };
  Scene result;
  result.materials = scene.materials;
  for (std::size_t p = 0; p < scene.PolygonCount(); ++p)
  {
    if (!isWallBetween(p))
    {
      std::vector<Vec3> corners;
      for (std::uint32_t i = scene.offsets[p]; i < scene.offsets[p + 1]; ++i)
      {
        corners.push_back(scene.vertices[scene.indices[i]]);
      }
      result.AddPolygon(corners, 0);
    }
  }
  AddQuad(result, { 1, 0, 0 }, { 0, 0.4, 0 }, { 0, 0, 1 });
  AddQuad(result, { 1, 0.6, 0 }, { 0, 0.4, 0 }, { 0, 0, 1 });
  AddQuad(result, { 1, 0.4, 0.0 }, { 0, 0.2, 0 }, { 0, 0, 1 }, 1);
  AddQuad(result, { 1, 0.4, 0.0 }, { 0, 0, 1 }, { 0, 0.2, 0 }, 1);
  return result;
}

Scene Tetrahedron()
{
  Scene scene;
  scene.materials.push_back(Named("face", false));
  const Vec3 a(0, 0, 0);
  const Vec3 b(1, 0, 0);
  const Vec3 c(0, 1, 0);
  const Vec3 d(0, 0, 1);
  scene.AddPolygon({ a, c, b }, 0);
  scene.AddPolygon({ a, b, d }, 0);
  scene.AddPolygon({ b, c, d }, 0);
  scene.AddPolygon({ c, a, d }, 0);
  return scene;
}

std::vector<Case> Cases()
{
  return {
    { "inside of a room", test::OneRoom(false), 2, 0 },
    { "room, both sides", test::OneRoom(), 4, 0 },
    { "tetrahedron of triangles", Tetrahedron(), 2, 0 },
    { "two rooms share a wall", test::RoomGrid(2, 1), 6, 0 },
    { "nine rooms, four walls at an edge", test::RoomGrid(3, 3), 20, 0 },
    { "lone table", LoneTable(), 2, 0 },
    { "lone one-sided table", LoneTable(false), 1, 4 },
    { "wall standing free on a floor", test::FloorWithFin(), 2, 0, true },
  };
}

TEST(PatchMesh, IsManifoldAndStaysSoWhileItIsSplit)
{
  for (const Case& c : Cases())
  {
    SCOPED_TRACE(c.name);
    for (std::uint64_t seed = 0; seed < 5; ++seed)
    {
      SCOPED_TRACE(seed);
      RandomStream random(seed);
      Meshed m(c.scene);
      EXPECT_EQ(m.EulerCharacteristic(), c.characteristic);
      EXPECT_EQ(m.mesh.BoundaryEdgeCount(), c.boundaryEdges);
      EXPECT_EQ(m.mesh.FaceCount(), m.tree.LeafElementCount());
      m.SplitAtRandom(20, random);
      m.SplitAtRandom(60, random);
      EXPECT_EQ(m.EulerCharacteristic(), c.characteristic);
      EXPECT_EQ(m.mesh.BoundaryEdgeCount() == 0, c.boundaryEdges == 0);
      EXPECT_EQ(m.mesh.FaceCount(), m.tree.LeafElementCount());
      const ElementSurface surface = m.mesh.Surface();
      ExpectLeaves(m.tree, surface);
      if (!c.hasSlit)
      {
        ExpectNoTVertices(surface);
      }
    }
  }
}

TEST(PatchMesh, SurvivesWhatPeopleModel)
{
  std::vector<Scene> scenes{ RoomsWithDoor() };
  RandomStream random(4);
  Scene mess = test::RoomGrid(2, 2);
  mess.materials.push_back(Named("one-sided", false));
  AddRoom(mess, { 0.5, 0.5, 0.25 }, { 1, 1, 0.5 }, 1);         // cuts through walls
  AddQuad(mess, { 0, 0, 0 }, { 2, 0, 0 }, { 0, 1, 0 }, 1);     // lies on two floors
  AddQuad(mess, { 1, 0, 0 }, { 0, 1, 0 }, { 0.5, 0, 0.5 }, 1); // five facets at an edge
  for (int i = 0; i < 20; ++i)
  {
    mess.AddPolygon(test::RandomStar(random, 3 + i, 0.3), i % 2);
  }
  scenes.push_back(mess);
  for (const Scene& scene : scenes)
  {
    Meshed m(scene);
    m.SplitAtRandom(200, random);
    ExpectLeaves(m.tree, m.mesh.Surface());
    ExpectNoTVertices(m.mesh.Surface());
  }
}

TEST(PatchMesh, FollowingAndBuildingAnewGiveTheSame)
{
  RandomStream random(2);
  Meshed m(test::RoomGrid(2, 2));
  for (int round = 0; round < 10; ++round)
  {
    m.SplitAtRandom(10, random);
  }
  const ElementSurface followed = m.mesh.Surface();
  const ElementSurface anew = PatchMesh(m.tree, m.facets).Surface();
  EXPECT_EQ(followed.points, anew.points);
  EXPECT_EQ(followed.indices, anew.indices);
  EXPECT_EQ(followed.offsets, anew.offsets);
  EXPECT_EQ(followed.elements, anew.elements);
}

TEST(PatchMesh, NeighbourTakesTheMidpointOfASplitEdge)
{
  Scene scene;
  scene.materials.push_back(Named("floor", false));
  AddQuad(scene, { 0, 0, 0 }, { 1, 0, 0 }, { 0, 1, 0 });
  AddQuad(scene, { 1, 0, 0 }, { 1, 0, 0 }, { 0, 1, 0 });
  Meshed m(scene);
  m.tree.Split(m.tree.Patches()[PatchOf(0, Side::Front)].node);
  m.mesh.Follow(m.tree);
  const ElementSurface surface = m.mesh.Surface();
  ASSERT_EQ(surface.PolygonCount(), 5u);
  EXPECT_EQ(surface.points.size(), 11u);
  const NodeId neighbour = m.tree.Patches()[PatchOf(1, Side::Front)].node;
  for (std::size_t p = 0; p < surface.PolygonCount(); ++p)
  {
    const Polygon polygon = PolygonOf(surface, p);
    EXPECT_EQ(polygon.Size(), surface.elements[p] == neighbour ? 5 : 4);
    if (surface.elements[p] == neighbour)
    {
      EXPECT_NE(std::find(polygon.begin(), polygon.end(), Vec3(1, 0.5, 0)), polygon.end());
    }
  }
  // When the neighbour is split in turn, it uses that vertex.
  m.tree.Split(neighbour);
  m.mesh.Follow(m.tree);
  EXPECT_EQ(m.mesh.VertexCount(), 15u);
  EXPECT_EQ(m.mesh.Surface().points.size(), 15u);
}

/// Number of surface points at two unit squares, the second turned about their common edge.
std::size_t PointsOfPair(double degrees, std::uint32_t material, bool isReversed)
{
  Scene scene;
  scene.materials = { Named("a"), Named("b") };
  const double angle = degrees * Pi / 180.0;
  const Vec3 u(std::cos(angle), 0, std::sin(angle));
  AddQuad(scene, { 0, 0, 0 }, { 1, 0, 0 }, { 0, 1, 0 });
  if (isReversed)
  {
    AddQuad(scene, { 1, 0, 0 }, { 0, 1, 0 }, u, material);
  }
  else
  {
    AddQuad(scene, { 1, 0, 0 }, u, { 0, 1, 0 }, material);
  }
  return Meshed(scene).mesh.Surface().points.size();
}

TEST(PatchMesh, SurfaceIsCutWhereRadianceJumps)
{
  // Both sides: 2 x 6 points where joined, 2 x 8 where cut.
  EXPECT_EQ(PointsOfPair(0.0, 0, false), 12u);
  EXPECT_EQ(PointsOfPair(4.0, 0, false), 12u);
  EXPECT_EQ(PointsOfPair(-4.0, 0, false), 12u);
  EXPECT_EQ(PointsOfPair(6.0, 0, false), 16u);
  EXPECT_EQ(PointsOfPair(90.0, 0, false), 16u);
  EXPECT_EQ(PointsOfPair(0.0, 1, false), 16u);
  EXPECT_EQ(PointsOfPair(0.0, 0, true), 16u);
}

TEST(PatchMesh, WallBetweenTwoFloorsPartsThem)
{
  Scene scene;
  scene.materials.push_back(Named("floor"));
  AddQuad(scene, { 0, 0, 0 }, { 1, 0, 0 }, { 0, 1, 0 });
  AddQuad(scene, { 1, 0, 0 }, { 1, 0, 0 }, { 0, 1, 0 });
  AddQuad(scene, { 1, 0, 0 }, { 0, 1, 0 }, { 0, 0, 1 });
  // Above, two floors and two sides of the wall, 4 points each; below, one floor of 6 points.
  EXPECT_EQ(Meshed(scene).mesh.Surface().points.size(), 22u);
}

TEST(PointValues, KeepConstants)
{
  RandomStream random(5);
  Meshed m(test::RoomGrid(2, 1));
  m.SplitAtRandom(100, random);
  const ElementSurface surface = m.mesh.Surface();
  const Color constant(0.25, 3.0, 7.5);
  for (const Color& value :
    PointValues(surface, std::vector<Color>(surface.PolygonCount(), constant)))
  {
    EXPECT_LE(glm::length(value - constant), 1e-14); // round-off of a mean of a few numbers
  }
}

TEST(PointValues, WeighByTheAngleOfTheCorner)
{
  // A polygon with a hanging point in its first edge, and two squares beside it: angles pi and
  // twice pi / 2.
  ElementSurface surface;
  surface.points = { { 0, 0, 0 }, { 1, 0, 0 }, { 2, 0, 0 }, { 2, 2, 0 }, { 0, 2, 0 }, { 0, -1, 0 },
    { 1, -1, 0 }, { 2, -1, 0 } };
  surface.indices = { 0, 1, 2, 3, 4, 5, 6, 1, 0, 6, 7, 2, 1 };
  surface.offsets = { 0, 5, 9, 13 };
  surface.elements = { 0, 1, 2 };
  const std::vector<Color> values =
    PointValues(surface, { Color(4.0, 1.0, 0.0), Color(2.0, 0.0, 0.0), Color(8.0, 0.0, 0.0) });
  // Round-off.
  EXPECT_LE(glm::length(values[1] - Color(4.5, 0.5, 0.0)), 1e-14);
  EXPECT_LE(glm::length(values[0] - Color(3.0, 0.5, 0.0)), 1e-14);
  EXPECT_LE(glm::length(values[3] - Color(4.0, 1.0, 0.0)), 1e-14);
  EXPECT_LE(glm::length(values[6] - Color(5.0, 0.0, 0.0)), 1e-14);
}

} // namespace
} // namespace vantage
