#include "io/TextLines.h"

#include "core/Error.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <iterator>

namespace vantage
{

namespace
{

constexpr std::string_view WhiteSpace = " \t";

bool IsControl(char c)
{
  return (static_cast<unsigned char>(c) < ' ' && c != '\t') || c == '\x7f';
}

void SplitWords(std::string_view line, std::vector<std::string_view>& words)
{
  words.clear();
  std::size_t begin = line.find_first_not_of(WhiteSpace);
  while (begin != std::string_view::npos)
  {
    const std::size_t end = std::min(line.find_first_of(WhiteSpace, begin), line.size());
    words.push_back(line.substr(begin, end - begin));
    begin = line.find_first_not_of(WhiteSpace, end);
  }
}

} // namespace

TextLines::TextLines(const std::string& path)
  : PathName(path)
{
  std::error_code error;
  const std::filesystem::file_status status = std::filesystem::status(path, error);
  if (!std::filesystem::exists(status))
  {
    throw InputError(path + ": there is no such file; check the name");
  }
  std::ifstream file(path, std::ios::binary);
  // A device may go on for ever.
  const bool ends = std::filesystem::is_regular_file(status) || std::filesystem::is_fifo(status);
  if (!ends || !file)
  {
    throw InputError(path + ": this is no file that can be read; check name and permissions");
  }
  this->Text.assign(std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>());
  if (file.bad())
  {
    throw InputError(path + ": reading stopped halfway; check the disk and try again");
  }
}

bool TextLines::Next()
{
  while (this->Position < this->Text.size())
  {
    const std::size_t size = this->Text.size();
    const std::size_t end = std::min(this->Text.find_first_of("\r\n", this->Position), size);
    const std::string_view line(this->Text.data() + this->Position, end - this->Position);
    this->Position = end + (this->Text.compare(end, 2, "\r\n") == 0 ? 2 : 1);
    ++this->LineNumber;
    if (std::any_of(line.begin(), line.end(), IsControl))
    {
      this->Fail("there is a control character in this line", "remove it, if this is a text file");
    }
    SplitWords(line, this->CurrentWords);
    if (!this->CurrentWords.empty())
    {
      return true;
    }
  }
  return false;
}

bool TextLines::EndsAbruptly() const
{
  return !this->Text.empty() && this->Text.back() != '\n' && this->Text.back() != '\r';
}

std::string TextLines::Quoted(std::string_view word)
{
  constexpr std::size_t Longest = 60;
  const bool isCut = word.size() > Longest;
  return "'" + std::string(word.substr(0, Longest)) + (isCut ? "...'" : "'");
}

double TextLines::Number(std::size_t i) const
{
  if (i >= this->CurrentWords.size())
  {
    this->Fail("the line ends where a number is expected", "add the missing number");
  }
  std::string_view word = this->CurrentWords[i];
  if (word.size() > 1 && word.front() == '+' && word[1] != '-')
  {
    word.remove_prefix(1); // from_chars knows no plus sign
  }
  double x = 0.0;
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), x);
  const bool isWhole = end == word.data() + word.size();
  // Out of range is infinity for a number too large, but harmless for one too small.
  if (error == std::errc::result_out_of_range && isWhole && word.find("e-") != word.npos)
  {
    return 0.0;
  }
  if (error == std::errc::invalid_argument || !isWhole)
  {
    this->Fail(Quoted(this->CurrentWords[i]) + " is not a number", "write a number");
  }
  if (error != std::errc() || !std::isfinite(x))
  {
    this->Fail(Quoted(this->CurrentWords[i]) + " is not a finite number", "write a finite number");
  }
  return x;
}

Vec3 TextLines::Triple(std::size_t i) const
{
  const double x = this->Number(i);
  const double y = this->Number(i + 1);
  return { x, y, this->Number(i + 2) };
}

void TextLines::Fail(const std::string& what, const std::string& mend) const
{
  this->FailAt(this->LineNumber, what, mend);
}

void TextLines::FailAt(std::size_t line, const std::string& what, const std::string& mend) const
{
  throw InputError(this->PathName + ":" + std::to_string(line) + ": " + what + "; " + mend);
}

std::string PrintNumber(double x)
{
  std::array<char, 32> text;
  const auto [end, error] = std::to_chars(text.data(), text.data() + text.size(), x);
  return { text.data(), error == std::errc() ? end : text.data() };
}

std::string PrintTriple(const Vec3& v)
{
  return PrintNumber(v.x) + ' ' + PrintNumber(v.y) + ' ' + PrintNumber(v.z);
}

} // namespace vantage
