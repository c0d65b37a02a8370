#include "report/ReachTable.h"

#include "TextTable.h"

#include <algorithm>
#include <cmath>

namespace vantage
{

namespace
{

const std::string Nothing = "\u2013";

std::string PrintReach(const Reach& reach, const std::string& unit)
{
  switch (reach.kind)
  {
    case Reach::Kind::Never:
      return "not reached";
    case Reach::Kind::AtMost:
      return "< " + TwoDigits(reach.cost) + unit;
    case Reach::Kind::At:
      break;
  }
  return TwoDigits(reach.cost) + unit;
}

/// How many times as much: a bound where either of them is one.
std::string PrintRatio(const Reach& reach, const Reach& yardstick)
{
  const bool isKnown = reach.cost > 0.0 && yardstick.kind != Reach::Kind::Never;
  const bool isAbove = reach.kind == Reach::Kind::Never || yardstick.kind == Reach::Kind::AtMost;
  const bool isBelow = reach.kind == Reach::Kind::AtMost;
  if (!isKnown || (isAbove && isBelow))
  {
    return Nothing;
  }
  const double ratio = reach.cost / yardstick.cost;
  if (isAbove && ratio < 1.0) // says nothing
  {
    return Nothing;
  }
  return (isAbove ? "> " : isBelow ? "< " : "") + TwoDigits(ratio) + " \u00d7";
}

} // namespace

std::vector<CurvePoint> LowerEnvelope(
  const std::vector<Measurement>& measurements, const Cost& cost)
{
  std::vector<CurvePoint> points;
  for (const Measurement& m : measurements)
  {
    const CurvePoint point{ cost(m), m.error };
    if (point.cost > 0.0 && point.error > 0.0 && std::isfinite(point.error))
    {
      points.push_back(point);
    }
  }
  std::sort(points.begin(), points.end(),
    [](const CurvePoint& a, const CurvePoint& b)
    { return a.cost != b.cost ? a.cost < b.cost : a.error < b.error; });
  std::vector<CurvePoint> envelope;
  for (const CurvePoint& point : points)
  {
    if (envelope.empty() || point.error < envelope.back().error)
    {
      envelope.push_back(point);
    }
  }
  return envelope;
}

Reach ReachOf(const std::vector<CurvePoint>& envelope, double error)
{
  Reach reach;
  for (std::size_t k = 0; k < envelope.size(); ++k)
  {
    const CurvePoint& to = envelope[k];
    reach.cost = to.cost;
    if (to.error <= error && k == 0)
    {
      reach.kind = Reach::Kind::AtMost;
      return reach;
    }
    if (to.error <= error)
    {
      const CurvePoint& from = envelope[k - 1];
      const double part = std::log(from.error / error) / std::log(from.error / to.error);
      reach.kind = Reach::Kind::At;
      reach.cost = from.cost * std::pow(to.cost / from.cost, part);
      return reach;
    }
  }
  return reach;
}

std::vector<std::vector<std::string>> MakeReachTable(const std::vector<MeasuredCurve>& curves,
  const Cost& cost, const std::string& yardstick, const std::string& unit)
{
  const auto known = std::find_if(curves.begin(), curves.end(),
    [&](const MeasuredCurve& curve) { return curve.method == yardstick; });
  const std::vector<CurvePoint> measure =
    known != curves.end() ? LowerEnvelope(known->measurements, cost) : std::vector<CurvePoint>();
  std::vector<std::vector<std::string>> cells = { { "method" } };
  for (const double error : TableErrors)
  {
    cells.front().push_back("to " + Fixed(100.0 * error, 0) + " %");
    cells.front().push_back("ratio");
  }
  for (const MeasuredCurve& curve : curves)
  {
    const std::vector<CurvePoint> envelope = LowerEnvelope(curve.measurements, cost);
    if (envelope.empty())
    {
      continue;
    }
    std::vector<std::string> row = { curve.method };
    for (const double error : TableErrors)
    {
      const Reach reach = ReachOf(envelope, error);
      row.push_back(PrintReach(reach, unit));
      row.push_back(PrintRatio(reach, ReachOf(measure, error)));
    }
    cells.push_back(row);
  }
  return cells;
}

} // namespace vantage
