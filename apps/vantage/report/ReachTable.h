#pragma once

#include "report/Measurement.h"

#include <functional>
#include <string>
#include <vector>

/// \file ReachTable.h
/// What a method spends to come near to the truth.

namespace vantage
{

/// Something that a picture costs: seconds, rays, interactions.
using Cost = std::function<double(const Measurement&)>;

struct CurvePoint
{
  double cost = 0.0;
  double error = 0.0;
};

/// The lower envelope: of the measurements with positive cost and error those that no cheaper one
/// is as good as, in order of cost. So their errors fall. O(n log n).
std::vector<CurvePoint> LowerEnvelope(
  const std::vector<Measurement>& measurements, const Cost& cost);

/// What it costs to reach an error.
struct Reach
{
  enum class Kind
  {
    Never,  ///< not by what was measured; `cost` is the largest that was tried
    AtMost, ///< the cheapest picture is nearer already
    At
  };
  Kind kind = Kind::Never;
  double cost = 0.0;
};

/// Interpolated on the envelope between the logarithms of cost and error.
Reach ReachOf(const std::vector<CurvePoint>& envelope, double error);

/// The measurements of one line of a table or a chart.
struct MeasuredCurve
{
  std::string method;
  std::vector<Measurement> measurements;
};

/// Errors that tables ask for.
inline const std::vector<double> TableErrors = { 0.1, 0.05, 0.02, 0.01 };

/// For people: a header and a row for each curve with its costs to the TableErrors, "not reached"
/// among them, and how many times that of `yardstick` these are, where such a curve is.
std::vector<std::vector<std::string>> MakeReachTable(const std::vector<MeasuredCurve>& curves,
  const Cost& cost, const std::string& yardstick, const std::string& unit);

} // namespace vantage
