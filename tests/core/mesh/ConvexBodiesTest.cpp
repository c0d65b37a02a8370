#include "core/mesh/ConvexBodies.h"

#include "core/mesh/ContactCuts.h"
#include "core/mesh/MeshScenes.h"
#include "support/TestScenes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace vantage
{
namespace
{

/// A room with a lamp, to be furnished with material 0.
Scene LitRoom()
{
  Scene scene;
  scene.materials = { test::Named("body"), test::Named("lamp") };
  scene.materials[1].emission = Color(1.0);
  test::AddRoom(scene, { 0, 0, 0 }, { 4, 3, 2.5 }, 0);
  test::AddQuad(scene, { 1, 1, 2.4 }, { 0, 1, 0 }, { 1, 0, 0 }, 1);
  return scene;
}

void AddBody(Scene& scene, const Vec3& low, const Vec3& size)
{
  test::AddBox(scene, low, low + size, false, { 0, 0, 0, 0, 0, 0 });
}

struct Found
{
  FacetSet facets;
  DarkSides dark;
  ConvexBodies bodies;

  explicit Found(const Scene& scene)
    : facets(CutAtContacts(BuildFacets(scene)))
    , dark(FindDarkSides(this->facets, scene.materials))
    , bodies(this->facets, this->dark)
  {
  }

  /// Numbers of faces, ascending; 0 for a body that is not convex.
  std::vector<std::size_t> Faces() const
  {
    std::vector<std::size_t> faces;
    for (std::uint32_t body = 0; body < this->dark.bodies.size(); ++body)
    {
      faces.push_back(this->bodies.FacetsOf(body).size());
      EXPECT_EQ(this->bodies.Has(body), faces.back() > 0);
    }
    std::sort(faces.begin(), faces.end());
    return faces;
  }

  Polygon Shape(PatchId patch) const
  {
    const Polygon front(this->facets.facets[patch / 2].shape);
    return patch % 2 == 0 ? front : Reversed(front);
  }
};

using Counts = std::vector<std::size_t>;

TEST(ConvexBodies, AreBoxesAndBalls)
{
  Scene scene = LitRoom();
  AddBody(scene, { 0.5, 0.5, 0.1 }, { 0.4, 0.5, 0.6 });
  test::AddBall(scene, { 2.0, 1.5, 1.0 }, 0.4, 6, 0);
  EXPECT_EQ(Found(scene).Faces(), (Counts{ 6, 120 }));
}

TEST(ConvexBodies, HaveEachEdgeBetweenTheTwoSidesThatShareIt)
{
  const Vec3 centre(2.0, 1.5, 1.0);
  Scene scene = LitRoom();
  test::AddBall(scene, centre, 0.4, 4, 0);
  const Found found(scene);
  ASSERT_EQ(found.Faces(), Counts{ 48 });
  const auto facets = found.bodies.FacetsOf(0);
  const auto sides = found.bodies.SidesOf(0);
  const auto edges = found.bodies.EdgesOf(0);
  // Two rings of trapezoids between two of triangles.
  EXPECT_EQ(sides.size(), 32u);
  EXPECT_EQ(edges.size(), 56u);
  const auto planeOfSide = [&](std::uint32_t side)
  { return SupportingPlane(found.Shape(facets.begin()[sides.begin()[side]])); };
  for (const ConvexBodies::Edge& edge : edges)
  {
    const Polygon first = found.Shape(facets.begin()[edge.facet]);
    EXPECT_GT(glm::dot(UnitNormal(first), Centroid(first) - centre), 0.0);
    EXPECT_LT(glm::length(UnitNormal(first) - planeOfSide(edge.first).normal), 1e-9);
    const auto corner = static_cast<int>(edge.corner);
    const Vec3 from = first[corner];
    const Vec3 to = first[(corner + 1) % first.Size()];
    int shared = 0;
    for (const PatchId facet : facets)
    {
      const Polygon second = found.Shape(facet);
      for (int i = 0; i < second.Size(); ++i)
      {
        if (second[i] == to && second[(i + 1) % second.Size()] == from)
        {
          ++shared;
          EXPECT_LT(glm::length(UnitNormal(second) - planeOfSide(edge.second).normal), 1e-9);
        }
      }
    }
    EXPECT_EQ(shared, 1);
    EXPECT_LT(glm::dot(planeOfSide(edge.first).normal, planeOfSide(edge.second).normal), 0.99);
  }
}

TEST(ConvexBodies, AreNotHollowNorOpen)
{
  Scene scene = LitRoom();
  // An L of eight faces, its ends not convex.
  const std::vector<Vec2> plan{ { 1, 1 }, { 2, 1 }, { 2, 1.4 }, { 1.4, 1.4 }, { 1.4, 2 },
    { 1, 2 } };
  const auto at = [&](std::size_t k, double z) { return Vec3(plan[k % plan.size()], z); };
  std::vector<Vec3> bottom, top;
  for (std::size_t k = 0; k < plan.size(); ++k)
  {
    scene.AddPolygon({ at(k, 0.2), at(k + 1, 0.2), at(k + 1, 0.8), at(k, 0.8) }, 0);
    top.push_back(at(k, 0.8));
    bottom.insert(bottom.begin(), at(k, 0.2));
  }
  scene.AddPolygon(top, 0);
  scene.AddPolygon(bottom, 0);
  EXPECT_EQ(Found(scene).Faces(), Counts{ 0 });

  Scene open = LitRoom();
  AddBody(open, { 0.5, 0.5, 0.1 }, { 0.4, 0.5, 0.6 });
  open.indices.resize(open.indices.size() - 4); // without its last face
  open.offsets.pop_back();
  open.materialOfPolygon.pop_back();
  EXPECT_EQ(Found(open).Faces(), Counts{});
}

/// Coordinates of single precision: corners stand out of the planes of their neighbours.
TEST(ConvexBodies, MayBeRounded)
{
  Scene scene = LitRoom();
  test::AddBall(scene, { 2.1, 1.3, 1.1 }, 0.4, 8, 0);
  for (Vec3& vertex : scene.vertices)
  {
    vertex = Vec3(glm::vec3(vertex));
  }
  EXPECT_EQ(Found(scene).Faces(), Counts{ 224 });
}

/// A turned box of triangles in single precision: two of them that make up one of its sides may
/// be seen on one side of an edge that is not there.
TEST(ConvexBodies, HaveSidesOfSeveralFacets)
{
  Scene boxes;
  boxes.materials.resize(1);
  test::AddBox(boxes, { -0.4, -0.3, 0.2 }, { 0.4, 0.3, 1.1 }, false, { 0, 0, 0, 0, 0, 0 });
  for (int turn = 0; turn < 20; ++turn)
  {
    SCOPED_TRACE(turn);
    Scene scene = LitRoom();
    const double angle = 0.05 + 0.07 * turn;
    const auto at = [&](const Vec3& v)
    {
      return Vec3(glm::vec3(2.0 + std::cos(angle) * v.x - std::sin(angle) * v.y,
        1.5 + std::sin(angle) * v.x + std::cos(angle) * v.y, v.z));
    };
    for (std::size_t p = 0; p < boxes.PolygonCount(); ++p)
    {
      const std::vector<Vec3> c = test::CornersOf(boxes, p);
      scene.AddPolygon({ at(c[0]), at(c[1]), at(c[2]) }, 0);
      scene.AddPolygon({ at(c[0]), at(c[2]), at(c[3]) }, 0);
    }
    const Found found(scene);
    ASSERT_EQ(found.Faces(), Counts{ 12 });
    EXPECT_EQ(found.bodies.SidesOf(0).size(), 6u);
    EXPECT_EQ(found.bodies.EdgesOf(0).size(), 12u);
  }
}

TEST(ConvexBodies, ThatCarryALampInsideAreNone)
{
  Scene scene = LitRoom();
  AddBody(scene, { 0.5, 0.5, 0.1 }, { 0.4, 0.5, 0.6 });
  test::AddQuad(scene, { 0.6, 0.6, 0.3 }, { 0.1, 0, 0 }, { 0, 0.1, 0 }, 1);
  EXPECT_EQ(Found(scene).Faces(), Counts{});
}

} // namespace
} // namespace vantage
