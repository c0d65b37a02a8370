#include "plates/PlateTable.h"

#include "TextTable.h"

#include <sstream>

namespace vantage
{

namespace
{

std::string Quoted(const std::string& text)
{
  return text.find(',') == std::string::npos ? text : '"' + text + '"';
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
