#include "apps/RunVantage.h"

#include <cmath>
#include <filesystem>
#include <gtest/gtest.h>
#include <map>
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

const std::vector<std::string> PlateNames = { "1a", "1b", "1c", "1d", "2a", "2b", "2c", "3a", "3b",
  "3c" };

/// A server: no display of any kind.
void ForgetDisplay()
{
  unsetenv("DISPLAY");
  unsetenv("WAYLAND_DISPLAY");
}

void MakeLabyrinth(const TemporaryFolder& folder)
{
  ASSERT_EQ(RunVantage(folder, "labyrinth --rows 1 --columns 2 -o two.vtp").exitCode, 0);
}

std::size_t CountFiles(const std::string& path)
{
  std::size_t count = 0;
  for (const auto& entry : std::filesystem::directory_iterator(path))
  {
    count += entry.is_regular_file() ? 1 : 0;
  }
  return count;
}

/// Width and height, from the header of a PNG file (ISO 15948: big-endian at byte 16).
std::pair<unsigned, unsigned> SizeOfPng(const std::string& path)
{
  const std::string bytes = ReadText(path);
  EXPECT_EQ(bytes.substr(1, 3), "PNG") << path;
  const auto number = [&](std::size_t at)
  {
    unsigned value = 0;
    for (std::size_t k = 0; k < 4 && at + k < bytes.size(); ++k)
    {
      value = 256 * value + static_cast<unsigned char>(bytes[at + k]);
    }
    return value;
  };
  return { number(16), number(20) };
}

/// How much brighter picture `a` is than `b`, relative to `b`.
double Bias(const TemporaryFolder& folder, const std::string& a, const std::string& b)
{
  const RunResult result = RunVantage(folder, "compare " + a + " " + b);
  EXPECT_EQ(result.exitCode, 0) << result.errors;
  const std::string label = "relative bias ";
  return std::stod(result.output.substr(result.output.find(label) + label.size()));
}

/// Rows of plates.csv by plate, as numbers by column name; words are left out.
std::map<std::string, std::map<std::string, double>> ReadTable(const std::string& path)
{
  std::istringstream csv(ReadText(path));
  std::vector<std::string> names;
  std::map<std::string, std::map<std::string, double>> rows;
  for (std::string line; std::getline(csv, line);)
  {
    std::vector<std::string> fields(1);
    bool isQuoted = false;
    for (const char c : line)
    {
      isQuoted = isQuoted != (c == '"');
      if (c == ',' && !isQuoted)
      {
        fields.emplace_back();
      }
      else if (c != '"')
      {
        fields.back() += c;
      }
    }
    if (names.empty())
    {
      names = fields;
      continue;
    }
    EXPECT_EQ(fields.size(), names.size()) << line;
    for (std::size_t k = 2; k + 1 < std::min(fields.size(), names.size()); ++k)
    {
      rows[fields[0]][names[k]] = std::stod(fields[k]);
    }
  }
  return rows;
}

TEST(Plates, AreAllMadeWithoutADisplay)
{
  ForgetDisplay();
  const TemporaryFolder folder;
  MakeLabyrinth(folder);
  const RunResult result =
    RunVantage(folder, "plates two.vtp -o new/out --size 96 72 --reference-samples 2");
  ASSERT_EQ(result.exitCode, 0) << result.errors;
  EXPECT_EQ(result.errors, "");
  EXPECT_NE(result.output.find("interactions"), std::string::npos);

  const std::string out = folder / "new/out/";
  EXPECT_EQ(CountFiles(out), PlateNames.size() + 2); // contact sheet and table, nothing temporary
  for (const std::string& name : PlateNames)
  {
    // Those with two panels have a gutter of a 24th of the width between them.
    const unsigned width = name == "2c" || name == "3c" ? 96 + 4 + 96 : 96;
    EXPECT_EQ(SizeOfPng(out + "plate-" + name + ".png"), std::make_pair(width, 72U)) << name;
  }
  EXPECT_GT(SizeOfPng(out + "contact-sheet.png").first, 2000U);

  // Light only ever becomes more, in the scene as in the view; lines are drawn on rooms.
  const auto plate = [](const std::string& name) { return "new/out/plate-" + name + ".png"; };
  EXPECT_GT(Bias(folder, plate("1c"), plate("1a")), 0.01);
  EXPECT_GT(Bias(folder, plate("2b"), plate("2a")), 0.01);
  EXPECT_NE(Bias(folder, plate("1d"), plate("1b")), 0.0);
}

TEST(Plates, TableTellsWhatImportanceIsGoodFor)
{
  ForgetDisplay();
  const TemporaryFolder folder;
  ASSERT_EQ(RunVantage(folder, "labyrinth --rows 2 --columns 2 -o four.vtp").exitCode, 0);
  const RunResult result =
    RunVantage(folder, "plates four.vtp -o out --size 64 48 --reference-samples 8 --quiet");
  ASSERT_EQ(result.exitCode, 0) << result.errors;
  EXPECT_EQ(result.output + result.errors, "");

  auto rows = ReadTable(folder / "out/plates.csv");
  ASSERT_EQ(rows.size(), 8U);
  EXPECT_EQ(rows["1a"]["steps"], 0.0);
  EXPECT_EQ(rows["1b"]["steps"], 60.0);
  EXPECT_LT(rows["1b"]["errorOfView1"], rows["1a"]["errorOfView1"]);
  EXPECT_LT(rows["2b"]["errorOfView1"], rows["2a"]["errorOfView1"]);
  EXPECT_LT(rows["3b"]["errorOfView2"], rows["2b"]["errorOfView2"]);
  // The same part is left unshot, but only for the view.
  EXPECT_LT(rows["2b"]["evaluations"], rows[""]["evaluations"]);
  // Interactions of the first view are kept for the second one.
  EXPECT_GE(rows["3a"]["interactions"], rows["2b"]["interactions"]);
  for (auto& [plate, row] : rows)
  {
    for (const auto& [name, value] : row)
    {
      EXPECT_TRUE(std::isfinite(value) && value >= 0.0) << plate << ' ' << name;
    }
  }
}

const BadCall BadCalls[] = {
  { "NoOutput", "plates two.vtp", "--output" },
  { "NoSuchScene", "plates none.vtp -o out", "none.vtp: there is no such file" },
  { "NoViews", "plates s.obj -o out", "it has no camera 'view1'" },
  { "NoOverview", "plates views.obj -o out", "it has no camera 'overview'" },
  { "NoLight", "plates dark.obj -o out", "nothing in it emits light" },
  { "NoWidth", "plates two.vtp -o out --size 0 48", "--size: width 0" },
  { "TooHigh", "plates two.vtp -o out --size 64 100000", "--size: height 100000" },
  { "OneSample", "plates two.vtp -o out --reference-samples 1", "--reference-samples: 1" },
  { "FolderIsFile", "plates two.vtp -o two.vtp", "two.vtp: cannot be made a folder" },
  { "NoSolution", "plates bright.obj -o out", "albedo" },
};

class PlatesBadCall : public testing::TestWithParam<BadCall>
{
};

/// A closed box whose walls reflect everything has no solution.
void WriteBadScenes(const TemporaryFolder& folder)
{
  test::WriteBox(folder);
  const std::string box = ReadText(folder / "s.obj");
  const std::string camera = " eye -.9 0 0 look-at 1 0 -.2 up 0 0 1 fov 60 aspect 1\n";
  const std::string views = "# camera view1" + camera + "# camera view2" + camera;
  folder.Write("views.obj", views + box);
  std::string dark = views + "# camera overview" + camera + box;
  dark.replace(dark.find("usemtl lamp"), 11, "usemtl wall");
  folder.Write("dark.obj", dark);
  std::string bright = views + "# camera overview" + camera + box;
  bright.replace(bright.find("s.mtl"), 5, "b.mtl");
  folder.Write("bright.obj", bright);
  folder.Write("b.mtl", "newmtl wall\nKd 1 1 1\nnewmtl lamp\nKd 1 1 1\nKe 1 1 1\n");
}

TEST_P(PlatesBadCall, IsOneLineAndExitCode2)
{
  ForgetDisplay();
  const TemporaryFolder folder;
  MakeLabyrinth(folder);
  WriteBadScenes(folder);
  const RunResult result = RunVantage(folder, GetParam().arguments);
  test::ExpectRefusal(result, GetParam().what);
  EXPECT_TRUE(!std::filesystem::exists(folder / "out") || CountFiles(folder / "out") == 0);
}

INSTANTIATE_TEST_SUITE_P(Plates, PlatesBadCall, testing::ValuesIn(BadCalls),
  [](const auto& info) { return std::string(info.param.name); });

TEST(Plates, MachineWithoutOpenGlIsOneLineAndExitCode2)
{
  ForgetDisplay();
  const TemporaryFolder folder;
  MakeLabyrinth(folder);
  // Where the loader of EGL looks for drivers; then it finds none.
  setenv("__EGL_VENDOR_LIBRARY_DIRS", (folder / "none").c_str(), 1);
  const RunResult result = RunVantage(folder, "plates two.vtp -o out");
  unsetenv("__EGL_VENDOR_LIBRARY_DIRS");
  EXPECT_EQ(result.exitCode, 2);
  EXPECT_EQ(result.ErrorLines(), 1) << result.errors;
  EXPECT_NE(result.errors.find("OpenGL"), std::string::npos) << result.errors;
  EXPECT_FALSE(std::filesystem::exists(folder / "out"));
}

} // namespace
} // namespace vantage
