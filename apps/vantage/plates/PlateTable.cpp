#include "plates/PlateTable.h"

#include <algorithm>
#include <iomanip>
#include <sstream>

namespace vantage
{

namespace
{

/// 1234567 as "1,234,567".
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

std::string Quoted(const std::string& text)
{
  return text.find(',') == std::string::npos ? text : '"' + text + '"';
}

/// Characters, not bytes: of UTF-8 the bytes that begin one.
std::size_t LengthOf(const std::string& text)
{
  return static_cast<std::size_t>(std::count_if(
    text.begin(), text.end(), [](char c) { return (static_cast<unsigned char>(c) >> 6) != 2; }));
}

} // namespace

std::string PrintPlateCsv(const std::vector<PlateRow>& rows)
{
  std::ostringstream csv;
  csv << "plate,description,steps,elements,interactions,evaluations,rays,seconds,errorOfView1,"
         "errorOfView2,paper\n";
  for (const PlateRow& row : rows)
  {
    csv << row.plate << ',' << Quoted(row.description) << ',' << row.steps << ',' << row.elements
        << ',' << row.interactions << ',' << row.evaluations << ',' << row.rays << ','
        << row.seconds << ',' << row.errorOfView1 << ',' << row.errorOfView2 << ','
        << Quoted(row.paper) << '\n';
  }
  return csv.str();
}

std::vector<std::vector<std::string>> FormatPlateTable(const std::vector<PlateRow>& rows)
{
  std::vector<std::vector<std::string>> cells = { { "plate", "solution", "steps", "elements",
    "interactions", "evaluations", "rays", "seconds", "error of view 1", "error of view 2",
    "in the paper" } };
  for (const PlateRow& row : rows)
  {
    cells.push_back({ row.plate, row.description, Grouped(row.steps), Grouped(row.elements),
      Grouped(row.interactions), Grouped(row.evaluations), Grouped(row.rays), Fixed(row.seconds, 2),
      Fixed(100.0 * row.errorOfView1, 1) + " %", Fixed(100.0 * row.errorOfView2, 1) + " %",
      row.paper });
  }
  return cells;
}

std::string AlignTable(const std::vector<std::vector<std::string>>& cells)
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
      line += IsNumberColumn(column) ? padding + row[column] : row[column] + padding;
    }
    line.erase(line.find_last_not_of(' ') + 1);
    text << line << '\n';
  }
  return text.str();
}

std::string DescribeRow(const PlateRow& row)
{
  return Grouped(row.elements) + " elements, " + Grouped(row.interactions) + " interactions, " +
         Fixed(row.seconds, 2) + " s";
}

bool IsNumberColumn(std::size_t column)
{
  return column >= 2 && column <= 9;
}

} // namespace vantage
