#pragma once

#include "core/math/Polygon.h"

#include <vector>

/// \file FormFactor.h
/// Throughput between convex polygons. G = integral over both of cos cos / r^2 dA dA, in
/// (scene unit)^2 sr: G_ij = A_i F_ij = A_j F_ji with F = pi times the classical form factor.

namespace vantage
{

/// What the results promise. Below about 1e-16 times the square of the larger polygon nothing is
/// promised: that is rounding.
enum class Accuracy
{
  Default,  ///< relative error <= 1e-5 unoccluded, <= 1e-4 with given occluders
  Reference ///< relative error <= 1e-8 unoccluded, <= 1e-6 with given occluders
};

/// Integral of the cosine over the solid angle of p seen from x with unit normal n, in sr, within
/// [0, pi]: the front side of p only, cut at the horizon of x (Lambert 1760). Closed form; 0 for
/// points in the plane of p.
double PointToPolygon(const Vec3& x, const Vec3& n, const Polygon& p);

/// Throughput between the front sides of two convex polygons without anything in between, each cut
/// to the front half-space of the other. Symmetric to the bit, never negative, at most pi times
/// the smaller area. Touching, coplanar and degenerate polygons are welcome; polygons that coincide
/// are the two sides of one wall and get 0, in front of each other they tend to pi times the area.
///
/// The cheapest way that is good enough is taken, by how far apart the polygons are: Gauss-Legendre
/// points on both, points on the smaller one that see the other in closed form, or an integral over
/// both contours (Schroeder and Hanrahan 1993), which has no trouble with near or touching ones.
/// Costs about 0.5 microseconds far apart, 1 when near and aligned, 5 to 10 when near and askew.
/// \pre at most Polygon::Capacity - 1 vertices each
double Throughput(const Polygon& a, const Polygon& b, Accuracy accuracy = Accuracy::Default);

/// The same with convex opaque polygons in between. Exact visibility from every quadrature point
/// (the shadows of the occluders are cut out of b), adaptive over a. Parts of a that see all or
/// nothing of b are found without sampling. Symmetric to the bit. Occluders in the plane of a or b
/// (1e-10 of their extent) hide nothing.
/// The accuracy is relative to what is seen, but to a tenth of Throughput(a, b) where less is seen.
/// A tenth of a millisecond for one occluder, O(2^k) in the number k of occluders whose shadows
/// overlap; the work is bounded, so many fine shadows end with less accuracy. Occluders much
/// smaller than a that hang close above it may fall between the quadrature points: of 200 of a
/// twentieth of its size, 29 missed the default accuracy, the worst with 4e-3.
/// \pre at most Polygon::Capacity - 2 vertices each for a and b
double VisibleThroughput(const Polygon& a, const Polygon& b, const std::vector<Polygon>& occluders,
  Accuracy accuracy = Accuracy::Default);

} // namespace vantage
