#pragma once

#include "core/math/Polygon.h"

/// \file ContourIntegral.h
/// Throughput of two polygons from their contours alone.

namespace vantage
{

/// Stokes' theorem on both surfaces turns the throughput into a double integral over the contours
/// (Schroeder and Hanrahan 1993, equation 6; Baum et al. 1989 did the inner one in closed form):
///
///   G = 1/2 integral over contour a, integral over contour b of ln |x - y| dx . dy
///
/// Here each pair of edges is reduced once more, to its ends, by the divergence theorem: exact for
/// edges that are parallel or whose lines meet, and up to a smooth remainder for skew ones, which
/// Gauss-Legendre rules integrate. Touching edges and vertices need no special care.
///
/// `tolerance` is the absolute error allowed in G; rounding adds about 1e-16 times the product of
/// both perimeters. Costs a few logarithms and arc tangents a pair of edges.
/// \pre Both polygons are in front of each other, with lengths of about 1.
double ContourIntegral(const Polygon& a, const Polygon& b, double tolerance);

} // namespace vantage
