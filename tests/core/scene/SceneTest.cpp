#include "core/scene/Scene.h"

#include "core/Error.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>

namespace vantage
{
namespace
{

const double Nan = std::nan("");
const double Infinity = HUGE_VAL;

Scene ValidScene()
{
  Scene scene;
  Material material;
  material.name = "wall";
  scene.materials.push_back(material);
  scene.AddPolygon({ { 0, 0, 0 }, { 1, 0, 0 }, { 0, 1, 0 } }, 0);
  scene.AddPolygon({ { 0, 0, 1 }, { 1, 0, 1 }, { 1, 1, 1 }, { 0, 1, 1 } }, 0);
  Camera camera;
  camera.name = "door";
  scene.cameras.push_back(camera);
  return scene;
}

TEST(Scene, AddPolygonAppendsCornersInOrder)
{
  const Scene scene = ValidScene();
  EXPECT_EQ(scene.PolygonCount(), 2u);
  EXPECT_EQ(scene.offsets, (std::vector<std::uint32_t>{ 0, 3, 7 }));
  EXPECT_EQ(scene.indices, (std::vector<std::uint32_t>{ 0, 1, 2, 3, 4, 5, 6 }));
  EXPECT_EQ(scene.vertices[5], Vec3(1, 1, 1));
  EXPECT_NO_THROW(scene.Validate());
}

/// One thing that is wrong and a word of the message that must name it.
struct Fault
{
  const char* expected;
  std::function<void(Scene&)> apply;
};

class SceneFault : public testing::TestWithParam<Fault>
{
};

TEST_P(SceneFault, IsNamedInOneLine)
{
  Scene scene = ValidScene();
  GetParam().apply(scene);
  try
  {
    scene.Validate();
    FAIL() << "no error for: " << GetParam().expected;
  }
  catch (const InputError& error)
  {
    const std::string message = error.what();
    EXPECT_NE(message.find(GetParam().expected), std::string::npos) << message;
    EXPECT_EQ(message.find('\n'), std::string::npos);
  }
}

INSTANTIATE_TEST_SUITE_P(Polygons, SceneFault,
  testing::Values(Fault{ "no polygons", [](Scene& s) { s = Scene(); } },
    Fault{ "2 polygons but 1 material", [](Scene& s) { s.materialOfPolygon.pop_back(); } },
    Fault{ "polygon 0: needs at least three vertices", [](Scene& s) { s.offsets[1] = 2; } },
    Fault{ "polygon 1: needs at least three vertices", [](Scene& s) { s.offsets[2] = 100; } },
    Fault{ "polygon 0: needs at least three vertices",
      [](Scene& s)
      {
        s.offsets[0] = 0xffffffff;
        s.offsets[1] = 2;
      } },
    Fault{ "polygon 1: vertex index 7 is out of range", [](Scene& s) { s.indices[4] = 7; } },
    Fault{
      "polygon 1: material index 1 is out of range", [](Scene& s) { s.materialOfPolygon[1] = 1; } },
    Fault{ "vertex 2: ", [](Scene& s) { s.vertices[2].y = Nan; } },
    Fault{ "vertex 6: ", [](Scene& s) { s.vertices[6].z = -Infinity; } }));

INSTANTIATE_TEST_SUITE_P(Materials, SceneFault,
  testing::Values(Fault{ "albedo", [](Scene& s) { s.materials[0].albedo.x = -0.1; } },
    Fault{ "albedo", [](Scene& s) { s.materials[0].albedo.y = 1.1; } },
    Fault{ "albedo", [](Scene& s) { s.materials[0].albedo.z = Nan; } },
    Fault{ "emission", [](Scene& s) { s.materials[0].emission.x = -1.0; } },
    Fault{ "emission", [](Scene& s) { s.materials[0].emission.y = Infinity; } },
    Fault{ "emission", [](Scene& s) { s.materials[0].emission.z = Nan; } },
    Fault{ "between 1e-100 and 1e100", [](Scene& s) { s.materials[0].emission.x = 1e101; } },
    Fault{ "between 1e-100 and 1e100", [](Scene& s) { s.materials[0].emission.y = 5e-324; } },
    Fault{ "specular", [](Scene& s) { s.materials[0].specular.x = -0.1; } },
    Fault{ "specular", [](Scene& s) { s.materials[0].specular.x = Nan; } },
    Fault{ "albedo + specular", [](Scene& s) { s.materials[0].specular.y = 0.6; } },
    Fault{ "shininess", [](Scene& s) { s.materials[0].shininess = -1.0; } },
    Fault{ "shininess", [](Scene& s) { s.materials[0].shininess = Infinity; } },
    Fault{ "material 'wall'", [](Scene& s) { s.materials[0].shininess = Nan; } }));

INSTANTIATE_TEST_SUITE_P(Cameras, SceneFault,
  testing::Values(Fault{ "camera 'door'", [](Scene& s) { s.cameras[0].fieldOfView = 180.0; } }));

TEST(Scene, LimitsOfMaterialsAreValid)
{
  Scene scene = ValidScene();
  scene.materials[0].albedo = Color(1.0, 0.0, 0.5);
  scene.materials[0].specular = Color(0.0, 1.0, 0.5);
  scene.materials[0].emission = Color(1e9);
  EXPECT_NO_THROW(scene.Validate());
}

TEST(Scene, FindsCamerasByName)
{
  Scene scene = ValidScene();
  Camera second;
  second.name = "window";
  scene.cameras.push_back(second);
  EXPECT_EQ(&scene.FindCamera("window"), &scene.cameras[1]);
  try
  {
    scene.FindCamera("roof");
    FAIL();
  }
  catch (const UnknownNameError& error)
  {
    EXPECT_STREQ(error.what(), "unknown camera 'roof'; choose one of: door, window");
  }
  scene.cameras.clear();
  EXPECT_THROW(scene.FindCamera("door"), UnknownNameError);
}

} // namespace
} // namespace vantage
