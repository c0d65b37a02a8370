#pragma once

#include "core/math/Polygon.h"

#include <vector>

/// \file FormFactor.h
/// Throughput between convex polygons. G = integral over both of cos cos / r^2 dA dA, in
/// (scene unit)^2 sr: G_ij = A_i F_ij = A_j F_ji with F = pi times the classical form factor.

namespace vantage
{

enum class Accuracy
{
  Default,  ///< relative error <= 1e-5 unoccluded, <= 1e-4 with given occluders
  Reference ///< relative error <= 1e-8 unoccluded, <= 1e-6 with given occluders
};

/// Integral of the cosine over the solid angle of p seen from x with unit normal n, in sr, within
/// [0, pi]: the front side of p only, cut at the horizon of x (Lambert 1760). Closed form.
double PointToPolygon(const Vec3& x, const Vec3& n, const Polygon& p);

/// Throughput between the front sides of two convex polygons without anything in between, each cut
/// to the front half-space of the other. Symmetric to the bit, never negative, at most pi times
/// the smaller area.
double Throughput(const Polygon& a, const Polygon& b, Accuracy accuracy = Accuracy::Default);

/// The same with convex opaque polygons in between. Exact visibility from every quadrature point
/// (the shadows of the occluders are cut out of b), adaptive over a. Symmetric up to the accuracy.
/// O(2^k) in the number k of occluders whose shadows overlap.
double VisibleThroughput(const Polygon& a, const Polygon& b, const std::vector<Polygon>& occluders,
  Accuracy accuracy = Accuracy::Default);

/// A cheap guess of Throughput for refinement oracles: the mean of both point-to-polygon factors
/// between the centres of the clipped polygons. Zero exactly where Throughput is zero.
double ThroughputEstimate(const Polygon& a, const Polygon& b);

} // namespace vantage
