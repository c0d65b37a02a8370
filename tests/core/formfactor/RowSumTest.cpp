#include "core/formfactor/FormFactor.h"
#include "core/formfactor/Shapes.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace vantage
{
namespace
{

std::vector<Polygon> Subdivided(std::vector<Polygon> faces, int levels)
{
  for (int level = 0; level < levels; ++level)
  {
    std::vector<Polygon> finer;
    for (const Polygon& face : faces)
    {
      const std::vector<Polygon> parts = Quartered(face);
      finer.insert(finer.end(), parts.begin(), parts.end());
    }
    faces = finer;
  }
  return faces;
}

/// In a closed scene each row sums to pi. \return the largest relative error
double WorstRow(const std::vector<Polygon>& faces, Accuracy accuracy)
{
  double worst = 0.0;
  for (const Polygon& from : faces)
  {
    double sum = 0.0;
    for (const Polygon& to : faces)
    {
      sum += Throughput(from, to, accuracy);
    }
    worst = std::max(worst, std::abs(sum / (Pi * Area(from)) - 1.0));
  }
  return worst;
}

/// A box sheared in all directions: no two faces are at right angles.
std::vector<Polygon> ShearedBox()
{
  std::vector<Polygon> box = InsideOfBox(Vec3(0.0), Vec3(1.0));
  for (Polygon& face : box)
  {
    for (int i = 0; i < face.Size(); ++i)
    {
      const Vec3 p = face[i];
      face[i] = { p.x + 0.3 * p.y + 0.2 * p.z, p.y + 0.4 * p.z, p.z - 0.1 * p.x };
    }
  }
  return box;
}

/// A cube with its corners pulled in and out, so that hardly any edges are parallel or meet. Its
/// faces are triangles.
std::vector<Polygon> BentBox()
{
  std::vector<Polygon> triangles;
  const Vec3 middle(0.5);
  for (const Polygon& face : InsideOfBox(Vec3(0.0), Vec3(1.0)))
  {
    const Vec3 apex = Centroid(face) + 0.3 * (Centroid(face) - middle);
    for (int i = 0; i < 4; ++i)
    {
      triangles.push_back({ face[i], face[(i + 1) % 4], apex });
    }
  }
  return triangles;
}

TEST(RowSums, OfBoxes)
{
  const std::vector<Polygon> box = InsideOfBox(Vec3(-1, 0, 2), Vec3(0.5, 1, 4));
  for (int levels = 0; levels <= 2; ++levels)
  {
    SCOPED_TRACE(levels);
    // Few pairs are far enough apart for quadrature; the others are exact.
    EXPECT_LT(WorstRow(Subdivided(box, levels), Accuracy::Reference), 1e-10);
    EXPECT_LT(WorstRow(Subdivided(box, levels), Accuracy::Default), 1e-6);
  }
}

TEST(RowSums, OfTurnedBoxes)
{
  Motion motion;
  motion.frame = Frame(glm::normalize(Vec3(1, -2, 0.5)));
  motion.shift = Vec3(5, 6, -7);
  std::vector<Polygon> box = InsideOfBox(Vec3(-1, 0, 2), Vec3(0.5, 1, 4));
  for (Polygon& face : box)
  {
    face = motion(face);
  }
  EXPECT_LT(WorstRow(Subdivided(box, 2), Accuracy::Reference), 1e-10);
  EXPECT_LT(WorstRow(Subdivided(box, 2), Accuracy::Default), 1e-6);
}

TEST(RowSums, OfConvexBodiesAskew)
{
  const std::vector<Polygon> sheared = ShearedBox();
  for (int levels = 0; levels <= 2; ++levels)
  {
    SCOPED_TRACE(levels);
    EXPECT_LT(WorstRow(Subdivided(sheared, levels), Accuracy::Reference), 1e-10);
    EXPECT_LT(WorstRow(Subdivided(sheared, levels), Accuracy::Default), 1e-6);
  }
  EXPECT_LT(WorstRow(BentBox(), Accuracy::Reference), 1e-10);
  EXPECT_LT(WorstRow(BentBox(), Accuracy::Default), 1e-6);
}

TEST(RowSums, OfALongCorridor)
{
  // Sizes 1 : 1000 at all distances, and polygons that touch along part of their edges only.
  std::vector<Polygon> faces = InsideOfBox(Vec3(0, 0, 0), Vec3(1000, 1, 1));
  const std::vector<Polygon> parts = Subdivided({ faces[0] }, 2);
  faces.erase(faces.begin());
  faces.insert(faces.end(), parts.begin(), parts.end());
  EXPECT_LT(WorstRow(faces, Accuracy::Reference), 1e-10);
  EXPECT_LT(WorstRow(faces, Accuracy::Default), 1e-6);
}

} // namespace
} // namespace vantage
