#include "apps/RunVantage.h"

#include <gtest/gtest.h>

namespace vantage
{
namespace
{

using test::BadCall;
using test::RunResult;
using test::RunVantage;
using test::TemporaryFolder;

const BadCall BadCalls[] = {
  { "NoCommand", "", "subcommand is required" },
  { "UnknownCommand", "rendr s.obj", "see vantage --help" },
  { "UnknownOption", "render s.obj -o a.png --sise 4 4", "see vantage render --help" },
  { "NoScene", "render -o a.png", "SCENE" },
  { "NoOutput", "render s.obj", "name one with -o" },
  { "MissingFile", "render none.obj -o a.png", "none.obj: there is no such file" },
  { "MissingVtp", "render none.vtp -o a.png", "none.vtp: there is no such file" },
  { "UnknownSceneSuffix", "render s.stl -o a.png", "choose one of: .obj, .vtp" },
  { "UnknownMaterial", "render material.obj -o a.png", "material.obj:5: material 'b'" },
  { "NanVertex", "render nan.obj -o a.png", "nan.obj:3: 'nan'" },
  { "InfiniteVertex", "render inf.obj -o a.png", "inf.obj:3: 'inf'" },
  { "IndexOutOfRange", "render index.obj -o a.png", "index.obj:6: vertex index 4" },
  { "EmptyScene", "render empty.obj -o a.png", "no polygons" },
  { "AlbedoAboveOne", "render albedo.obj -o a.png", "albedo.mtl:2: albedo" },
  { "NegativeEmission", "render emission.obj -o a.png", "emission.mtl:2: emission" },
  { "TruncatedFile", "render cut.obj -o a.png", "cut.obj:4: vertex with 1 of three" },
  { "TruncatedVtp", "render cut.vtp -o a.png", "cut.vtp: it cannot be read" },
  { "TextAsVtp", "render text.vtp -o a.png", "text.vtp: it cannot be read" },
  { "UnknownMethod", "render s.obj -o a.png --method magic", "path-tracing" },
  { "UnknownGranularity", "render s.obj -o a.png --granularity atom", "interaction, patch" },
  { "UnknownOracle", "render s.obj -o a.png --oracle delphi", "F, BF" },
  { "UnknownSuffix", "render s.obj -o a.jpeg", ".png, .exr, .vti, .vtp" },
  { "NoSuffix", "render s.obj -o a", "unknown suffix ''" },
  { "SecondSuffix", "render s.obj -o a.png b.gif", "b.gif: unknown suffix" },
  { "LinksSuffix", "render s.obj --links a.csv", ".vtp" },
  { "HistorySuffix", "render s.obj --history a.txt", ".csv" },
  { "ReportSuffix", "render s.obj --report a.txt", ".json" },
  { "UnknownCamera", "render s.obj -o a.png --camera side", "choose one of: main" },
  { "NoWalk", "render s.obj -o a.png --walk none.txt", "none.txt" },
  { "EmptyWalk", "render s.obj -o a.png --walk s.mtl", "s.mtl: there is no camera in it" },
  { "WalkAndCamera", "render s.obj -o a.png --walk s.obj --camera main", "drop --camera" },
  { "TracedWalk", "render s.obj -o a.png --walk s.obj --method path-tracing",
    "give one --camera a run" },
  { "NoCamera", "render nocamera.obj -o a.png", "give --eye X Y Z and --look-at X Y Z" },
  { "FieldOfViewZero", "render s.obj -o a.png --fov 0", "field of view" },
  { "FieldOfViewTooLarge", "render s.obj -o a.png --fov 180", "field of view" },
  { "FieldOfViewNan", "render s.obj -o a.png --fov nan", "field of view" },
  { "SizeZero", "render s.obj -o a.png --size 0 4", "--size: 0 4" },
  { "SizeNegative", "render s.obj -o a.png --size 4 -4", "--size: 4 -4" },
  { "SizeHalf", "render s.obj -o a.png --size 4", "--size" },
  { "SizeWord", "render s.obj -o a.png --size 4 x", "--size" },
  { "SizeTooLarge", "render s.obj -o a.png --size 40000 4", "width is 40000" },
  { "IrradianceSuffix", "render s.obj --irradiance a.png", ".exr" },
  { "IrradianceOfElements", "render s.obj --irradiance a.exr --method basic-shooting", "gathered" },
  { "OptionOfThePaper", "render s.obj -o a.png --oracle F", "choose another --method" },
  { "OptionOfGoalOriented", "render s.obj -o a.png --no-importance --method basic-shooting",
    "progressive-shooting" },
  { "EyeInTarget", "render s.obj -o a.png --eye 0 0 0 --look-at 0 0 0", "same point" },
  { "EyeNan", "render s.obj -o a.png --eye nan 0 0", "finite" },
  { "UpAlongSight", "render s.obj -o a.png --eye 0 0 0 --look-at 0 0 1 --up 0 0 1", "parallel" },
  { "NegativeError", "render s.obj -o a.png --error -0.1", "error" },
  { "NanError", "render s.obj -o a.png --error nan", "error" },
  { "NegativeTime", "render s.obj -o a.png --time -1", "seconds" },
  { "NegativeSteps", "render s.obj -o a.png --steps -1", "--steps" },
  { "NegativeSeed", "render s.obj -o a.png --seed -1", "--seed" },
  { "LabyrinthSeed", "labyrinth --seed -1 -o a.obj", "--seed" },
  { "NegativeThreads", "render s.obj -o a.png --threads -2", "--threads" },
  { "NoSamples", "render s.obj -o a.png --samples-per-pixel 0", "--samples-per-pixel" },
  { "ExposureNan", "render s.obj -o a.png --exposure nan", "exposure" },
  { "BadTolerance", "render s.obj -o a.png --form-factor-tolerance 0", "ormFactorTolerance" },
  { "NoFolder", "render s.obj -o none/a.png", "none/a.png: cannot be written" },
  { "OutputIsFolder", "render s.obj -o folder.png", "not an ordinary file" },
  { "ReportNoFolder", "render s.obj -o a.png --report none/a.json", "cannot be written" },
  { "OutputTwice", "render s.obj -o a.png ./a.png", "twice" },
  { "OutputIsScene", "render scene.vtp -o scene.vtp", "overwrite the scene" },
  { "GatheredSamples", "render s.obj -o a.png --samples-per-pixel 4", "gathered" },
  { "GoalWithoutLimit", "render s.obj -o a.png --error 0", "refine without end" },
  { "PathTracedElements", "render s.obj -o a.vtp --method path-tracing", "no elements" },
  { "PathTracedError", "render s.obj -o a.png --method path-tracing --error 0.1", "--steps" },
  { "InfoMissing", "info none.obj", "no such file" },
  { "CompareMissing", "compare a.exr b.exr", "no such file" },
  { "CompareSuffix", "compare s.obj s.obj", ".png, .exr, .vti" },
  { "CompareNoImage", "compare text.png text.png", "cannot be read" },
  { "CompareTolerance", "compare text.png text.png --tolerance -1", "--tolerance" },
  { "FormFactorsSuffix", "form-factors s.obj -o a.txt", ".csv" },
  { "FormFactorsMissing", "form-factors none.obj -o a.csv", "no such file" },
  { "FormFactorsTooMany", "form-factors many.obj -o a.csv", "at most" },
  { "LabyrinthRows", "labyrinth --rows 0 -o a.obj", "rows" },
  { "LabyrinthSuffix", "labyrinth -o a.png", ".obj, .vtp" },
  { "LabyrinthNoFolder", "labyrinth -o none/a.obj", "cannot be written" },
  { "LabyrinthNoOutput", "labyrinth", "--output" },
  { "ViewMissingFile", "view none.obj", "none.obj: there is no such file" },
  { "ViewNoCamera", "view nocamera.obj", "nocamera.obj: it has no camera" },
  { "ViewUnknownCamera", "view s.obj --camera x", "'x'" },
  { "ViewError", "view s.obj --error 0", "--error: it must be from 0.0005 to 1" },
  { "ViewSize", "view s.obj --size 0 10", "has no pixels" },
  { "ViewThreads", "view s.obj --threads -1", "--threads: it must not be negative" },
  { "ViewExposure", "view s.obj --exposure nan", "exposure" },
  { "ViewNoDisplay", "view s.obj", "there is no X display" },
};

/// All files the bad calls speak of.
void WriteBadScenes(const TemporaryFolder& folder)
{
  test::WriteBox(folder);
  const std::string triangle = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";
  const std::string camera = "# camera c eye 0 0 1 look-at 0 0 0 up 0 1 0 fov 60 aspect 1\n";
  folder.Write("material.obj", "mtllib s.mtl\n" + triangle + "usemtl b\nf 1 2 3\n");
  folder.Write("nan.obj", camera + "v 0 0 0\nv 1 nan 0\nv 0 1 0\nf 1 2 3\n");
  folder.Write("inf.obj", camera + "v 0 0 0\nv 1 inf 0\nv 0 1 0\nf 1 2 3\n");
  folder.Write("index.obj", camera + triangle + "\nf 1 2 4\n");
  folder.Write("empty.obj", "# nothing\n");
  folder.Write("nocamera.obj", triangle + "f 1 2 3\n");
  for (const std::string name : { "albedo", "emission" })
  {
    folder.Write(name + ".obj", camera + "mtllib " + name + ".mtl\n" + triangle + "f 1 2 3\n");
  }
  folder.Write("albedo.mtl", "newmtl a\nKd 1.2 .5 .5\n");
  folder.Write("emission.mtl", "newmtl a\nKe 1 -1 1\n");
  folder.Write("cut.obj", camera + "v 0 0 0\nv 1 0 0\nv 0.3");
  folder.Write("text.vtp", "no polygons\n");
  folder.Write("text.png", "no image\n");
  std::filesystem::create_directory(folder / "folder.png");
  ASSERT_EQ(RunVantage(folder, "labyrinth --rows 1 --columns 1 -o scene.vtp").exitCode, 0);
  const std::string whole = test::ReadText(folder / "scene.vtp");
  folder.Write("cut.vtp", whole.substr(0, whole.size() / 2));
  std::string many = triangle;
  for (int k = 0; k < 4001; ++k)
  {
    many += "f 1 2 3\n";
  }
  folder.Write("many.obj", many);
}

/// The scenes are written once for all calls, none of which may change anything.
class BadCallTest : public testing::TestWithParam<BadCall>
{
protected:
  static void SetUpTestSuite()
  {
    // For `vantage view`, which would open a window.
    unsetenv("DISPLAY");
    Folder = std::make_unique<TemporaryFolder>();
    WriteBadScenes(*Folder);
  }
  static void TearDownTestSuite() { Folder.reset(); }

  static inline std::unique_ptr<TemporaryFolder> Folder;
};

TEST_P(BadCallTest, IsRefusedInOneLineAndWritesNothing)
{
  const std::size_t files = Folder->FileCount();
  const std::string scene = test::ReadText(*Folder / "scene.vtp");
  const RunResult run = RunVantage(*Folder, this->GetParam().arguments);
  test::ExpectRefusal(run, this->GetParam().what);
  EXPECT_EQ(run.errors.find("vantage: "), 0u) << run.errors;
  const bool hasMend = run.errors.find("; ") != std::string::npos;
  EXPECT_TRUE(hasMend || run.errors.find("must") != std::string::npos) << run.errors;
  EXPECT_EQ(Folder->FileCount(), files);
  EXPECT_EQ(test::ReadText(*Folder / "scene.vtp"), scene);
}

INSTANTIATE_TEST_SUITE_P(CommandLine, BadCallTest, testing::ValuesIn(BadCalls),
  [](const testing::TestParamInfo<BadCall>& info) { return std::string(info.param.name); });

TEST(CommandLine, HelpIsNoError)
{
  const TemporaryFolder folder;
  for (const char* arguments : { "--help", "render --help", "info --help", "compare --help",
         "form-factors --help", "labyrinth --help", "view --help" })
  {
    const RunResult run = RunVantage(folder, arguments);
    EXPECT_EQ(run.exitCode, 0) << arguments;
    EXPECT_EQ(run.errors, "") << arguments;
    EXPECT_NE(run.output, "") << arguments;
  }
}

TEST(CommandLine, LabyrinthIsTheSameEachTime)
{
  const TemporaryFolder folder;
  for (const char* name : { "a", "b" })
  {
    const RunResult run = RunVantage(
      folder, std::string("labyrinth --rows 3 --columns 2 --seed 5 -o ") + name + ".obj");
    EXPECT_EQ(run.exitCode, 0);
    EXPECT_EQ(run.errors, "");
  }
  const std::string text = test::ReadText(folder / "a.obj");
  EXPECT_EQ(text.substr(text.find("\nv ")),
    [&]
    {
      const std::string b = test::ReadText(folder / "b.obj");
      return b.substr(b.find("\nv "));
    }());
  EXPECT_EQ(test::ReadText(folder / "a.mtl"), test::ReadText(folder / "b.mtl"));
}

TEST(CommandLine, InfoTellsTheSameOfBothFormats)
{
  const TemporaryFolder folder;
  EXPECT_EQ(RunVantage(folder, "labyrinth -o a.obj").exitCode, 0);
  EXPECT_EQ(RunVantage(folder, "labyrinth -o a.vtp").exitCode, 0);
  const RunResult obj = RunVantage(folder, "info a.obj");
  const RunResult vtp = RunVantage(folder, "info a.vtp");
  EXPECT_EQ(obj.exitCode, 0);
  EXPECT_EQ(obj.errors, "");
  EXPECT_EQ(obj.output, vtp.output);
  // 18 lamps of 0.36 m^2 and 60 W m^-2 sr^-1 emit pi L A = 1221.45 W.
  for (const char* text :
    { "polygons     378", "lamp: 18 facets, 6.48", "1221.45", "view1", "view2", "overview" })
  {
    EXPECT_NE(obj.output.find(text), std::string::npos) << text << " in\n" << obj.output;
  }
}

TEST(CommandLine, InfoTellsWhatIsInsideClosedBodies)
{
  const TemporaryFolder folder;
  folder.Write("s.mtl", "newmtl body\nKd .5 .5 .5\nnewmtl lamp\nKd 0 0 0\nKe 1 1 1\n");
  folder.Write("s.obj",
    "mtllib s.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nv 5 0 0\nv 6 0 0\nv 5 1 0\nusemtl body\n"
    "f 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\nusemtl lamp\nf 5 6 7\n");
  const RunResult run = RunVantage(folder, "info s.obj");
  EXPECT_NE(run.output.find("dark sides   4 inside"), std::string::npos) << run.output;
}

TEST(CommandLine, InfoWarnsOfWhatIsMissing)
{
  const TemporaryFolder folder;
  folder.Write("s.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 2 0 0\nf 1 2 3\nf 1 2 4\n");
  const RunResult run = RunVantage(folder, "info s.obj");
  EXPECT_EQ(run.exitCode, 0);
  EXPECT_EQ(run.ErrorLines(), 3) << run.errors;
  EXPECT_NE(run.errors.find("1 polygons have no area"), std::string::npos) << run.errors;
  EXPECT_NE(run.errors.find("nothing emits"), std::string::npos) << run.errors;
  EXPECT_NE(run.errors.find("no camera"), std::string::npos) << run.errors;
}

} // namespace
} // namespace vantage
