#pragma once

#include "core/formfactor/GaussLegendre.h"

#include <algorithm>
#include <array>
#include <cmath>

/// \file PanelQuadrature.h
/// Integrals of functions whose singularities in the complex plane are known.

namespace vantage
{

struct Panel
{
  double from, to;

  double Length() const { return this->to - this->from; }
};

/// A pair of singularities at position +- i width.
struct Singularity
{
  double position, width;
};

/// The part of [0, length] where an integrand is analytic, and how far.
class AnalyticStrip
{
public:
  void Add(const Singularity& singularity) { this->Singularities[this->Count++] = singularity; }

  /// Sum of the half axes, in half lengths of the panel, of the largest ellipse around the panel
  /// (with its ends as foci) that holds no singularity, and the singularity that limits it:
  /// n Gauss points err by about this to the power -2 n (Bernstein).
  double EllipseAround(const Panel& panel, double& limit) const
  {
    const double middle = 0.5 * (panel.from + panel.to);
    const double half = 0.5 * panel.Length();
    double least = 1e30;
    limit = middle;
    for (int k = 0; k < this->Count; ++k)
    {
      const double x = (this->Singularities[k].position - middle) / half;
      const double y = this->Singularities[k].width / half;
      const double major =
        0.5 * (std::sqrt((x - 1.0) * (x - 1.0) + y * y) + std::sqrt((x + 1.0) * (x + 1.0) + y * y));
      if (major < least)
      {
        least = major;
        limit = this->Singularities[k].position;
      }
    }
    return least + std::sqrt(std::max(least * least - 1.0, 0.0));
  }

private:
  std::array<Singularity, 3> Singularities;
  int Count = 0;
};

template <typename Function>
double IntegrateOnPanel(const Function& value, const Panel& panel, int points)
{
  const GaussRule& rule = GaussLegendre(points);
  double sum = 0.0;
  for (int k = 0; k < rule.count; ++k)
  {
    sum += rule.weights[k] * value(panel.from + rule.nodes[k] * panel.Length());
  }
  return sum * panel.Length();
}

/// Integral of `value` over [0, length] with Gauss-Legendre rules of just enough points, on panels
/// that get short towards singularities.
/// \param bound of the integral over a panel of what is not a polynomial, roughly
/// \param tolerance absolute error allowed, > 0
template <typename Function, typename Bound>
double IntegrateOnPanels(double length, const AnalyticStrip& strip, double tolerance,
  const Function& value, const Bound& bound)
{
  // Each panel that waits is half of one that was cut: more of them than this are shorter than
  // what a double can resolve.
  constexpr int most = 64;
  std::array<Panel, most> waiting;
  int count = 0;
  waiting[count++] = { 0.0, length };
  double sum = 0.0;
  while (count > 0)
  {
    const Panel panel = waiting[--count];
    double limit = 0.0;
    const double ellipse = std::max(strip.EllipseAround(panel, limit), 1.0 + 1e-9);
    const double reduction = std::max(bound(panel) / tolerance, 1.0);
    const double points = 1.0 + 0.5 * std::log(reduction) / std::log(ellipse);
    if (points <= MaxGaussPoints || count + 2 > most)
    {
      sum +=
        IntegrateOnPanel(value, panel, static_cast<int>(std::min<double>(points, MaxGaussPoints)));
      continue;
    }
    // At the singularity, or halfway when that would leave a tiny panel.
    const double margin = 0.1 * panel.Length();
    const bool inside = limit > panel.from + margin && limit < panel.to - margin;
    const double cut = inside ? limit : 0.5 * (panel.from + panel.to);
    waiting[count++] = { cut, panel.to };
    waiting[count++] = { panel.from, cut };
  }
  return sum;
}

} // namespace vantage
