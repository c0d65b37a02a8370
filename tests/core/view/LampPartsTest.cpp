#include "core/view/LampParts.h"

#include "core/math/Sampling.h"
#include "support/TestScenes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>

namespace vantage
{
namespace
{

using Shapes = std::vector<TriangleOrQuadrilateral>;
using Sizes = std::vector<int>;

Shapes ShapesOf(const Scene& scene)
{
  Shapes shapes;
  for (std::size_t p = 0; p < scene.PolygonCount(); ++p)
  {
    TriangleOrQuadrilateral shape;
    for (const Vec3& corner : test::CornersOf(scene, p))
    {
      shape.Add(corner);
    }
    shapes.push_back(shape);
  }
  return shapes;
}

bool Alike(std::uint32_t, std::uint32_t)
{
  return true;
}

/// How many polygons each part has, ascending.
Sizes SizesOf(const std::vector<LampPart>& parts, std::uint32_t LampPart::*which)
{
  std::map<std::uint32_t, int> counts;
  for (const LampPart& part : parts)
  {
    ++counts[part.*which];
  }
  Sizes sizes;
  for (const auto& [part, count] : counts)
  {
    sizes.push_back(count);
  }
  std::sort(sizes.begin(), sizes.end());
  return sizes;
}

Shapes Ball(int rings)
{
  Scene scene;
  scene.materials.resize(1);
  test::AddBall(scene, { 1.0, 2.0, 3.0 }, 0.2, rings, 0);
  return ShapesOf(scene);
}

/// A fan of triangles, front up.
Shapes Disc(int corners)
{
  const auto at = [corners](int k)
  { return Vec3(std::cos(2.0 * Pi * k / corners), std::sin(2.0 * Pi * k / corners), 1.0); };
  Shapes shapes;
  for (int k = 0; k < corners; ++k)
  {
    shapes.push_back({ Vec3(0.0, 0.0, 1.0), at(k), at((k + 1) % corners) });
  }
  return shapes;
}

/// Quadrilaterals around a circle, fronts outside.
Shapes Ring(int segments, int strips)
{
  const auto at = [&](int segment, int strip)
  {
    const double around = 2.0 * Pi * (segment % segments) / segments;
    const double across = 2.0 * Pi * (strip % strips) / strips;
    const double radius = 1.0 + 0.2 * std::cos(across);
    return Vec3(radius * std::cos(around), radius * std::sin(around), 0.2 * std::sin(across));
  };
  Shapes shapes;
  for (int i = 0; i < segments; ++i)
  {
    for (int k = 0; k < strips; ++k)
    {
      shapes.push_back({ at(i, k), at(i + 1, k), at(i + 1, k + 1), at(i, k + 1) });
    }
  }
  return shapes;
}

TEST(LampParts, AGlobeAndADiscAreOneEach)
{
  for (const Shapes& shapes : { Ball(4), Ball(12), Disc(3), Disc(32) })
  {
    const std::vector<LampPart> parts = LampPartsOf(shapes, Alike);
    EXPECT_EQ(SizesOf(parts, &LampPart::convex), Sizes{ static_cast<int>(shapes.size()) });
    EXPECT_EQ(parts.front().convex, 0u);
    EXPECT_EQ(SizesOf(parts, &LampPart::whole), Sizes{ static_cast<int>(shapes.size()) });
  }
}

/// Five digits, as in files.
TEST(LampParts, RoundedCoordinatesDoNotPartThem)
{
  Shapes shapes = Ball(12);
  for (TriangleOrQuadrilateral& shape : shapes)
  {
    for (int i = 0; i < shape.Size(); ++i)
    {
      shape[i] = glm::round(shape[i] * 1e5) * 1e-5;
    }
  }
  EXPECT_EQ(SizesOf(LampPartsOf(shapes, Alike), &LampPart::convex), Sizes{ 528 });
}

TEST(LampParts, WhatIsHollowComesApart)
{
  Shapes shapes = Ball(8);
  for (TriangleOrQuadrilateral& shape : shapes)
  {
    shape = Reversed(shape);
  }
  const std::vector<LampPart> parts = LampPartsOf(shapes, Alike);
  EXPECT_EQ(SizesOf(parts, &LampPart::whole), Sizes{ 224 });
  // Halves of what was a flat quadrilateral stay together.
  EXPECT_EQ(SizesOf(parts, &LampPart::convex).back(), 2);
}

TEST(LampParts, OfARingTheOuterHalfIsOneAndEachSegmentOfTheInnerHalf)
{
  const std::vector<LampPart> parts = LampPartsOf(Ring(24, 12), Alike);
  EXPECT_EQ(SizesOf(parts, &LampPart::whole), Sizes{ 288 });
  Sizes expected(24, 6);
  expected.push_back(144);
  EXPECT_EQ(SizesOf(parts, &LampPart::convex), expected);
}

TEST(LampParts, LampsThatAreNotAlikeOrDoNotTouchAreSeveral)
{
  Shapes shapes = Disc(32);
  const auto areAlike = [](std::uint32_t a, std::uint32_t b) { return a / 16 == b / 16; };
  EXPECT_EQ(SizesOf(LampPartsOf(shapes, areAlike), &LampPart::convex), Sizes({ 16, 16 }));
  for (const TriangleOrQuadrilateral& shape : Disc(32))
  {
    TriangleOrQuadrilateral moved = shape;
    for (int i = 0; i < 3; ++i)
    {
      moved[i].x += 3.0;
    }
    shapes.push_back(moved);
  }
  EXPECT_EQ(SizesOf(LampPartsOf(shapes, Alike), &LampPart::whole), Sizes({ 32, 32 }));
}

/// None hides another from where its front is seen: what that says, for points all around.
TEST(LampParts, NoFaceHidesAnother)
{
  RandomStream random(3);
  const Shapes shapes = Ring(12, 8);
  const std::vector<LampPart> parts = LampPartsOf(shapes, Alike);
  for (int k = 0; k < 200; ++k)
  {
    const Vec3 eye = 4.0 * Vec3(random.Next(), random.Next(), random.Next()) - 2.0;
    for (std::size_t a = 0; a < shapes.size(); ++a)
    {
      const Vec3 middle = Centroid(shapes[a]);
      if (SupportingPlane(shapes[a]).Distance(eye) <= 0.0)
      {
        continue;
      }
      for (std::size_t b = 0; b < shapes.size(); ++b)
      {
        const Plane plane = SupportingPlane(shapes[b]);
        const double here = plane.Distance(eye);
        const double there = plane.Distance(middle);
        if (a == b || parts[a].convex != parts[b].convex || here * there >= 0.0)
        {
          continue;
        }
        const Vec3 meets = eye + here / (here - there) * (middle - eye);
        bool isInside = true;
        for (int i = 0; i < 4; ++i)
        {
          const Vec3 edge = shapes[b][(i + 1) % 4] - shapes[b][i];
          isInside =
            isInside && glm::dot(glm::cross(edge, meets - shapes[b][i]), plane.normal) > 0.0;
        }
        ASSERT_FALSE(isInside) << "face " << b << " hides " << a;
      }
    }
  }
}

} // namespace
} // namespace vantage
