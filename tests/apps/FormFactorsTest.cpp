#include "apps/RunVantage.h"

#include <gtest/gtest.h>
#include <sstream>
#include <vector>

namespace vantage
{
namespace
{

using test::RunVantage;
using test::TemporaryFolder;

using Matrix = std::vector<std::vector<double>>;

/// The matrix of a file, n x n; zeros and a failed test when it has another size.
Matrix ReadMatrix(const std::string& path, std::size_t n)
{
  Matrix rows;
  std::istringstream text(test::ReadText(path));
  for (std::string line; std::getline(text, line);)
  {
    std::istringstream cells(line);
    rows.emplace_back();
    for (std::string cell; std::getline(cells, cell, ',');)
    {
      rows.back().push_back(std::stod(cell));
    }
    EXPECT_EQ(rows.back().size(), n);
    rows.back().resize(n);
  }
  EXPECT_EQ(rows.size(), n);
  rows.resize(n, std::vector<double>(n));
  return rows;
}

/// Form factors between the n polygons of an OBJ file.
Matrix FormFactorsOf(const std::string& obj, std::size_t n)
{
  const TemporaryFolder folder;
  folder.Write("s.obj", obj);
  const test::RunResult run = RunVantage(folder, "form-factors s.obj -o f.csv");
  EXPECT_EQ(run.exitCode, 0);
  EXPECT_EQ(run.errors, "");
  return ReadMatrix(folder / "f.csv", n);
}

// Relative error that the accuracy ladder promises: 1e-5 free, 1e-4 with occluders.
constexpr double Free = 1e-5;
constexpr double Occluded = 1e-4;

const std::string FacingSquares = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n"
                                  "v 0 0 1\nv 0 1 1\nv 1 1 1\nv 1 0 1\n"
                                  "f 1 2 3 4\nf 5 6 7 8\n";

TEST(FormFactors, ParallelSquares)
{
  const auto f = FormFactorsOf(FacingSquares, 2);
  EXPECT_EQ(f[0][0], 0.0);
  EXPECT_EQ(f[1][1], 0.0);
  EXPECT_NEAR(f[0][1], 0.199824895698387, Free);
  EXPECT_NEAR(f[1][0], 0.199824895698387, Free);
}

TEST(FormFactors, BacksDoNotExchangeLight)
{
  const auto f = FormFactorsOf("v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n"
                               "v 0 0 1\nv 0 1 1\nv 1 1 1\nv 1 0 1\n"
                               "f 4 3 2 1\nf 5 6 7 8\n",
    2);
  EXPECT_EQ(f[0][1], 0.0);
  EXPECT_EQ(f[1][0], 0.0);
}

TEST(FormFactors, AnOccluderInBetween)
{
  const auto f =
    FormFactorsOf(FacingSquares + "v 0 0 .5\nv .5 0 .5\nv .5 .5 .5\nv 0 .5 .5\nf -4 -3 -2 -1\n", 3);
  EXPECT_NEAR(f[0][1], 0.149868671773790, Occluded * 0.15);
  EXPECT_EQ(f[0][2], 0.0); // it faces away from the first square
  EXPECT_GT(f[1][2], 0.0);
}

TEST(FormFactors, RowsAreInTheOrderOfTheInputAndPolygonsMayBeOfAnyShape)
{
  // A square of area 4 as an L of three unit squares and the fourth, facing one of area 4.
  const auto f = FormFactorsOf("v 0 0 2\nv 0 2 2\nv 2 2 2\nv 2 0 2\n"
                               "v 0 0 0\nv 2 0 0\nv 2 1 0\nv 1 1 0\nv 1 2 0\nv 0 2 0\nv 2 2 0\n"
                               "f 1 2 3 4\nf 5 6 7 8 9 10\nf 8 7 11 9\n",
    3);
  // The whole sees as much as its parts do, and reciprocity: A F = A' F'.
  EXPECT_NEAR(f[0][1] + f[0][2], 0.199824895698387, Free);
  EXPECT_NEAR(3.0 * f[1][0], 4.0 * f[0][1], Free);
  EXPECT_NEAR(1.0 * f[2][0], 4.0 * f[0][2], Free);
}

TEST(FormFactors, RowsOfAClosedBoxSumToOne)
{
  const TemporaryFolder folder;
  test::WriteBox(folder);
  // Without the lamp, whose back is not the front of any polygon.
  std::string obj = test::ReadText(folder / "s.obj");
  folder.Write("s.obj", obj.substr(0, obj.find("usemtl lamp")));
  EXPECT_EQ(RunVantage(folder, "form-factors s.obj -o f.csv").exitCode, 0);
  const auto f = ReadMatrix(folder / "f.csv", 6);
  for (const std::vector<double>& row : f)
  {
    double sum = 0.0;
    for (const double x : row)
    {
      sum += x;
    }
    EXPECT_NEAR(sum, 1.0, Free);
  }
}

} // namespace
} // namespace vantage
