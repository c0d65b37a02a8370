#pragma once

#include <string>
#include <vector>

/// \file HtmlPage.h
/// A page that is one file: pictures inside, nothing loaded from elsewhere, readable on a phone.

namespace vantage
{

/// A picture with a caption; the file is read when the page is printed.
struct PageFigure
{
  std::string path; ///< .png
  std::string caption;
};

/// Rows of as many cells, the first is the header, the first column words.
struct PageTable
{
  std::string caption;
  std::vector<std::vector<std::string>> cells;
};

/// A heading, then paragraphs, tables and figures in that order.
struct PageSection
{
  std::string heading;
  std::vector<std::string> paragraphs;
  std::vector<PageTable> tables;
  std::vector<PageFigure> figures;
  bool isSideBySide = false; ///< figures, two in a row where there is room, enlarged
  bool hasCharts = false;    ///< figures have text in them: they scroll where they would shrink
  bool isFolded = false;     ///< opened when it is asked for
};

struct Page
{
  std::string title;
  std::string subtitle;
  std::vector<PageSection> sections;
};

/// HTML 5. All texts are escaped. \throw InputError when a picture cannot be read.
std::string PrintPage(const Page& page);

} // namespace vantage
