#include "apps/RunVantage.h"
#include "io/ExrFile.h"

#include <filesystem>
#include <gtest/gtest.h>
#include <map>
#include <nlohmann/json.hpp>
#include <sstream>
#include <vector>

namespace vantage
{
namespace
{

using test::BadCall;
using test::ReadText;
using test::RunResult;
using test::RunVantage;
using test::TemporaryFolder;

namespace fs = std::filesystem;

const std::vector<std::string> Methods = { "basic-shooting", "progressive-shooting",
  "importance-shooting", "goal-oriented", "gauss-seidel", "path-tracing" };

std::string MethodList()
{
  std::string list;
  for (const std::string& method : Methods)
  {
    list += ' ' + method;
  }
  return list;
}

/// A server: no display of any kind.
void ForgetDisplay()
{
  unsetenv("DISPLAY");
  unsetenv("WAYLAND_DISPLAY");
}

/// Two rooms, and what one of them looks like.
void MakeTwoRooms(const TemporaryFolder& folder)
{
  ForgetDisplay();
  ASSERT_EQ(RunVantage(folder, "labyrinth --rows 1 --columns 2 -o two.vtp").exitCode, 0);
  ASSERT_EQ(RunVantage(folder, "render two.vtp -o reference.exr --method path-tracing "
                               "--pixel-centres --samples-per-pixel 16 --size 24 18")
              .exitCode,
    0);
}

const std::string Quick = " --size 24 18 --reference reference.exr --errors 0.3 0.1 "
                          "--power-tolerances 3e-3 --samples 1 4";

using Table = std::vector<std::vector<std::string>>;

Table ReadTable(const std::string& path)
{
  Table table;
  std::istringstream csv(ReadText(path));
  for (std::string line; std::getline(csv, line);)
  {
    table.emplace_back(1);
    for (const char c : line)
    {
      if (c == ',')
      {
        table.back().emplace_back();
      }
      else
      {
        table.back().back() += c;
      }
    }
  }
  return table;
}

/// All columns but those of seconds, the last three.
Table WithoutTimes(Table table)
{
  for (std::vector<std::string>& row : table)
  {
    row.resize(row.size() - 3);
  }
  return table;
}

std::map<std::string, int> RowsByMethod(const Table& table)
{
  std::map<std::string, int> rows;
  for (std::size_t row = 1; row < table.size(); ++row)
  {
    ++rows[table[row][0]];
  }
  return rows;
}

std::size_t CountOf(const std::string& text, const std::string& part)
{
  std::size_t count = 0;
  for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1))
  {
    ++count;
  }
  return count;
}

/// Files with that ending, of the runs in a report.
std::vector<std::string> RunFiles(const std::string& folder, const std::string& ending)
{
  std::vector<std::string> files;
  for (const auto& entry : fs::directory_iterator(fs::path(folder) / "runs"))
  {
    const std::string path = entry.path().string();
    if (path.size() >= ending.size() && path.substr(path.size() - ending.size()) == ending)
    {
      files.push_back(path);
    }
  }
  return files;
}

void ExpectWholePage(const std::string& html)
{
  EXPECT_EQ(CountOf(html, "http:") + CountOf(html, "https:") + CountOf(html, "<script"), 0U);
  EXPECT_EQ(CountOf(html, "src="), CountOf(html, "src=\"data:image/png;base64,"));
  EXPECT_EQ(CountOf(html, "<link") + CountOf(html, "@import") + CountOf(html, "url("), 0U);
  // Charts; a picture and a difference of each method, and the reference; interactions of all but
  // path tracing.
  EXPECT_EQ(CountOf(html, "<img"), 4 + 2 * Methods.size() + 1 + Methods.size() - 1);
  EXPECT_EQ(CountOf(html, "<figure>"), CountOf(html, "</figure>"));
  EXPECT_EQ(CountOf(html, "<section>"), CountOf(html, "</section>"));
  EXPECT_EQ(CountOf(html, "<div class=\"scroll\">"), CountOf(html, "<table>") + 4);
  for (const char* phone : { "name=\"viewport\"", "max-width: 100%", "overflow-x: auto" })
  {
    EXPECT_NE(html.find(phone), std::string::npos) << phone;
  }
}

TEST(Report, ShowsEveryMethodAndGoesOnWhereItStood)
{
  const TemporaryFolder folder;
  MakeTwoRooms(folder);
  const std::string call = "report two.vtp -o new/out" + Quick + " --methods" + MethodList();
  const RunResult first = RunVantage(folder, call);
  ASSERT_EQ(first.exitCode, 0) << first.errors;
  EXPECT_EQ(first.errors, "");
  EXPECT_NE(first.output.find("0 of 6 runs were there"), std::string::npos) << first.output;

  const std::string out = folder / "new/out/";
  for (const std::string chart :
    { "cpu-seconds", "cpu-seconds-of-elements", "rays", "interactions" })
  {
    EXPECT_GT(fs::file_size(out + "error-vs-" + chart + ".png"), 1000U) << chart;
  }
  const Table table = ReadTable(out + "speed-vs-error.csv");
  auto rows = RowsByMethod(table);
  EXPECT_EQ(rows.size(), Methods.size());
  for (const std::string& method : Methods)
  {
    // Two errors, shown by elements and gathered; two numbers of samples.
    const bool isOnce = method == "goal-oriented" || method == "path-tracing";
    EXPECT_EQ(rows[method], isOnce ? 2 : 4) << method;
    EXPECT_TRUE(fs::exists(out + "images/" + method + ".png")) << method;
    EXPECT_TRUE(fs::exists(out + "images/" + method + "-difference.png")) << method;
    EXPECT_EQ(fs::exists(out + "interactions/" + method + ".png"), method != "path-tracing");
  }
  ExpectWholePage(ReadText(out + "index.html"));

  // Again: nothing is repeated, so times are the same as well.
  const std::string measured = ReadText(out + "speed-vs-error.csv");
  const RunResult again = RunVantage(folder, call);
  ASSERT_EQ(again.exitCode, 0) << again.errors;
  EXPECT_NE(again.output.find("6 of 6 runs were there"), std::string::npos) << again.output;
  EXPECT_EQ(ReadText(out + "speed-vs-error.csv"), measured);

  // A run whose picture is lost is repeated, and gives the same but for its times.
  fs::remove(RunFiles(out, "-1.png").front());
  const RunResult mended = RunVantage(folder, call);
  EXPECT_NE(mended.output.find("5 of 6 runs were there"), std::string::npos) << mended.output;
  const Table repeated = ReadTable(out + "speed-vs-error.csv");
  EXPECT_EQ(WithoutTimes(repeated), WithoutTimes(table));
  EXPECT_NE(repeated, table);
}

/// One thing is changed at a time; runs are their own only if nothing is.
TEST(Report, KeepsRunsApart)
{
  const TemporaryFolder folder;
  MakeTwoRooms(folder);
  const auto kept = [&](const std::string& arguments)
  {
    const RunResult result = RunVantage(folder, "report " + arguments + " --methods path-tracing");
    EXPECT_EQ(result.exitCode, 0) << result.errors;
    return result.output.substr(0, 6);
  };
  const std::string same = "two.vtp -o out" + Quick;
  EXPECT_EQ(kept(same), "0 of 1");
  EXPECT_EQ(kept(same), "1 of 1");
  EXPECT_EQ(kept(same + " --seed 2"), "0 of 1");
  EXPECT_EQ(kept(same + " --time 19"), "0 of 1");
  EXPECT_EQ(kept(same + " --camera view2"), "0 of 1");
  EXPECT_EQ(kept("two.vtp -o out --size 24 18 --reference reference.exr --samples 1"), "0 of 1");
  ASSERT_EQ(RunVantage(folder, "labyrinth --rows 1 --columns 2 --seed 7 -o two.vtp").exitCode, 0);
  EXPECT_EQ(kept(same), "0 of 1");
}

TEST(Report, MakesItsReferenceOnce)
{
  const TemporaryFolder folder;
  ForgetDisplay();
  test::WriteBox(folder);
  const std::string call = "report s.obj -o out --size 8 8 --errors 0.2 --methods goal-oriented "
                           "--reference-folder kept";
  const RunResult first = RunVantage(folder, call);
  ASSERT_EQ(first.exitCode, 0) << first.errors;
  std::map<std::string, fs::file_time_type> files;
  for (const auto& entry : fs::directory_iterator(folder / "kept"))
  {
    files[entry.path().string()] = entry.last_write_time();
  }
  EXPECT_EQ(files.size(), 2U); // two independent halves
  ASSERT_EQ(RunVantage(folder, call).exitCode, 0);
  for (const auto& [path, time] : files)
  {
    EXPECT_EQ(fs::last_write_time(path), time);
  }
  // The error is a true one: what was asked for is kept in a box.
  const Table table = ReadTable(folder / "out/speed-vs-error.csv");
  ASSERT_EQ(table.size(), 2U);
  EXPECT_EQ(table[0][10], "error");
  EXPECT_LT(std::stod(table[1][10]), 0.2);
}

/// The program is told to stop as soon as a file of that name is there.
int StopWhenThereIs(
  const TemporaryFolder& folder, const std::string& arguments, const std::string& pattern)
{
  const std::string script = "cd '" + (folder / ".") + "' && { '" VANTAGE_EXECUTABLE "' " +
                             arguments + " 2> errors & p=$!; until ls " + pattern +
                             " > /dev/null 2>&1; do sleep 0.02; done; kill -TERM $p; wait $p; }";
  const int status = std::system(script.c_str());
  return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

TEST(Report, KeepsWhatIsDoneWhenItIsStopped)
{
  const TemporaryFolder folder;
  MakeTwoRooms(folder);
  const std::string call = "report two.vtp -o out --size 24 18 --reference reference.exr --errors "
                           "0.3 --samples 1 1000000 --time 1 --methods goal-oriented path-tracing";
  constexpr int Terminated = 128 + 15;
  EXPECT_EQ(StopWhenThereIs(folder, call, "out/runs/path-tracing-*.json"), Terminated);
  const std::string errors = ReadText(folder / "errors");
  EXPECT_EQ(CountOf(errors, "\n"), 1U) << errors;
  EXPECT_NE(
    errors.find("out keeps 1 finished runs; give the same command again"), std::string::npos)
    << errors;
  EXPECT_FALSE(fs::exists(folder / "out/index.html"));
  const Table stopped = ReadTable(folder / "out/speed-vs-error.csv");
  auto rows = RowsByMethod(stopped);
  EXPECT_EQ(rows["goal-oriented"], 1);
  EXPECT_EQ(rows["path-tracing"], 1); // of the run that was stopped
  for (const std::string& file : RunFiles(folder / "out", ".json"))
  {
    const bool isGoal = file.find("goal-oriented") != std::string::npos;
    EXPECT_EQ(nlohmann::json::parse(ReadText(file))["finished"], isGoal) << file;
  }

  const RunResult resumed = RunVantage(folder, call);
  ASSERT_EQ(resumed.exitCode, 0) << resumed.errors;
  EXPECT_NE(resumed.output.find("1 of 2 runs were there"), std::string::npos) << resumed.output;
  const Table table = ReadTable(folder / "out/speed-vs-error.csv");
  ASSERT_EQ(table.size(), 4U);
  EXPECT_EQ(table[1], stopped[1]); // with its times
  EXPECT_EQ(table[3][4], "yes");   // a million samples were cut short
  EXPECT_TRUE(fs::exists(folder / "out/index.html"));
}

TEST(Report, StopsWhileItMakesTheReference)
{
  const TemporaryFolder folder;
  ForgetDisplay();
  test::WriteBox(folder);
  EXPECT_NE(StopWhenThereIs(folder, "report s.obj -o out --size 400 400 --quiet", "out"), 0);
  EXPECT_FALSE(fs::exists(folder / "out/speed-vs-error.csv"));
}

const BadCall BadCalls[] = {
  { "NoOutput", "s.obj", "--output" },
  { "NoSuchScene", "none.vtp -o out", "none.vtp: there is no such file" },
  { "NoCamera", "blind.obj -o out", "blind.obj: it has no camera" },
  { "OtherCamera", "s.obj -o out --camera left", "unknown camera 'left'" },
  { "OtherMethod", "s.obj -o out --methods photon-mapping", "unknown method 'photon-mapping'" },
  { "NoError", "s.obj -o out --errors 0.1 0", "--errors: 0 is out of range" },
  { "NoTolerance", "s.obj -o out --power-tolerances -1", "--power-tolerances: -1 is out of range" },
  { "NoSamples", "s.obj -o out --samples 0", "--samples: 0 is out of range" },
  { "NoTime", "s.obj -o out --time 0", "--time: 0 is out of range" },
  { "NegativeThreads", "s.obj -o out --threads -1", "--threads: -1 is out of range" },
  { "TooSmall", "s.obj -o out --size 4 100", "--size: 4 is out of range" },
  { "NoReference", "s.obj -o out --reference none.exr", "none.exr" },
  { "ReferenceOfScreen", "s.obj -o out --reference a.png", "a.png: unknown suffix" },
  { "ReferenceOfOtherSize", "s.obj -o out --size 9 8 --reference black.exr",
    "black.exr: it has 8 x 8" },
  { "BlackReference", "s.obj -o out --size 8 8 --reference black.exr", "reference: it is black" },
  { "FolderIsFile", "s.obj -o s.mtl", "s.mtl: cannot be made a folder" },
  { "NoSolution", "bright.obj -o out", "albedo" },
};

class ReportBadCall : public testing::TestWithParam<BadCall>
{
};

/// A closed box whose walls reflect everything has no solution.
void WriteBadScenes(const TemporaryFolder& folder)
{
  test::WriteBox(folder);
  const std::string box = ReadText(folder / "s.obj");
  folder.Write("blind.obj", box.substr(box.find('\n') + 1));
  std::string bright = box;
  bright.replace(bright.find("s.mtl"), 5, "b.mtl");
  folder.Write("bright.obj", bright);
  folder.Write("b.mtl", "newmtl wall\nKd 1 1 1\nnewmtl lamp\nKd 1 1 1\nKe 1 1 1\n");
  WriteExr(Image(8, 8), folder / "black.exr");
}

TEST_P(ReportBadCall, IsOneLineAndExitCode2)
{
  ForgetDisplay();
  const TemporaryFolder folder;
  WriteBadScenes(folder);
  const RunResult result =
    RunVantage(folder, std::string("report --quiet ") + GetParam().arguments);
  test::ExpectRefusal(result, GetParam().what);
  EXPECT_FALSE(fs::exists(folder / "out/index.html"));
}

INSTANTIATE_TEST_SUITE_P(Report, ReportBadCall, testing::ValuesIn(BadCalls),
  [](const auto& info) { return std::string(info.param.name); });

} // namespace
} // namespace vantage
