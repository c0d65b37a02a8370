#include "apps/RunVantage.h"
#include "core/math/Image.h"
#include "io/ExrFile.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace vantage
{
namespace
{

using test::RunResult;
using test::RunVantage;
using test::TemporaryFolder;

constexpr const char* Small = " --size 24 16 --maximum-level 2 ";

RunResult Render(const TemporaryFolder& folder, const std::string& arguments)
{
  return RunVantage(folder, "render s.obj" + std::string(Small) + arguments);
}

TEST(Render, WritesEveryKindOfOutput)
{
  const TemporaryFolder folder;
  test::WriteBox(folder);
  const RunResult run =
    Render(folder, "-o a.png a.exr a.vti a.vtp --links l.vtp --history h.csv --report r.json");
  EXPECT_EQ(run.exitCode, 0);
  EXPECT_EQ(run.errors, "");
  EXPECT_EQ(run.output, "");
  EXPECT_EQ(folder.FileCount(), 2u + 7u);
  EXPECT_EQ(test::ReadText(folder / "a.png").substr(1, 3), "PNG");
  EXPECT_NE(test::ReadText(folder / "l.vtp").find("PolyData"), std::string::npos);
  // .exr and .vti hold the same floats.
  const RunResult compare = RunVantage(folder, "compare a.exr a.vti --tolerance 0");
  EXPECT_EQ(compare.exitCode, 0) << compare.output;
  // The elements are a scene themselves, as bright as their lamp.
  const RunResult info = RunVantage(folder, "info a.vtp");
  EXPECT_EQ(info.exitCode, 0) << info.errors;
}

TEST(Render, ReportHoldsWhatWasDone)
{
  const TemporaryFolder folder;
  test::WriteBox(folder);
  // Elements may be as small as the error asks for.
  const RunResult run =
    RunVantage(folder, "render s.obj --size 24 16 --history h.csv --report r.json --threads 1");
  ASSERT_EQ(run.exitCode, 0) << run.errors;
  const nlohmann::json report = nlohmann::json::parse(test::ReadText(folder / "r.json"));
  EXPECT_EQ(report["method"], "goal-oriented");
  EXPECT_GT(report["work"]["surfacePairs"], 0);
  EXPECT_GT(report["work"]["sweeps"], 0);
  EXPECT_GT(report["viewFlux"], 0.0);
  EXPECT_LE(report["errorEstimate"], 0.01);
  EXPECT_GE(report["elements"], 7);
  EXPECT_GT(report["interactions"], 0);
  EXPECT_GT(report["rays"], 0);
  EXPECT_EQ(report["threads"], 1);
  EXPECT_GT(report["peakMemoryBytes"], 1000000);
  double sum = 0.0;
  for (const char* phase : { "load", "build", "solve", "image" })
  {
    sum += report["seconds"][phase].get<double>();
  }
  EXPECT_GE(report["seconds"]["total"].get<double>(), sum);
  const std::string history = test::ReadText(folder / "h.csv");
  const auto rows = std::count(history.begin(), history.end(), '\n');
  EXPECT_EQ(static_cast<std::uint64_t>(rows), 1 + report["steps"].get<std::uint64_t>());
}

TEST(Render, EachFurtherCameraCostsLessThanTheFirst)
{
  const TemporaryFolder folder;
  test::WriteBox(folder);
  folder.Write("walk.txt",
    "a walk\n"
    "# camera first eye -.9 0 0 look-at 1 0 -.2 up 0 0 1 fov 60 aspect 1\n"
    "# camera second eye -.8 0 0 look-at 1 .1 -.2 up 0 0 1 fov 60 aspect 1\n"
    "# camera third eye -.7 .1 0 look-at 1 .2 -.2 up 0 0 1 fov 60 aspect 1\n");
  const RunResult run = RunVantage(folder,
    "render s.obj --size 24 16 --error 0.05 --walk walk.txt -o a.exr --history h.csv "
    "--report r.json");
  ASSERT_EQ(run.exitCode, 0) << run.errors;
  for (const char* name : { "a-0001.exr", "a-0002.exr", "a-0003.exr" })
  {
    EXPECT_TRUE(std::filesystem::exists(folder / name)) << name;
  }
  EXPECT_FALSE(std::filesystem::exists(folder / "a.exr"));
  const nlohmann::json report = nlohmann::json::parse(test::ReadText(folder / "r.json"));
  ASSERT_EQ(report["frames"].size(), 3u);
  EXPECT_EQ(report["frames"][2]["camera"], "third");
  std::uint64_t steps = 0;
  for (const nlohmann::json& frame : report["frames"])
  {
    EXPECT_LE(frame["errorEstimate"], 0.05);
    EXPECT_GT(frame["gather"]["gatherRays"], 0);
    steps += frame["steps"].get<std::uint64_t>();
  }
  EXPECT_EQ(report["steps"], steps);
  for (int k : { 1, 2 })
  {
    EXPECT_LT(report["frames"][k]["evaluations"], report["frames"][0]["evaluations"]);
  }
  const std::string history = test::ReadText(folder / "h.csv");
  EXPECT_EQ(history.rfind("frame,step,", 0), 0u);
  for (const char* row : { "\n1,1,", "\n2,", "\n3," })
  {
    EXPECT_NE(history.find(row), std::string::npos) << row;
  }
  // The second frame is what a run for it alone shows, within what was asked of both.
  ASSERT_EQ(
    RunVantage(folder, "render s.obj --size 24 16 --error 0.05 --eye -.8 0 0 --look-at 1 .1 -.2 "
                       "-o b.exr")
      .exitCode,
    0);
  EXPECT_EQ(RunVantage(folder, "compare a-0002.exr b.exr --tolerance 0.07").exitCode, 0);
}

TEST(Render, CamerasAreGivenByNameAsOftenAsOneLikes)
{
  const TemporaryFolder folder;
  test::WriteBox(folder);
  const RunResult run = Render(folder, "--error 0.2 --camera main --camera main -o a.exr");
  ASSERT_EQ(run.exitCode, 0) << run.errors;
  EXPECT_EQ(RunVantage(folder, "compare a-0001.exr a-0002.exr --tolerance 0.2").exitCode, 0);
}

TEST(Render, AnErrorBelowWhatAGatherCanPromiseIsNoMistake)
{
  const TemporaryFolder folder;
  test::WriteBox(folder);
  EXPECT_EQ(Render(folder, "--error 0.0001 --steps 3 -o a.exr").exitCode, 0);
}

TEST(Render, StopsAfterTheStepsAskedFor)
{
  const TemporaryFolder folder;
  test::WriteBox(folder);
  ASSERT_EQ(Render(folder, "--steps 3 --report r.json").exitCode, 0);
  EXPECT_EQ(nlohmann::json::parse(test::ReadText(folder / "r.json"))["steps"], 3);
}

TEST(Render, PathTracingTakesAsManySamplesAsAreAskedFor)
{
  const TemporaryFolder folder;
  test::WriteBox(folder);
  const auto samplesOf = [&](const std::string& budget)
  {
    EXPECT_EQ(
      Render(folder, "-o a.exr --report r.json --method path-tracing " + budget).exitCode, 0);
    return nlohmann::json::parse(test::ReadText(folder / "r.json"))["steps"].get<int>();
  };
  EXPECT_EQ(samplesOf(""), 64);
  EXPECT_EQ(samplesOf("--steps 100"), 100);
  EXPECT_EQ(samplesOf("--steps 100 --samples-per-pixel 7"), 7);
  EXPECT_EQ(samplesOf("--steps 3 --samples-per-pixel 7"), 3);
  EXPECT_EQ(samplesOf("--time 100 --steps 3"), 3);
}

TEST(Render, AWalkHasOneExposure)
{
  const TemporaryFolder folder;
  test::WriteBox(folder);
  const auto exposureOf = [&](const std::string& arguments)
  {
    EXPECT_EQ(Render(folder, arguments + " --report r.json").exitCode, 0);
    return nlohmann::json::parse(test::ReadText(folder / "r.json"))["exposure"];
  };
  const double automatic = exposureOf("-o a.png");
  EXPECT_EQ(exposureOf("-o a.png --exposure 2.5"), 2.5);
  EXPECT_TRUE(exposureOf("--steps 1").is_null());
  // The same room seen by another camera, alone and after the first one.
  folder.Write("walk.txt", "# camera a eye -.9 0 0 look-at 1 0 -.2 up 0 0 1 fov 60 aspect 1\n"
                           "# camera b eye 0 0 0 look-at 0 0 -1 up 0 1 0 fov 20 aspect 1\n");
  EXPECT_DOUBLE_EQ(exposureOf("-o w.png --walk walk.txt"), automatic);
  EXPECT_NE(exposureOf("-o b.png --eye 0 0 0 --look-at 0 0 -1 --up 0 1 0 --fov 20"), automatic);
}

TEST(Render, IrradianceIsAnImageOfItsOwn)
{
  const TemporaryFolder folder;
  test::WriteBox(folder);
  ASSERT_EQ(Render(folder, "-o a.exr --irradiance i.exr").exitCode, 0);
  const Image radiance = ReadExr(folder / "a.exr");
  const Image irradiance = ReadExr(folder / "i.exr");
  ASSERT_EQ(irradiance.width, radiance.width);
  std::size_t walls = 0; // of albedo 0.5, the lamp is in a few pixels
  for (std::size_t k = 0; k < radiance.pixels.size(); ++k)
  {
    const double expected = 0.5 / Pi * Mean(irradiance.pixels[k]);
    walls += std::abs(Mean(radiance.pixels[k]) - expected) < 1e-5 * expected ? 1 : 0; // floats
  }
  EXPECT_GT(walls, radiance.pixels.size() * 3 / 4);
  ASSERT_EQ(Render(folder, "--irradiance alone.exr").exitCode, 0);
  EXPECT_EQ(test::ReadText(folder / "alone.exr"), test::ReadText(folder / "i.exr"));
}

TEST(Render, IsTheSameForAnyNumberOfThreads)
{
  const TemporaryFolder folder;
  test::WriteBox(folder);
  ASSERT_EQ(Render(folder, "-o one.exr --threads 1").exitCode, 0);
  ASSERT_EQ(Render(folder, "-o two.exr --threads 2").exitCode, 0);
  EXPECT_EQ(test::ReadText(folder / "one.exr"), test::ReadText(folder / "two.exr"));
}

TEST(Render, EveryMethodShowsTheSameView)
{
  const TemporaryFolder folder;
  test::WriteBox(folder);
  const std::string fine =
    "render s.obj --size 8 8 --samples-per-pixel 16 --form-factor-tolerance 0.05 --error 1e-3 ";
  ASSERT_EQ(
    RunVantage(folder, fine + "-o a.exr --report a.json --method importance-shooting").exitCode, 0);
  const double flux = nlohmann::json::parse(test::ReadText(folder / "a.json"))["viewFlux"];
  for (const std::string method :
    { "basic-shooting", "progressive-shooting", "gauss-seidel", "importance-gathering" })
  {
    ASSERT_EQ(RunVantage(folder, fine + "-o b.exr --method " + method).exitCode, 0) << method;
    // Refinement and stopping differ a little from method to method.
    const RunResult compare = RunVantage(folder, "compare b.exr a.exr --tolerance 0.05");
    EXPECT_EQ(compare.exitCode, 0) << method << "\n" << compare.output;
  }
  ASSERT_EQ(
    RunVantage(folder, "render s.obj --size 8 8 --method path-tracing --samples-per-pixel 1024"
                       " -o c.exr --report c.json")
      .exitCode,
    0);
  // Discretisation, which falls with the tolerance of form factors; the noise is 1 %.
  const RunResult compare = RunVantage(folder, "compare a.exr c.exr --tolerance 0.1");
  EXPECT_EQ(compare.exitCode, 0) << compare.output;
  const double traced = nlohmann::json::parse(test::ReadText(folder / "c.json"))["viewFlux"];
  EXPECT_NEAR(traced / flux, 1.0, 0.03);
  // The gathered image has no elements: what is left is the error asked for, and the noise.
  ASSERT_EQ(RunVantage(folder, "render s.obj --size 8 8 -o d.exr --error 0.01").exitCode, 0);
  const RunResult gathered = RunVantage(folder, "compare d.exr c.exr --tolerance 0.02");
  EXPECT_EQ(gathered.exitCode, 0) << gathered.output;
}

TEST(Render, WithoutAnEmitterIsBlackWithAWarning)
{
  const TemporaryFolder folder;
  test::WriteBox(folder, "0 0 0");
  for (const std::string method :
    { "goal-oriented", "importance-shooting", "importance-gathering", "path-tracing" })
  {
    const RunResult run = Render(folder, "-o a.exr a.png --method " + method);
    EXPECT_EQ(run.exitCode, 0) << method;
    EXPECT_EQ(run.ErrorLines(), 1) << method << ": " << run.errors;
    EXPECT_EQ(run.errors.find("vantage: warning: "), 0u) << run.errors;
    for (const Color& pixel : ReadExr(folder / "a.exr").pixels)
    {
      EXPECT_EQ(pixel, Color(0.0));
    }
  }
  EXPECT_EQ(Render(folder, "-o a.exr --quiet").errors, "");
}

TEST(Render, AnErrorThatCannotBeReachedEndsWithAWarning)
{
  const TemporaryFolder folder;
  test::WriteBox(folder);
  const RunResult run =
    Render(folder, "-o a.exr --error 0.001 --minimum-element-size 1 --report a.json");
  EXPECT_EQ(run.exitCode, 0);
  EXPECT_EQ(run.ErrorLines(), 1) << run.errors;
  EXPECT_NE(run.errors.find("--minimum-element-size"), std::string::npos) << run.errors;
  EXPECT_GT(nlohmann::json::parse(test::ReadText(folder / "a.json"))["errorEstimate"], 0.001);
}

TEST(Render, ACameraInAWallOrOutsideIsNoError)
{
  const TemporaryFolder folder;
  test::WriteBox(folder);
  for (const std::string eye : { "1 0 0", "1 1 1", "5 0 0" })
  {
    const RunResult run = Render(folder, "-o a.exr --eye " + eye + " --look-at 9 .1 .1");
    EXPECT_EQ(run.exitCode, 0) << eye << ": " << run.errors;
    EXPECT_LE(run.ErrorLines(), 1) << eye << ": " << run.errors;
    for (const Color& pixel : ReadExr(folder / "a.exr").pixels)
    {
      EXPECT_TRUE(std::isfinite(Mean(pixel))) << eye;
    }
  }
}

TEST(Render, ArgumentsChangeTheCamera)
{
  const TemporaryFolder folder;
  test::WriteBox(folder);
  ASSERT_EQ(Render(folder, "-o a.exr").exitCode, 0);
  ASSERT_EQ(Render(folder, "-o b.exr --camera main").exitCode, 0);
  ASSERT_EQ(
    Render(folder, "-o c.exr --eye -.9 0 0 --look-at 1 0 -.2 --up 0 0 1 --fov 60").exitCode, 0);
  ASSERT_EQ(Render(folder, "-o d.exr --fov 30").exitCode, 0);
  EXPECT_EQ(RunVantage(folder, "compare b.exr a.exr --tolerance 0").exitCode, 0);
  EXPECT_EQ(RunVantage(folder, "compare c.exr a.exr --tolerance 0").exitCode, 0);
  EXPECT_EQ(RunVantage(folder, "compare d.exr a.exr --tolerance 0").exitCode, 1);
}

TEST(Render, ExposureBrightensAPng)
{
  const TemporaryFolder folder;
  test::WriteBox(folder);
  ASSERT_EQ(Render(folder, "-o a.png --exposure -8").exitCode, 0);
  ASSERT_EQ(Render(folder, "-o b.png --exposure 0").exitCode, 0);
  const RunResult compare = RunVantage(folder, "compare a.png b.png");
  EXPECT_NE(compare.output.find("bias -"), std::string::npos) << compare.output;
}

TEST(Compare, EqualImagesDoNotDiffer)
{
  const TemporaryFolder folder;
  Image image(3, 2);
  image.At(1, 1) = Color(1.0, 2.0, 3.0);
  WriteExr(image, folder / "a.exr");
  const RunResult run = RunVantage(folder, "compare a.exr a.exr --tolerance 0");
  EXPECT_EQ(run.exitCode, 0);
  EXPECT_EQ(run.output, "relative L1   0\nrelative RMSE 0\nrelative bias 0\n");
}

TEST(Compare, TellsHowFarAndExitsWithOne)
{
  const TemporaryFolder folder;
  Image image(2, 1);
  image.At(0, 0) = Color(1.0);
  image.At(1, 0) = Color(3.0);
  WriteExr(image, folder / "reference.exr");
  image.At(0, 0) = Color(2.0);
  WriteExr(image, folder / "image.exr");
  // |2 - 1| over 1 + 3.
  const RunResult run = RunVantage(folder, "compare image.exr reference.exr --tolerance 0.24");
  EXPECT_EQ(run.exitCode, 1);
  EXPECT_NE(run.output.find("relative L1   0.25\n"), std::string::npos) << run.output;
  EXPECT_NE(run.output.find("relative bias 0.25\n"), std::string::npos) << run.output;
  EXPECT_EQ(RunVantage(folder, "compare image.exr reference.exr --tolerance 0.26").exitCode, 0);
  WriteExr(Image(1, 2), folder / "other.exr");
  EXPECT_EQ(RunVantage(folder, "compare image.exr other.exr").exitCode, 2);
}

} // namespace
} // namespace vantage
