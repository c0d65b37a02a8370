#pragma once

#include "core/math/Polygon.h"

#include <array>

/// \file SurfaceQuadrature.h
/// Gauss-Legendre points on a polygon.

namespace vantage
{

/// Points and weights, coordinate by coordinate, so that loops over them vectorise. The sum of
/// weights[k] f(point k) is the integral of f over the polygon.
struct SurfaceNodes
{
  static constexpr int MaxPointsPerSide = 6;
  static constexpr int Capacity = (Polygon::Capacity - 1) / 2 * MaxPointsPerSide * MaxPointsPerSide;

  int count = 0;
  std::array<double, Capacity> x, y, z, weights;

  Vec3 Point(int k) const { return { this->x[k], this->y[k], this->z[k] }; }
};

/// points x points nodes on each of the quadrilaterals around vertex 0 that make up the polygon
/// (the last one may be a triangle), through the bilinear map of the unit square. Exact for
/// polynomials of degree 2 points - 2, on parallelograms of degree 2 points - 1.
/// \pre 1 <= points <= SurfaceNodes::MaxPointsPerSide
SurfaceNodes NodesOn(const Polygon& p, int points);

} // namespace vantage
