#include "TextTable.h"

#include <algorithm>
#include <cmath>
#include <iomanip>
#include <sstream>

namespace vantage
{

namespace
{

/// Characters, not bytes: of UTF-8 the bytes that begin one.
std::size_t LengthOf(const std::string& text)
{
  return static_cast<std::size_t>(std::count_if(
    text.begin(), text.end(), [](char c) { return (static_cast<unsigned char>(c) >> 6) != 2; }));
}

} // namespace

std::string Grouped(std::uint64_t number)
{
  std::string digits = std::to_string(number);
  for (int place = static_cast<int>(digits.size()) - 3; place > 0; place -= 3)
  {
    digits.insert(static_cast<std::size_t>(place), ",");
  }
  return digits;
}

std::string Fixed(double number, int decimals)
{
  std::ostringstream text;
  text << std::fixed << std::setprecision(decimals) << number;
  return text.str();
}

std::string TwoDigits(double number)
{
  if (!(number > 0.0))
  {
    return "0";
  }
  // Of what is left after rounding: 9.96 has the two digits of 10.
  int decimals = 1 - static_cast<int>(std::floor(std::log10(number)));
  const double rounded = std::round(number * std::pow(10.0, decimals)) * std::pow(10.0, -decimals);
  decimals = 1 - static_cast<int>(std::floor(std::log10(rounded * (1.0 + 1e-9))));
  if (decimals <= 0)
  {
    return Grouped(static_cast<std::uint64_t>(std::llround(rounded)));
  }
  return Fixed(rounded, decimals);
}

std::string AlignTable(const std::vector<std::vector<std::string>>& cells,
  const std::function<bool(std::size_t column)>& isNumberColumn)
{
  std::ostringstream text;
  for (const std::vector<std::string>& row : cells)
  {
    std::string line;
    for (std::size_t column = 0; column < row.size(); ++column)
    {
      std::size_t width = 0;
      for (const std::vector<std::string>& other : cells)
      {
        width = std::max(width, LengthOf(other[column]));
      }
      const std::string padding(width - LengthOf(row[column]), ' ');
      line += (column == 0 ? "" : "  ");
      line += isNumberColumn(column) ? padding + row[column] : row[column] + padding;
    }
    line.erase(line.find_last_not_of(' ') + 1);
    text << line << '\n';
  }
  return text.str();
}

} // namespace vantage
