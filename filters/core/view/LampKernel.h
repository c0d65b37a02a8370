#pragma once

#include "core/math/Polygon.h"

#include <array>

/// \file LampKernel.h
/// What a plane receives from a polygon above it, at many points.

namespace vantage
{

/// The part of an edge in Lambert's sum for a point of the plane z = 0 with normal +z: the angle
/// that it is seen under times the vertical part of the normal of the plane through it.
/// \param from, to distances of its ends from the point
/// \param square of its length
/// \param wedge vertical part of the product of the edge and the way from the point to it
double LambertTerm(double from, double to, double square, double wedge);

/// PointToPolygon() for the points of the plane z = 0 with normal +z and one polygon above them:
/// Lambert's sum, with all that does not depend on the point done once, and a series instead of an
/// arc tangent where an edge is seen under less than 45 degrees. A quarter of the time, relative
/// error 1e-12 where the result is not much smaller than the polygon's solid angle.
class LampKernel
{
public:
  /// \pre no vertex has z < 0
  explicit LampKernel(const Polygon& lamp);

  /// In sr; 0 behind the polygon.
  double At(const Vec2& x) const;

private:
  struct Edge
  {
    double x, y, z; ///< where it starts
    double alongX, alongY;
    double square; ///< of its length
  };

  std::array<Edge, Polygon::Capacity> Edges;
  int Count = 0;
};

} // namespace vantage
