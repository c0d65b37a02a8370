#pragma once

#include "core/goal/Flow.h"

#include <cmath>
#include <utility>
#include <vector>

/// \file SolvedLinks.h
/// The equation of Flow.h solved directly, leaf by leaf: slow and obvious.

namespace vantage::test
{

inline Closure NoClosure(const OpenTree& tree)
{
  const std::vector<double> ones(tree.Size(), 1.0);
  return { ones, ones };
}

/// F_ik of the leaves as the links have it, row by row over all open nodes (0 for inner ones): a
/// link gives all leaves below one end the mean over the leaves below the other, times the
/// factors d of both.
inline std::vector<std::vector<double>> LeafFactors(
  const OpenTree& tree, const std::vector<Link>& links, const Closure& closure)
{
  std::vector<std::vector<OpenId>> leavesBelow(tree.Size());
  for (OpenId id = 0; id < tree.Size(); ++id)
  {
    for (OpenId up = id; tree[id].IsLeaf() && up != None; up = tree[up].parent)
    {
      leavesBelow[up].push_back(id);
    }
  }
  std::vector<std::vector<double>> factors(tree.Size(), std::vector<double>(tree.Size(), 0.0));
  const auto add = [&](const Link& link, OpenId to, OpenId from)
  {
    const std::vector<double>& d = closure[KindOf(tree, link)];
    for (const OpenId i : leavesBelow[to])
    {
      for (const OpenId k : leavesBelow[from])
      {
        factors[i][k] +=
          d[i] * link.throughput / tree[to].area * tree[k].area / tree[from].area * d[k];
      }
    }
  };
  for (const Link& link : links)
  {
    add(link, link.ends[0], link.ends[1]);
    if (!link.IsSelf())
    {
      add(link, link.ends[1], link.ends[0]);
    }
  }
  return factors;
}

/// Gauss with partial pivoting.
inline std::vector<double> SolveSystem(
  std::vector<std::vector<double>> matrix, std::vector<double> right)
{
  const std::size_t n = right.size();
  for (std::size_t column = 0; column < n; ++column)
  {
    std::size_t pivot = column;
    for (std::size_t row = column + 1; row < n; ++row)
    {
      pivot = std::abs(matrix[row][column]) > std::abs(matrix[pivot][column]) ? row : pivot;
    }
    std::swap(matrix[column], matrix[pivot]);
    std::swap(right[column], right[pivot]);
    for (std::size_t row = column + 1; row < n; ++row)
    {
      const double factor = matrix[row][column] / matrix[column][column];
      for (std::size_t k = column; k < n && factor != 0.0; ++k)
      {
        matrix[row][k] -= factor * matrix[column][k];
      }
      right[row] -= factor * right[column];
    }
  }
  for (std::size_t row = n; row-- > 0;)
  {
    for (std::size_t k = row + 1; k < n; ++k)
    {
      right[row] -= matrix[row][k] * right[k];
    }
    right[row] /= matrix[row][row];
  }
  return right;
}

/// Values of all open nodes, one channel: those of leaves from the system, 0 for others.
inline std::vector<double> SolveLeaves(const OpenTree& tree, const std::vector<Link>& links,
  const Closure& closure, const std::vector<Color>& sources, int channel)
{
  const std::vector<std::vector<double>> factors = LeafFactors(tree, links, closure);
  std::vector<std::vector<double>> matrix(tree.Size(), std::vector<double>(tree.Size(), 0.0));
  std::vector<double> right(tree.Size(), 0.0);
  for (OpenId i = 0; i < tree.Size(); ++i)
  {
    matrix[i][i] = 1.0;
    right[i] = tree[i].IsLeaf() ? sources[i][channel] : 0.0;
    for (OpenId k = 0; k < tree.Size(); ++k)
    {
      matrix[i][k] -= tree[i].albedo[channel] / Pi * factors[i][k];
    }
  }
  return SolveSystem(std::move(matrix), std::move(right));
}

} // namespace vantage::test
