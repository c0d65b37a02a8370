#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

/// \file TextTable.h
/// Numbers and tables for people.

namespace vantage
{

/// 1234567 as "1,234,567".
std::string Grouped(std::uint64_t number);

/// With so many digits after the point.
std::string Fixed(double number, int decimals);

/// With two significant digits, never as a power of ten: "0.031", "1.5", "240".
std::string TwoDigits(double number);

/// Rows of as many cells each as lines of text: words to the left, numbers to the right.
std::string AlignTable(const std::vector<std::vector<std::string>>& cells,
  const std::function<bool(std::size_t column)>& isNumberColumn);

} // namespace vantage
