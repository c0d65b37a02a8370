#pragma once

#include "core/math/Types.h"

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

/// \file TextLines.h
/// A text file read line by line and word by word, strictly, by someone who always knows where.

namespace vantage
{

/// Lines of a text file, split at blanks and tabs; they end as on any system. Every complaint is an
/// InputError of the form "file:line: what; mend".
class TextLines
{
public:
  /// \throw InputError when the file does not exist or cannot be read.
  explicit TextLines(const std::string& path);

  /// Goes to the next line that has a word; false at the end. \throw InputError when the line has
  /// control characters: others would split it elsewhere, or write what it says to a terminal.
  bool Next();

  /// The words of the line, valid until the next call of Next().
  const std::vector<std::string_view>& Words() const { return this->CurrentWords; }
  std::size_t Line() const { return this->LineNumber; }
  const std::string& Path() const { return this->PathName; }

  /// Whether the last line lacks its line end, as in a file that was cut off.
  bool EndsAbruptly() const;

  /// A word to complain about: in quotes, and cut off when it is very long.
  static std::string Quoted(std::string_view word);

  /// Word i as a finite number, correctly rounded. \throw InputError when it is none or missing.
  double Number(std::size_t i) const;
  /// Words i, i + 1, i + 2.
  Vec3 Triple(std::size_t i) const;

  [[noreturn]] void Fail(const std::string& what, const std::string& mend) const;
  [[noreturn]] void FailAt(
    std::size_t line, const std::string& what, const std::string& mend) const;

private:
  std::string PathName;
  std::string Text;
  std::size_t Position = 0;
  std::size_t LineNumber = 0;
  std::vector<std::string_view> CurrentWords;
};

/// The shortest decimal number that reads back to the same bits.
std::string PrintNumber(double x);
/// Three of them with blanks in between.
std::string PrintTriple(const Vec3& v);

} // namespace vantage
