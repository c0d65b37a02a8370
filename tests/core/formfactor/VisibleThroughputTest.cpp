#include "core/formfactor/FormFactor.h"
#include "core/formfactor/Shapes.h"

#include <gtest/gtest.h>

namespace vantage
{
namespace
{

const Frame Level(Vec3(0, 0, 1));

/// A rectangle in a plane of constant x, between the heights z0 and z1.
Polygon WallAt(double x, double y0, double y1, double z0, double z1)
{
  return { { x, y0, z0 }, { x, y1, z0 }, { x, y1, z1 }, { x, y0, z1 } };
}

TEST(VisibleThroughput, WhatIsNotInBetweenDoesNotCount)
{
  const double open = Throughput(Floor(), Ceiling(1));
  const Polygon beside = Regular(Vec3(3, 3, 0.5), Level, 0.5, 4, 0.1);
  const Polygon below = Floor(1, 1, -0.5);
  const Polygon above = Floor(1, 1, 1.5);
  const Polygon onFloor = Regular(Vec3(0.5, 0.5, 0), Level, 0.3, 6, 0.1);
  const Polygon onCeiling = Regular(Vec3(0.5, 0.5, 1), Level, 0.3, 6, 0.1);
  const Polygon atBorder = WallAt(0, 0, 1, 0, 1);
  const Polygon acrossBorder = WallAt(0, -1, 2, -1, 2);
  for (const Polygon& idle : { beside, below, above, onFloor, onCeiling, Floor(), Ceiling(1),
         atBorder, acrossBorder, Polygon{}, Polygon{ { 0, 0, 0.5 }, { 1, 1, 0.5 } } })
  {
    EXPECT_EQ(VisibleThroughput(Floor(), Ceiling(1), { idle }), open);
    EXPECT_EQ(VisibleThroughput(Floor(), Ceiling(1), { Reversed(idle) }), open);
  }
}

TEST(VisibleThroughput, FullyBlockedIsZero)
{
  EXPECT_EQ(VisibleThroughput(Floor(), Ceiling(1), { Floor(1, 1, 0.5) }), 0.0);
  EXPECT_EQ(VisibleThroughput(Floor(), Ceiling(1), { Floor(1, 1, 1e-7) }), 0.0);
  // Two halves that overlap block all, though neither does.
  const Polygon left{ { -1, -1, 0.5 }, { 0.55, -1, 0.5 }, { 0.55, 2, 0.5 }, { -1, 2, 0.5 } };
  const Polygon right{ { 0.45, -1, 0.7 }, { 2, -1, 0.7 }, { 2, 2, 0.7 }, { 0.45, 2, 0.7 } };
  const double rest = VisibleThroughput(Floor(), Ceiling(1), { left, right });
  EXPECT_GT(rest, 0.0); // through the slanting gap between them
  EXPECT_LT(rest, 0.1 * Throughput(Floor(), Ceiling(1)));
  EXPECT_NEAR(VisibleThroughput(Floor(), Ceiling(1), { left, right, Floor(1, 1, 0.6) }), 0, 1e-12);
}

TEST(VisibleThroughput, APartitionLeavesTheTwoRooms)
{
  const auto half = [](double x0, double x1, double z) {
    return Polygon{ { x0, 0, z }, { x1, 0, z }, { x1, 1, z }, { x0, 1, z } };
  };
  const double left = Throughput(half(0, 0.3, 0), Reversed(half(0, 0.3, 1)), Accuracy::Reference);
  const double right = Throughput(half(0.3, 1, 0), Reversed(half(0.3, 1, 1)), Accuracy::Reference);
  // Fitting exactly, and standing out on all sides.
  for (const Polygon& wall : { WallAt(0.3, 0, 1, 0, 1), WallAt(0.3, -2, 2, -2, 2) })
  {
    const double fine = VisibleThroughput(Floor(), Ceiling(1), { wall }, Accuracy::Reference);
    EXPECT_NEAR(fine / (left + right), 1.0, 1e-6);
    const double coarse = VisibleThroughput(Floor(), Ceiling(1), { wall });
    EXPECT_NEAR(coarse / (left + right), 1.0, 1e-4);
  }
}

TEST(VisibleThroughput, TilesOccludeLikeTheWhole)
{
  const Polygon whole{ { 0.2, 0.1, 0.4 }, { 0.8, 0.2, 0.5 }, { 0.8, 0.7, 0.5 }, { 0.2, 0.6, 0.4 } };
  const double once = VisibleThroughput(Floor(), Ceiling(1), { whole }, Accuracy::Reference);
  const double tiles =
    VisibleThroughput(Floor(), Ceiling(1), Quartered(whole), Accuracy::Reference);
  EXPECT_NEAR(tiles / once, 1.0, 2e-6); // twice the accuracy asked for
  const double twice =
    VisibleThroughput(Floor(), Ceiling(1), { whole, Reversed(whole), whole }, Accuracy::Reference);
  EXPECT_NEAR(twice / once, 1.0, 2e-6);
}

TEST(VisibleThroughput, ManyVerticesFit)
{
  const Polygon floor = Regular(Vec3(0, 0, 0), Level, 1.0, 12, 0.0);
  const Polygon ceiling = Reversed(Regular(Vec3(0, 0, 1), Level, 1.0, 14, 0.2));
  const Polygon disc = Regular(Vec3(0.2, 0.1, 0.4), Level, 0.5, 15, 0.3);
  const double one = VisibleThroughput(floor, ceiling, { disc });
  // As triangles around its centre the disc has few vertices.
  std::vector<Polygon> slices;
  for (int i = 0; i < disc.Size(); ++i)
  {
    slices.push_back({ Centroid(disc), disc[i], disc[(i + 1) % disc.Size()] });
  }
  EXPECT_NEAR(VisibleThroughput(floor, ceiling, slices) / one, 1.0, 2e-4); // twice the accuracy
}

// In a closed room with a box in it all that a face sees adds up to pi, the box included.
TEST(VisibleThroughput, RowSumsOfARoomWithABox)
{
  const std::vector<Polygon> room = InsideOfBox(Vec3(0.0), Vec3(2, 1, 1));
  for (const double foot : { 0.2, 0.0 }) // floating, standing on the floor
  {
    std::vector<Polygon> faces = room;
    std::vector<Polygon> box;
    for (const Polygon& face : InsideOfBox(Vec3(0.6, 0.3, foot), Vec3(1.1, 0.8, 0.7)))
    {
      box.push_back(Reversed(face));
    }
    faces.insert(faces.end(), box.begin(), box.end());
    for (std::size_t i = 0; i < faces.size(); ++i)
    {
      double sum = 0.0;
      double covered = 0.0;
      for (std::size_t j = 0; j < faces.size(); ++j)
      {
        sum += VisibleThroughput(faces[i], faces[j], box);
      }
      if (foot == 0.0 && i == 0)
      {
        covered = Area(box[0]); // what the box stands on sees nothing
      }
      if (foot == 0.0 && i == room.size())
      {
        continue; // the bottom of the box, on the floor
      }
      EXPECT_NEAR(sum / (Pi * (Area(faces[i]) - covered)), 1.0, 1e-4)
        << "face " << i << ", foot " << foot;
    }
  }
}

} // namespace
} // namespace vantage
