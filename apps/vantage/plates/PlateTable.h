#pragma once

#include <cstdint>
#include <string>
#include <vector>

/// \file PlateTable.h
/// The figures beside the plates.

namespace vantage
{

/// One solution. Numbers of work count from where its camera was chosen.
struct PlateRow
{
  std::string plate;       ///< "1b"; empty for a solution that is not shown
  std::string description; ///< what was done
  std::uint64_t steps = 0;
  std::size_t elements = 0;
  std::size_t interactions = 0;
  std::uint64_t evaluations = 0; ///< of pairs of elements
  std::uint64_t rays = 0;
  double seconds = 0.0;
  double errorOfView1 = 0.0; ///< relative L1 against the path tracer, means over blocks of pixels
  double errorOfView2 = 0.0;
  std::string paper; ///< what Bekaert and Willems (1995) report of theirs
};

/// A header and a row for each; fields with commas are quoted.
std::string PrintPlateCsv(const std::vector<PlateRow>& rows);

/// The same for people: a header and a row for each, every row with as many cells.
std::vector<std::vector<std::string>> FormatPlateTable(const std::vector<PlateRow>& rows);

/// "7,000 elements, 14,500 interactions, 120.00 s".
std::string DescribeRow(const PlateRow& row);

/// Whether a column of the table is aligned to the right.
bool IsNumberColumn(std::size_t column);

} // namespace vantage
