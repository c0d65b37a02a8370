#include "core/goal/RowClosure.h"

#include <algorithm>
#include <cmath>

namespace vantage
{

namespace
{

/// Some ten are enough, unless rows cannot be closed within the bounds of the factors.
constexpr int MostIterations = 24;
/// Three quarters of the way to a factor, in its logarithm. As the other ends move as well, half of
/// it would be right where all of them lack the same; where every second one has too much, less is
/// left of a step.
double Step(double factor)
{
  const double half = std::sqrt(factor);
  return half * std::sqrt(half);
}

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
  double largest; ///< of the factor
};

/// Rows of which something is known.
std::vector<Row> RowsOf(const OpenTree& tree, const LinkMatrix& matrix)
{
  const std::vector<double> sums = matrix.Times(std::vector<double>(matrix.Size(), 1.0));
  std::vector<Row> rows;
  for (const LinkMatrix::Leaf& leaf : matrix.Leaves())
  {
    const OpenNode& node = tree[leaf.id];
    const Range range = RangeOf(node);
    if (sums[leaf.id] > 0.0)
    {
      rows.push_back({ leaf.id, std::clamp(sums[leaf.id], range.least, range.most),
        node.IsUnprobed() ? 1.0 : LargestFactor });
    }
  }
  return rows;
}

} // namespace

void CloseRows(const OpenTree& tree, const LinkMatrix& matrix, std::vector<double>& closure)
{
  const std::vector<Row> rows = RowsOf(tree, matrix);
  matrix.AverageUp(closure);
  for (int iteration = 0; iteration < MostIterations; ++iteration)
  {
    const std::vector<double> sums = matrix.Times(closure);
    double change = 0.0;
    for (const Row& row : rows)
    {
      const double last = closure[row.id];
      // Factors are never 0, but rows may be next to nothing.
      if (sums[row.id] > 0.0)
      {
        const double needed = row.target / (last * sums[row.id]);
        closure[row.id] = std::clamp(last * Step(needed), SmallestFactor, row.largest);
        change = std::max(change, std::abs(closure[row.id] - last));
      }
    }
    matrix.AverageUp(closure);
    if (change < Tolerance)
    {
      break;
    }
  }
}

} // namespace vantage
