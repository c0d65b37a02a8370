#include "report/HtmlPage.h"

#include "core/Error.h"

#include <fstream>
#include <iterator>
#include <vtkBase64Utilities.h>

namespace vantage
{

namespace
{

/// Colours are those of the reader's system, light or dark. What is wide scrolls in its own box.
const char* const Style = R"(
:root { color-scheme: light dark; }
body { margin: 0 auto; padding: 1rem; max-width: 70rem; background: Canvas; color: CanvasText;
  font: 1rem/1.5 system-ui, sans-serif; overflow-wrap: anywhere; }
h1 { font-size: 1.6rem; line-height: 1.2; margin-bottom: 0; }
h2 { font-size: 1.2rem; margin: 2rem 0 .5rem; }
img { display: block; max-width: 100%; height: auto; background: #fff; }
figure { margin: 1rem 0; }
figcaption, .subtitle { opacity: .8; font-size: .9rem; }
.side { display: grid; gap: 1rem; grid-template-columns: repeat(auto-fill, minmax(min(28rem, 100%), 1fr)); }
.side figure { margin: 0; }
.side img { width: 100%; image-rendering: pixelated; }
.scroll { overflow-x: auto; }
.scroll img { min-width: 44rem; }
table { border-spacing: 0; font-size: .9rem; font-variant-numeric: tabular-nums; }
th, td { padding: .25rem .6rem; border-top: 1px solid GrayText; text-align: right;
  white-space: nowrap; }
th { border-top: 0; }
th:first-child, td:first-child { text-align: left; position: sticky; left: 0; background: Canvas; }
summary { cursor: pointer; font-weight: bold; }
)";

std::string Escaped(const std::string& text)
{
  std::string html;
  for (const char c : text)
  {
    html += c == '&'   ? "&amp;"
            : c == '<' ? "&lt;"
            : c == '>' ? "&gt;"
            : c == '"' ? "&quot;"
                       : std::string(1, c);
  }
  return html;
}

std::string Element(const std::string& name, const std::string& text)
{
  return "<" + name + ">" + Escaped(text) + "</" + name + ">\n";
}

std::string DataUri(const std::string& path)
{
  std::ifstream file(path, std::ios::binary);
  const std::string bytes{ std::istreambuf_iterator<char>(file), {} };
  if (bytes.empty())
  {
    throw InputError(path + ": it cannot be read; run the same command again");
  }
  // Four characters for three bytes, or a part of them.
  std::string text(4 * ((bytes.size() + 2) / 3), '\0');
  const unsigned long length =
    vtkBase64Utilities::Encode(reinterpret_cast<const unsigned char*>(bytes.data()),
      static_cast<unsigned long>(bytes.size()), reinterpret_cast<unsigned char*>(text.data()));
  text.resize(length);
  return "data:image/png;base64," + text;
}

std::string Scrolling(const std::string& html)
{
  return "<div class=\"scroll\">" + html + "</div>";
}

std::string Print(const PageFigure& figure, bool isChart)
{
  const std::string image =
    "<img src=\"" + DataUri(figure.path) + "\" alt=\"" + Escaped(figure.caption) + "\">";
  return "<figure>" + (isChart ? Scrolling(image) : image) + Element("figcaption", figure.caption) +
         "</figure>\n";
}

std::string Print(const PageTable& table)
{
  std::string html = "<table>\n";
  for (std::size_t row = 0; row < table.cells.size(); ++row)
  {
    html += "<tr>";
    for (const std::string& cell : table.cells[row])
    {
      html += row == 0 ? "<th>" + Escaped(cell) + "</th>" : "<td>" + Escaped(cell) + "</td>";
    }
    html += "</tr>\n";
  }
  return "<figure>" + Element("figcaption", table.caption) + Scrolling(html + "</table>") +
         "</figure>\n";
}

std::string Print(const PageSection& section)
{
  std::string html = section.isFolded ? "<details>\n" + Element("summary", section.heading)
                                      : "<section>\n" + Element("h2", section.heading);
  for (const std::string& paragraph : section.paragraphs)
  {
    html += Element("p", paragraph);
  }
  for (const PageTable& table : section.tables)
  {
    html += Print(table);
  }
  html += section.isSideBySide ? "<div class=\"side\">\n" : "";
  for (const PageFigure& figure : section.figures)
  {
    html += Print(figure, section.hasCharts);
  }
  html += section.isSideBySide ? "</div>\n" : "";
  return html + (section.isFolded ? "</details>\n" : "</section>\n");
}

} // namespace

std::string PrintPage(const Page& page)
{
  std::string html = "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
                     "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n" +
                     Element("title", page.title) + "<style>" + Style +
                     "</style>\n</head>\n<body>\n" + Element("h1", page.title) +
                     "<p class=\"subtitle\">" + Escaped(page.subtitle) + "</p>\n";
  for (const PageSection& section : page.sections)
  {
    html += Print(section);
  }
  return html + "</body>\n</html>\n";
}

} // namespace vantage
