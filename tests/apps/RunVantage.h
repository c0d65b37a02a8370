#pragma once

#include "io/Files.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <string>
#include <sys/wait.h>

/// \file RunVantage.h
/// The built program, run as a user would.

namespace vantage::test
{

struct RunResult
{
  int exitCode = -1;
  std::string output; ///< standard output
  std::string errors; ///< standard error

  /// Number of lines on standard error, each of which ends.
  auto ErrorLines() const { return std::count(this->errors.begin(), this->errors.end(), '\n'); }
};

/// Runs `vantage ARGUMENTS` through the shell, in the folder.
inline RunResult RunVantage(const TemporaryFolder& folder, const std::string& arguments)
{
  const TemporaryFolder logs;
  const std::string command = "cd '" + (folder / ".") + "' && '" VANTAGE_EXECUTABLE "' " +
                              arguments + " > '" + (logs / "out") + "' 2> '" + (logs / "err") + "'";
  const int status = std::system(command.c_str());
  RunResult result;
  result.exitCode = WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  result.output = ReadText(logs / "out");
  result.errors = ReadText(logs / "err");
  return result;
}

/// Arguments that are wrong in one way; each is refused with one line that says so.
struct BadCall
{
  const char* name;
  const char* arguments;
  const char* what;
};

inline void PrintTo(const BadCall& call, std::ostream* stream)
{
  *stream << call.arguments;
}

inline void ExpectRefusal(const RunResult& result, const std::string& what)
{
  EXPECT_EQ(result.exitCode, 2);
  EXPECT_EQ(result.output, "");
  EXPECT_EQ(result.ErrorLines(), 1) << result.errors;
  EXPECT_NE(result.errors.find(what), std::string::npos) << result.errors;
}

/// A closed box of 2 x 2 x 2 with a lamp below its ceiling and a camera, as s.obj and s.mtl.
inline void WriteBox(const TemporaryFolder& folder, const std::string& emission = "10 10 10")
{
  folder.Write("s.mtl", "newmtl wall\nKd .5 .5 .5\nnewmtl lamp\nKd 0 0 0\nKe " + emission + "\n");
  folder.Write("s.obj",
    "# camera main eye -.9 0 0 look-at 1 0 -.2 up 0 0 1 fov 60 aspect 1\nmtllib s.mtl\n"
    "v -1 -1 -1\nv 1 -1 -1\nv 1 1 -1\nv -1 1 -1\nv -1 -1 1\nv 1 -1 1\nv 1 1 1\nv -1 1 1\n"
    "v -.3 -.3 .9\nv -.3 .3 .9\nv .3 .3 .9\nv .3 -.3 .9\n"
    "usemtl wall\nf 1 2 3 4\nf 5 8 7 6\nf 1 5 6 2\nf 2 6 7 3\nf 3 7 8 4\nf 4 8 5 1\n"
    "usemtl lamp\nf 9 10 11 12\n");
}

} // namespace vantage::test
