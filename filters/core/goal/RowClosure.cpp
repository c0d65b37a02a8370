#include "core/goal/RowClosure.h"

#include <algorithm>
#include <cmath>

namespace vantage
{

namespace
{

/// Some ten are enough, unless rows cannot be closed within the bounds of the factors.
constexpr int MostIterations = 24;
/// Part of a step that is made. As the other ends move as well, half of it would be right where all
/// of them lack the same; where every second one has too much, less is left of a step.
constexpr double StepLength = 0.75;
/// Of the logarithm of a factor, so that no step overshoots by far.
constexpr double LongestStep = 1.5;
/// The logarithm of the factor of links between surfaces, over that of links with clusters.
constexpr double Firmness = 0.1;
constexpr double Tolerance = 1e-5;
constexpr double SmallestFactor = 0.02;
/// A coarse row may have next to nothing: rays between clusters have missed what its element sees.
constexpr double LargestFactor = 64.0;

/// What a row may sum up to.
struct Range
{
  double least;
  double most;
};

/// What the probes say.
Range RangeOf(const OpenNode& node)
{
  const double seen = 1.0 - node.escaped;
  return { Pi * std::max(0.0, seen - node.escapeError),
    Pi * std::min(1.0, seen + node.escapeError) };
}

/// What closing has to know of a leaf.
struct Row
{
  OpenId id;
  double target;  ///< of the sum
  double largest; ///< of the factors
};

OfKinds<std::vector<double>> SumsOf(const LinkMatrix& matrix, const Closure& closure)
{
  return { matrix.Times(BetweenSurfaces, closure[BetweenSurfaces]),
    matrix.Times(WithCluster, closure[WithCluster]) };
}

/// Rows of which something is known.
std::vector<Row> RowsOf(const OpenTree& tree, const LinkMatrix& matrix)
{
  const std::vector<double> ones(matrix.Size(), 1.0);
  const OfKinds<std::vector<double>> sums = SumsOf(matrix, { ones, ones });
  std::vector<Row> rows;
  for (const LinkMatrix::Leaf& leaf : matrix.Leaves())
  {
    const OpenNode& node = tree[leaf.id];
    const Range range = RangeOf(node);
    const double sum = sums[BetweenSurfaces][leaf.id] + sums[WithCluster][leaf.id];
    if (sum > 0.0)
    {
      rows.push_back({ leaf.id, std::clamp(sum, range.least, range.most),
        node.IsUnprobed() ? 1.0 : LargestFactor });
    }
  }
  return rows;
}

/// Moves the factors of a leaf, whose links bring `sums` with them, by a step of Newton's method in
/// their logarithms. Returns by how much they changed.
double Move(const Row& row, const OfKinds<double>& sums, OfKinds<double*> factors)
{
  const double sum = sums[BetweenSurfaces] + sums[WithCluster];
  if (!(sum > 0.0)) // rows may be next to nothing
  {
    return 0.0;
  }
  const double slope = (Firmness * sums[BetweenSurfaces] + sums[WithCluster]) / sum;
  const double missing = 2.0 * (row.target - sum) / (row.target + sum);
  const double step = StepLength * missing / slope;
  double change = 0.0;
  for (const LinkKind kind : LinkKinds)
  {
    const double part =
      0.5 * std::clamp(kind == WithCluster ? step : Firmness * step, -LongestStep, LongestStep);
    const double last = *factors[kind];
    *factors[kind] = std::clamp(last * (1.0 + part) / (1.0 - part), SmallestFactor, row.largest);
    change = std::max(change, sums[kind] / sum * std::abs(*factors[kind] / last - 1.0));
  }
  return change;
}

} // namespace

void CloseRows(const OpenTree& tree, const LinkMatrix& matrix, Closure& closure)
{
  const std::vector<Row> rows = RowsOf(tree, matrix);
  const auto averageUp = [&]
  {
    for (std::vector<double>& factors : closure)
    {
      matrix.AverageUp(factors);
    }
  };
  averageUp();
  for (int iteration = 0; iteration < MostIterations; ++iteration)
  {
    const OfKinds<std::vector<double>> sums = SumsOf(matrix, closure);
    double change = 0.0;
    for (const Row& row : rows)
    {
      const OfKinds<double*> factors{ &closure[BetweenSurfaces][row.id],
        &closure[WithCluster][row.id] };
      change = std::max(change, Move(row,
                                  { *factors[BetweenSurfaces] * sums[BetweenSurfaces][row.id],
                                    *factors[WithCluster] * sums[WithCluster][row.id] },
                                  factors));
    }
    averageUp();
    if (change < Tolerance)
    {
      break;
    }
  }
}

} // namespace vantage
