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

/// Moves the factors of a row, where `sums` are what its links bring with factors of 1 at this end,
/// by a step of Newton's method in their logarithms. Returns by how much that changes the row.
double Move(const Row& row, const OfKinds<std::vector<double>>& sums, Closure& closure)
{
  const double known = closure[BetweenSurfaces][row.id] * sums[BetweenSurfaces][row.id];
  const double unknown = closure[WithCluster][row.id] * sums[WithCluster][row.id];
  const double sum = known + unknown;
  if (!(sum > 0.0)) // rows may be next to nothing
  {
    return 0.0;
  }
  const double missing = 2.0 * (row.target - sum) / (row.target + sum);
  const double step = StepLength * missing * sum / (Firmness * known + unknown);
  const auto move = [&row](double& factor, double logarithm)
  {
    const double half = 0.5 * std::clamp(logarithm, -LongestStep, LongestStep);
    const double last = factor;
    factor = std::clamp(last * (1.0 + half) / (1.0 - half), SmallestFactor, row.largest);
    return std::abs(factor / last - 1.0);
  };
  return std::max(known / sum * move(closure[BetweenSurfaces][row.id], Firmness * step),
    unknown / sum * move(closure[WithCluster][row.id], step));
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
      change = std::max(change, Move(row, sums, closure));
    }
    averageUp();
    if (change < Tolerance)
    {
      break;
    }
  }
}

} // namespace vantage
