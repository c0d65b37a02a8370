#include "core/mesh/DarkSides.h"

#include "core/mesh/ContactCuts.h"
#include "core/mesh/MeshScenes.h"
#include "support/TestScenes.h"

#include <gtest/gtest.h>

namespace vantage
{
namespace
{

constexpr std::uint32_t Wall = 0;
constexpr std::uint32_t Body = 1;
constexpr std::uint32_t Lamp = 2;

/// A room of 4 x 3 x 2.5 with a lamp of 1 x 1 under the ceiling.
Scene LitRoom()
{
  Scene scene;
  scene.materials = { test::Named("wall"), test::Named("body"), test::Named("lamp") };
  scene.materials[Lamp].emission = Color(1.0);
  test::AddRoom(scene, { 0, 0, 0 }, { 4, 3, 2.5 }, Wall);
  test::AddQuad(scene, { 1, 1, 2.4 }, { 0, 1, 0 }, { 1, 0, 0 }, Lamp);
  return scene;
}

/// A box with its fronts outside.
void AddBody(Scene& scene, const Vec3& low, const Vec3& size)
{
  test::AddBox(scene, low, low + size, false, { Body, Body, Body, Body, Body, Body });
}

struct Counted
{
  int walls = 0; ///< dark sides of facets with this material
  int bodies = 0;
  int lamps = 0;
};

Counted CountDark(const Scene& scene)
{
  const FacetSet facets = CutAtContacts(BuildFacets(scene));
  const DarkSides isDark = FindDarkSides(facets, scene.materials);
  Counted count;
  for (PatchId patch = 0; patch < isDark.bodyOf.size(); ++patch)
  {
    const std::uint32_t material = facets.facets[patch / 2].MaterialOf(SideOf(patch));
    int& counter = material == Wall ? count.walls : (material == Body ? count.bodies : count.lamps);
    counter += isDark[patch] ? 1 : 0;
  }
  return count;
}

void ExpectDarkBodies(const Scene& scene, int expected)
{
  const Counted count = CountDark(scene);
  EXPECT_EQ(count.walls, 0);
  EXPECT_EQ(count.bodies, expected);
  EXPECT_EQ(count.lamps, 0);
}

TEST(DarkSides, AClosedBodyIsDarkInside)
{
  Scene scene = LitRoom();
  ExpectDarkBodies(scene, 0);
  AddBody(scene, { 2, 1, 0.1 }, { 1, 1, 1 });
  ExpectDarkBodies(scene, 6);
  test::AddBall(scene, { 1, 1, 1 }, 0.5, 8, Body);
  ExpectDarkBodies(scene, 6 + 224);
}

/// Its fronts may be inside as well.
TEST(DarkSides, OrientationDoesNotCount)
{
  Scene scene = LitRoom();
  test::AddRoom(scene, { 2, 1, 0.1 }, { 1, 1, 1 }, Body);
  ExpectDarkBodies(scene, 6);
}

TEST(DarkSides, AHoleLetsLightIn)
{
  Scene scene = LitRoom();
  AddBody(scene, { 2, 1, 0.1 }, { 1, 1, 1 });
  scene.offsets.pop_back();
  scene.materialOfPolygon.pop_back();
  scene.indices.resize(scene.offsets.back());
  ExpectDarkBodies(scene, 0);
}

TEST(DarkSides, ABodyMayStandOnTheFloor)
{
  Scene scene = LitRoom();
  AddBody(scene, { 2, 1, 0 }, { 1, 1, 1 });
  ExpectDarkBodies(scene, 6);
}

TEST(DarkSides, ALampInsideLightsABody)
{
  const auto bodyWith = [](const Vec3& corner, const Vec3& u, const Vec3& v)
  {
    Scene scene = LitRoom();
    AddBody(scene, { 2, 1, 0.1 }, { 1, 1, 1 });
    test::AddQuad(scene, corner, u, v, Lamp);
    return scene;
  };
  ExpectDarkBodies(bodyWith({ 2.4, 1.4, 0.5 }, { 0.1, 0, 0 }, { 0, 0.1, 0 }), 0);
  // One that sticks through a wall, with its middle and all corners outside, and one close by.
  ExpectDarkBodies(bodyWith({ 1.5, 0.5, 0.5 }, { 2.2, 0, 0 }, { 0, 2.3, 0 }), 0);
  ExpectDarkBodies(bodyWith({ 1.5, 0.5, 0.05 }, { 2.2, 0, 0 }, { 0, 2.3, 0 }), 6);
}

/// The box around a frame holds the lamp in the middle of it.
TEST(DarkSides, ALampWithinAFrameIsOutsideOfIt)
{
  Scene scene = LitRoom();
  for (int side = 0; side < 4; ++side)
  {
    // Four beams with mitred ends, without the faces between them.
    const auto at = [side](double x, double y, double z)
    {
      const double c[4] = { 1, 0, -1, 0 };
      return Vec3(
        2 + c[side] * x - c[(side + 3) % 4] * y, 1.5 + c[(side + 3) % 4] * x + c[side] * y, z);
    };
    scene.AddPolygon({ at(-1, 1, 1), at(1, 1, 1), at(1, 1, 0.5), at(-1, 1, 0.5) }, Body);
    scene.AddPolygon(
      { at(-0.8, 0.8, 1), at(-0.8, 0.8, 0.5), at(0.8, 0.8, 0.5), at(0.8, 0.8, 1) }, Body);
    scene.AddPolygon({ at(-1, 1, 1), at(-0.8, 0.8, 1), at(0.8, 0.8, 1), at(1, 1, 1) }, Body);
    scene.AddPolygon(
      { at(-1, 1, 0.5), at(1, 1, 0.5), at(0.8, 0.8, 0.5), at(-0.8, 0.8, 0.5) }, Body);
  }
  test::AddQuad(scene, { 1.8, 1.3, 0.7 }, { 0.4, 0, 0 }, { 0, 0.4, 0 }, Lamp);
  ExpectDarkBodies(scene, 16);
}

/// A face of a body that shines does so outwards.
TEST(DarkSides, ALuminousFaceDoesNotLightItsBody)
{
  Scene scene = LitRoom();
  AddBody(scene, { 2, 1, 0.1 }, { 1, 1, 1 });
  scene.materialOfPolygon.back() = Lamp;
  const Counted outwards = CountDark(scene);
  EXPECT_EQ(outwards.bodies, 5);
  EXPECT_EQ(outwards.lamps, 1);
  std::reverse(scene.indices.end() - 4, scene.indices.end());
  ExpectDarkBodies(scene, 0);
}

/// Coordinates are rounded in files, so that facets in one plane are bent a little.
TEST(DarkSides, ARoundedGlobeDoesNotLightItsInside)
{
  Scene scene = LitRoom();
  test::AddBall(scene, { 1.0, 1.0, 1.3 }, 0.2, 12, Lamp);
  for (Vec3& point : scene.vertices)
  {
    point = glm::round(point * 1e5) * 1e-5;
  }
  EXPECT_EQ(CountDark(scene).lamps, 528);
}

TEST(DarkSides, WithoutALampNothingIsLeftOut)
{
  Scene scene = LitRoom();
  scene.materials[Lamp].emission = Color(0.0);
  AddBody(scene, { 2, 1, 0.1 }, { 1, 1, 1 });
  ExpectDarkBodies(scene, 0);
}

/// Whether a ray from the middle of a side meets a wall of the room before anything else.
bool SeesAWall(const FacetSet& facets, PatchId patch, const Vec3& direction)
{
  const Vec3 origin = Centroid(facets.facets[patch / 2].shape);
  double nearest = 1e300;
  bool isWall = false;
  for (std::uint32_t f = 0; f < facets.facets.size(); ++f)
  {
    const TriangleOrQuadrilateral& shape = facets.facets[f].shape;
    const Vec3 normal = UnitNormal(shape);
    const double t = glm::dot(shape[0] - origin, normal) / glm::dot(direction, normal);
    const Vec3 point = origin + t * direction;
    bool isInside = f != patch / 2 && t > 0.0 && t < nearest;
    for (int i = 0; i < shape.Size(); ++i)
    {
      const Vec3 edge = shape[(i + 1) % shape.Size()] - shape[i];
      isInside = isInside && glm::dot(glm::cross(edge, point - shape[i]), normal) > 0.0;
    }
    if (isInside)
    {
      nearest = t;
      isWall = facets.facets[f].material == Wall;
    }
  }
  return isWall;
}

/// Octahedra with corners anywhere pass through themselves, and turn parts of themselves inside
/// out. Oracle: rays.
TEST(DarkSides, NoSideOfABrokenBodyIsDarkThatSeesTheRoom)
{
  int dark = 0;
  for (std::uint64_t seed = 1; seed <= 300; ++seed)
  {
    RandomStream random(seed);
    Vec3 corners[6];
    for (int i = 0; i < 6; ++i)
    {
      corners[i] = Vec3(2.0, 1.5, 1.2);
      corners[i][i / 2] += i % 2 == 0 ? 0.5 : -0.5;
      corners[i] += 1.2 * Vec3(random.Next() - 0.5, random.Next() - 0.5, random.Next() - 0.5);
    }
    Scene scene = LitRoom();
    for (int octant = 0; octant < 8; ++octant)
    {
      const Vec3& x = corners[octant & 1];
      const Vec3& y = corners[2 + (octant >> 1 & 1)];
      const Vec3& z = corners[4 + (octant >> 2)];
      const bool isEven = (octant & 1) == ((octant >> 1 & 1) ^ (octant >> 2));
      scene.AddPolygon(isEven ? std::vector<Vec3>{ x, y, z } : std::vector<Vec3>{ x, z, y }, Body);
    }
    const FacetSet facets = BuildFacets(scene);
    const DarkSides isDark = FindDarkSides(facets, scene.materials);
    for (PatchId patch = 0; patch < isDark.bodyOf.size(); ++patch)
    {
      const Vec3 front = UnitNormal(facets.facets[patch / 2].shape);
      const Frame frame(SideOf(patch) == Side::Front ? front : -front);
      for (int ray = 0; isDark[patch] && ray < 64; ++ray)
      {
        const Vec3 direction = frame.ToWorld(CosineHemisphere(random.Next2()));
        ASSERT_FALSE(SeesAWall(facets, patch, direction)) << "seed " << seed;
      }
      dark += isDark[patch] ? 1 : 0;
    }
  }
  EXPECT_GT(dark, 300);
  EXPECT_LT(dark, 8 * 290);
}

} // namespace
} // namespace vantage
