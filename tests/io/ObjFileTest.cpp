#include "io/ObjFile.h"
#include "core/Error.h"
#include "core/math/Sampling.h"
#include "core/scene/Labyrinth.h"
#include "core/visibility/OccluderScene.h"
#include "io/Files.h"

#include <gtest/gtest.h>

namespace vantage
{
namespace
{

using test::TemporaryFolder;

void ExpectEqual(const Camera& a, const Camera& b)
{
  EXPECT_EQ(a.name, b.name);
  EXPECT_EQ(a.eye, b.eye);
  EXPECT_EQ(a.lookAt, b.lookAt);
  EXPECT_EQ(a.up, b.up);
  EXPECT_EQ(a.fieldOfView, b.fieldOfView);
  EXPECT_EQ(a.aspect, b.aspect);
}

void ExpectEqual(const Material& a, const Material& b)
{
  EXPECT_EQ(a.name, b.name);
  EXPECT_EQ(a.albedo, b.albedo);
  EXPECT_EQ(a.emission, b.emission);
  EXPECT_EQ(a.specular, b.specular);
  EXPECT_EQ(a.shininess, b.shininess);
  EXPECT_EQ(a.twoSided, b.twoSided);
}

void ExpectEqual(const Scene& a, const Scene& b)
{
  EXPECT_EQ(a.vertices, b.vertices);
  EXPECT_EQ(a.indices, b.indices);
  EXPECT_EQ(a.offsets, b.offsets);
  EXPECT_EQ(a.materialOfPolygon, b.materialOfPolygon);
  ASSERT_EQ(a.materials.size(), b.materials.size());
  for (std::size_t m = 0; m < a.materials.size(); ++m)
  {
    ExpectEqual(a.materials[m], b.materials[m]);
  }
  ASSERT_EQ(a.cameras.size(), b.cameras.size());
  for (std::size_t c = 0; c < a.cameras.size(); ++c)
  {
    ExpectEqual(a.cameras[c], b.cameras[c]);
  }
}

/// Numbers whose decimal form needs all digits, of any magnitude.
Scene MakeAwkwardScene(std::uint64_t seed)
{
  RandomStream random(seed);
  Scene scene;
  for (int m = 0; m < 3; ++m)
  {
    Material material;
    material.name = "m" + std::to_string(m);
    material.albedo = 0.5 * Color(random.Next(), random.Next(), random.Next());
    material.specular = 0.5 * Color(random.Next(), random.Next(), random.Next());
    material.emission = Color(random.Next(), 1e6 * random.Next(), 1e-9 * random.Next());
    material.shininess = 100.0 * random.Next();
    material.twoSided = m != 1;
    scene.materials.push_back(material);
  }
  for (std::uint32_t p = 0; p < 20; ++p)
  {
    std::vector<Vec3> points;
    for (std::uint32_t k = 0; k < 3 + p % 5; ++k)
    {
      const double size = std::pow(10.0, 24.0 * random.Next() - 12.0);
      points.push_back(size * Vec3(random.Next() - 0.5, random.Next() - 0.5, random.Next() - 0.5));
    }
    scene.AddPolygon(points, p % 3);
  }
  scene.vertices[0] = { 5e-324, -0.0, 1.7976931348623157e308 };
  Camera camera;
  camera.name = "eye";
  camera.eye = Vec3(random.Next(), random.Next(), random.Next());
  camera.fieldOfView = 90.0 * random.Next();
  camera.aspect = random.Next();
  scene.cameras.push_back(camera);
  return scene;
}

TEST(ObjFile, RoundTripKeepsEveryBit)
{
  const TemporaryFolder folder;
  for (std::uint64_t seed = 1; seed <= 10; ++seed)
  {
    SCOPED_TRACE("seed " + std::to_string(seed));
    const Scene scene = MakeAwkwardScene(seed);
    WriteObj(scene, folder / "scene.obj");
    ExpectEqual(ReadObj(folder / "scene.obj"), scene);
  }
  EXPECT_EQ(folder.FileCount(), 2u); // .obj and .mtl, nothing temporary
}

TEST(ObjFile, RoundTripOfALabyrinthThroughANameWithBlanks)
{
  const TemporaryFolder folder;
  const Scene scene = MakeLabyrinth();
  WriteObj(scene, folder / "a scene.obj");
  std::vector<std::string> warnings;
  ExpectEqual(ReadObj(folder / "a scene.obj", &warnings), scene);
  EXPECT_TRUE(warnings.empty());
}

TEST(ObjFile, ScenesOfTheDataFolderAreClean)
{
  std::vector<std::string> warnings;
  EXPECT_EQ(ReadObj(VANTAGE_DATA_DIR "/box.obj", &warnings).PolygonCount(), 12u);
  EXPECT_EQ(ReadObj(VANTAGE_DATA_DIR "/office.obj", &warnings).PolygonCount(), 1483u);
  ExpectEqual(ReadObj(VANTAGE_DATA_DIR "/labyrinth.obj", &warnings), MakeLabyrinth());
  EXPECT_TRUE(warnings.empty());
}

/// Nothing looks out of it or sees a face from behind, however light bounces.
TEST(ObjFile, TheOfficeIsClosedAndShowsItsFrontsOnly)
{
  const Scene scene = ReadObj(VANTAGE_DATA_DIR "/office.obj");
  ASSERT_EQ(scene.cameras.size(), 3u);
  const FacetSet facets = BuildFacets(scene);
  EXPECT_EQ(facets.facets.size(), scene.PolygonCount());
  const OccluderScene occluders(facets);
  constexpr int Paths = 3000;
  constexpr int Bounces = 8;
  for (int path = 0; path < Paths; ++path)
  {
    RandomStream random(1, path);
    const Camera& camera = scene.cameras[path % scene.cameras.size()];
    Vec3 from = camera.eye;
    Vec3 normal = glm::normalize(camera.lookAt - camera.eye);
    std::uint32_t facet = None;
    for (int bounce = 0; bounce < Bounces; ++bounce)
    {
      const Vec3 towards = Frame(normal).ToWorld(CosineHemisphere(random.Next2()));
      const auto hit = occluders.Intersect(from, towards, facet);
      ASSERT_TRUE(hit) << path;
      ASSERT_EQ(hit->side, Side::Front) << path;
      from = hit->point;
      facet = hit->facet;
      normal = UnitNormal(facets.facets[facet].shape);
    }
  }
}

TEST(ObjFile, ReadsWhatOtherProgramsWrite)
{
  const TemporaryFolder folder;
  folder.Write("m.mtl", "# made by hand\r\nnewmtl red\r\nKd 1 0 0\r\nKa 1 1 1\r\nillum 2\r\n");
  const std::string path = folder.Write("s.obj",
    "# a comment\n# camera position is unknown\nmtllib m.mtl\no thing\nv 0 0 0\nv 1 0 0 1.0\n"
    "v 1 1 0 .5 .5 .5\nv +0 1. 0\nvn 0 0 1\nvt 0 0\ns off\nf 1 2 3\ng part\nusemtl red\n"
    "f 1/1/1 2//1 3/1 4\nf -4 -3 -2\nl 1 2\n");
  std::vector<std::string> warnings;
  const Scene scene = ReadObj(path, &warnings);
  EXPECT_EQ(scene.vertices.size(), 4u);
  EXPECT_EQ(scene.vertices[3], Vec3(0, 1, 0));
  EXPECT_EQ(scene.indices, (std::vector<std::uint32_t>{ 0, 1, 2, 0, 1, 2, 3, 0, 1, 2 }));
  EXPECT_EQ(scene.offsets, (std::vector<std::uint32_t>{ 0, 3, 7, 10 }));
  // The polygon before usemtl gets the default material, which stands behind the others.
  EXPECT_EQ(scene.materialOfPolygon, (std::vector<std::uint32_t>{ 1, 0, 0 }));
  ASSERT_EQ(scene.materials.size(), 2u);
  EXPECT_EQ(scene.materials[0].albedo, Color(1, 0, 0));
  EXPECT_EQ(scene.materials[1].name, "default");
  EXPECT_EQ(scene.materials[1].albedo, Color(0.5));
  EXPECT_TRUE(scene.cameras.empty());
  ASSERT_EQ(warnings.size(), 1u); // the line
  EXPECT_NE(warnings[0].find("s.obj:17"), std::string::npos) << warnings[0];
}

TEST(ObjFile, LinesEndAsOnAnySystem)
{
  const TemporaryFolder folder;
  for (const std::string end : { "\n", "\r\n", "\r" })
  {
    std::string text = "# c|v 0 0 0|v 1 0 0|v 1 1 0|f 1 2 3|";
    for (std::size_t at = text.find('|'); at != std::string::npos; at = text.find('|', at))
    {
      text.replace(at, 1, end);
    }
    std::vector<std::string> warnings;
    const Scene scene = ReadObj(folder.Write("s.obj", text), &warnings);
    EXPECT_EQ(scene.vertices.size(), 3u);
    EXPECT_EQ(scene.PolygonCount(), 1u);
    EXPECT_TRUE(warnings.empty());
    try
    {
      ReadObj(folder.Write("s.obj", text + end + "x"));
      FAIL() << "the file was read";
    }
    catch (const InputError& error)
    {
      EXPECT_NE(std::string(error.what()).find("s.obj:7: "), std::string::npos) << error.what();
    }
  }
}

TEST(ObjFile, TheDefaultMaterialHasANameOfItsOwn)
{
  const TemporaryFolder folder;
  folder.Write("m.mtl", "newmtl default\nKd 1 0 0\n");
  const std::string triangle = "v 0 0 0\nv 1 0 0\nv 1 1 0\nf 1 2 3\n";
  const Scene scene = ReadObj(folder.Write("s.obj", "mtllib m.mtl\n" + triangle));
  ASSERT_EQ(scene.materials.size(), 2u);
  WriteObj(scene, folder / "again.obj");
  ExpectEqual(ReadObj(folder / "again.obj"), scene);
}

TEST(ObjFile, WarnsOfWhatMayHaveBeenCutOffAndOfTextures)
{
  const TemporaryFolder folder;
  folder.Write("m.mtl", "newmtl a\nmap_Kd a.png\n");
  const std::string path =
    folder.Write("s.obj", "mtllib m.mtl\nv 0 0 0\nv 1 0 0\nv 1 1 0\nusemtl a\nf 1 2 3");
  std::vector<std::string> warnings;
  EXPECT_EQ(ReadObj(path, &warnings).PolygonCount(), 1u);
  ASSERT_EQ(warnings.size(), 2u);
  EXPECT_NE(warnings[0].find("m.mtl:2"), std::string::npos) << warnings[0];
  EXPECT_NE(warnings[1].find("s.obj:6"), std::string::npos) << warnings[1];
}

/// A file that is wrong in one place, and what the message must say.
struct BadFile
{
  const char* name;
  const char* obj;
  const char* mtl;
  const char* where;
  const char* what;
};

constexpr const char* GoodMtl = "newmtl a\nKd .5 .5 .5\n";
constexpr const char* GoodObj = "mtllib m.mtl\nv 0 0 0\nv 1 0 0\nv 1 1 0\nusemtl a\nf 1 2 3\n";

const BadFile BadFiles[] = {
  { "MissingMtl", "mtllib other.mtl\nv 0 0 0\n", GoodMtl, "s.obj:1: ", "does not exist" },
  { "TwoMtl", "mtllib m.mtl n.mtl\n", GoodMtl, "s.obj:1: ", "more than one file" },
  { "UnknownMaterial", "mtllib m.mtl\nusemtl b\n", GoodMtl, "s.obj:2: ", "material 'b'" },
  { "NoMtlAtAll", "usemtl a\n", GoodMtl, "s.obj:1: ", "material 'a'" },
  { "UsemtlWithoutName", "mtllib m.mtl\nusemtl\n", GoodMtl, "s.obj:2: ", "material ''" },
  { "NanVertex", "v 0 nan 0\n", GoodMtl, "s.obj:1: ", "'nan' is not a finite" },
  { "InfiniteVertex", "v 0 0 inf\n", GoodMtl, "s.obj:1: ", "'inf' is not a finite" },
  { "HugeVertex", "v 0 0 1e999\n", GoodMtl, "s.obj:1: ", "'1e999' is not a finite" },
  { "WordVertex", "v 0 zero 0\n", GoodMtl, "s.obj:1: ", "'zero' is not a number" },
  { "HalfNumber", "v 0 1.5.2 0\n", GoodMtl, "s.obj:1: ", "'1.5.2' is not a number" },
  { "ShortVertex", "v 0 1\n", GoodMtl, "s.obj:1: ", "2 of three" },
  { "ShortFace", "v 0 0 0\nv 1 0 0\nf 1 2\n", GoodMtl, "s.obj:3: ", "2 corners" },
  { "IndexTooLarge", "v 0 0 0\nv 1 0 0\nf 1 2 3\n", GoodMtl, "s.obj:3: ", "index 3 is out of" },
  { "IndexZero", "v 0 0 0\nv 1 0 0\nf 1 2 0\n", GoodMtl, "s.obj:3: ", "index 0 is out of" },
  { "IndexTooFarBack", "v 0 0 0\nf -1 -1 -2\n", GoodMtl, "s.obj:2: ", "index -2 is out of" },
  { "IndexWord", "v 0 0 0\nf 1 1 x\n", GoodMtl, "s.obj:2: ", "'x' is no corner" },
  { "IndexReal", "v 0 0 0\nf 1 1 1.5\n", GoodMtl, "s.obj:2: ", "'1.5' is no corner" },
  { "IndexHuge", "v 0 0 0\nf 1 1 99999999999\n", GoodMtl, "s.obj:2: ", "is no corner" },
  { "CornerCutOff", "v 0 0 0\nf 1 1 1/\n", GoodMtl, "s.obj:2: ", "'1/' is no corner" },
  { "CornerTooLong", "v 0 0 0\nf 1 1 1/1/1/1\n", GoodMtl, "s.obj:2: ", "is no corner" },
  { "NotObj", "\x89PNG\r\n", GoodMtl, "s.obj:1: ", "is no statement" },
  { "Binary", "v 0 0 0\no \x1b[31m\n", GoodMtl, "s.obj:2: ", "control character" },
  { "FormFeed", "f 1\f2 3 4\n", GoodMtl, "s.obj:1: ", "control character" },
  { "EmptyFile", "", GoodMtl, "s.obj: ", "no polygons" },
  { "NoFaces", "v 0 0 0\n", GoodMtl, "s.obj: ", "no polygons" },
  { "CameraCutOff", "# camera c eye 0 0 0 look-at 1 0 0\n", GoodMtl, "s.obj:1: ", "camera" },
  { "CameraWithoutAngle", "# camera c eye 0 0 0 look-at 1 0 0 up 0 0 1 fov 0 aspect 1\n", GoodMtl,
    "s.obj:1: ", "field" },
  { "CameraNan", "# camera c eye 0 0 nan look-at 1 0 0 up 0 0 1 fov 40 aspect 1\n", GoodMtl,
    "s.obj:1: ", "'nan'" },
  { "AlbedoAboveOne", GoodObj, "newmtl a\nKd .5 1.01 .5\n", "m.mtl:2: ", "1.01 is above 1" },
  { "NegativeAlbedo", GoodObj, "newmtl a\nKd .5 -1 .5\n", "m.mtl:2: ", "-1 is negative" },
  { "NegativeEmission", GoodObj, "newmtl a\nKe 0 0 -3\n", "m.mtl:2: ", "-3 is negative" },
  { "NanEmission", GoodObj, "newmtl a\nKe 0 0 nan\n", "m.mtl:2: ", "'nan' is not a finite" },
  { "DimEmission", GoodObj, "newmtl a\nKe 0 0 1e-310\n", "m.mtl:2: ", "too dim" },
  { "BrightEmission", GoodObj, "newmtl a\nKe 1e101 0 0\n", "m.mtl:2: ", "too bright" },
  { "ShortAlbedo", GoodObj, "newmtl a\nKd .5 .5\n", "m.mtl:2: ", "three numbers" },
  { "SpectralAlbedo", GoodObj, "newmtl a\nKd spectral a.rfl 1\n", "m.mtl:2: ", "not a number" },
  { "NegativeShininess", GoodObj, "newmtl a\nNs -1\n", "m.mtl:2: ", "shininess" },
  { "ShininessCutOff", GoodObj, "newmtl a\nNs\n", "m.mtl:2: ", "number is expected" },
  { "SpecularAboveOne", GoodObj, "newmtl a\nKs 2 0 0\n", "m.mtl:2: ", "2 is above 1" },
  { "NoSides", GoodObj, "newmtl a\nsides 0\n", "m.mtl:2: ", "sides is 0" },
  { "StatementBeforeName", GoodObj, "Kd 1 1 1\n", "m.mtl:1: ", "before the first newmtl" },
  { "MaterialTwice", GoodObj, "newmtl a\nnewmtl a\n", "m.mtl:2: ", "second time" },
  { "MaterialWithoutName", GoodObj, "newmtl\n", "m.mtl:1: ", "name of one word" },
};

void PrintTo(const BadFile& file, std::ostream* stream)
{
  *stream << file.name;
}

class BadObj : public testing::TestWithParam<BadFile>
{
};

TEST_P(BadObj, IsRefusedWithPlaceAndReason)
{
  const TemporaryFolder folder;
  const std::string path = folder.Write("s.obj", this->GetParam().obj);
  folder.Write("m.mtl", this->GetParam().mtl);
  try
  {
    ReadObj(path);
    FAIL() << "the file was read";
  }
  catch (const InputError& error)
  {
    const std::string message = error.what();
    EXPECT_NE(message.find(this->GetParam().where), std::string::npos) << message;
    EXPECT_NE(message.find(this->GetParam().what), std::string::npos) << message;
    EXPECT_NE(message.find("; "), std::string::npos) << "no mend: " << message;
    EXPECT_EQ(message.find('\n'), std::string::npos) << message;
  }
}

INSTANTIATE_TEST_SUITE_P(ObjFile, BadObj, testing::ValuesIn(BadFiles),
  [](const testing::TestParamInfo<BadFile>& info) { return std::string(info.param.name); });

TEST(ObjFile, HighlightsGetWhatTheAlbedoLeaves)
{
  const TemporaryFolder folder;
  folder.Write(
    "m.mtl", "newmtl b\nnewmtl a\nKd .6 .5 0\nKs .5 .5 .5\nnewmtl c\nKd 1 1 1\nKs 1 0 0\n");
  std::vector<std::string> warnings;
  const Scene scene = ReadObj(folder.Write("s.obj", GoodObj), &warnings);
  EXPECT_NEAR(scene.materials[1].specular.x, 0.4, 1e-15);
  EXPECT_NEAR(scene.materials[1].specular.z, 0.4, 1e-15); // its hue is kept
  EXPECT_EQ(scene.materials[2].specular, Color(0.0));
  ASSERT_EQ(warnings.size(), 2u);
  EXPECT_NE(warnings[0].find("m.mtl:2: material 'a': Kd + Ks is 1.1"), std::string::npos)
    << warnings[0];
  EXPECT_NE(warnings[1].find("m.mtl:5: "), std::string::npos) << warnings[1];
}

TEST(ObjFile, GoodFileOfTheTableIsRead)
{
  const TemporaryFolder folder;
  folder.Write("m.mtl", GoodMtl);
  EXPECT_EQ(ReadObj(folder.Write("s.obj", GoodObj)).PolygonCount(), 1u);
}

TEST(ObjFile, MissingFilesAndFoldersAreRefused)
{
  const TemporaryFolder folder;
  EXPECT_THROW(ReadObj(folder / "none.obj"), InputError);
  EXPECT_THROW(ReadObj(folder / "."), InputError);
  EXPECT_THROW(ReadObj("/dev/zero"), InputError);
  EXPECT_THROW(ReadObj(folder / std::string(5000, 'n')), InputError);
  const std::string tooLong = "mtllib " + std::string(5000, 'n') + "\n";
  EXPECT_THROW(ReadObj(folder.Write("s.obj", tooLong)), InputError);
}

TEST(ObjFile, RefusesToWriteWhatCannotBeReadBack)
{
  const TemporaryFolder folder;
  const Scene good = MakeLabyrinth({ 1, 1 });
  Scene bad = good;
  bad.materials[1].name = "two words";
  EXPECT_THROW(WriteObj(bad, folder / "s.obj"), InputError);
  bad = good;
  bad.materials[1].name = bad.materials[0].name;
  EXPECT_THROW(WriteObj(bad, folder / "s.obj"), InputError);
  bad = good;
  bad.cameras[0].name = "";
  EXPECT_THROW(WriteObj(bad, folder / "s.obj"), InputError);
  EXPECT_THROW(WriteObj(Scene(), folder / "s.obj"), InputError);
  EXPECT_THROW(WriteObj(good, folder / "none/s.obj"), InputError);
  EXPECT_EQ(folder.FileCount(), 0u);
}

} // namespace
} // namespace vantage
