#pragma once

#include "core/Solver.h"

#include <gtest/gtest.h>

/// \file Found.h
/// What must be the same to the bit, however the work was shared and the faces were numbered.

namespace vantage::test
{

/// What a solver finds, and how it came there.
struct Found
{
  std::vector<Color> radiance;   ///< of polygon sides
  std::vector<Color> importance; ///< of polygon sides
  std::vector<double> history;   ///< flux, error, elements, interactions and rays of every step
};

Found FoundBy(const Solver& solver);

/// To the bit. `order` has the polygon of the expected scene that each polygon of the found one is.
testing::AssertionResult IsSame(
  const Found& found, const Found& expected, const std::vector<std::size_t>& order);

} // namespace vantage::test
