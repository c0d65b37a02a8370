#include "io/CameraFile.h"

#include "Files.h"
#include "core/Error.h"

#include <gtest/gtest.h>

namespace vantage
{
namespace
{

using test::TemporaryFolder;

TEST(CameraFile, WhatIsPrintedIsReadBack)
{
  const TemporaryFolder folder;
  Camera first;
  first.name = "door";
  first.eye = Vec3(0.1, -2.0 / 3.0, 1e7);
  first.lookAt = Vec3(1e-5, 3.0, 0.7);
  first.fieldOfView = 61.3;
  first.aspect = 16.0 / 9.0;
  Camera second = first;
  second.name = "window";
  second.eye.x = 5.0;
  const std::string path = folder.Write(
    "walk.txt", "in between: anything\n" + PrintCamera(first) + "# other\n" + PrintCamera(second));
  const std::vector<Camera> cameras = ReadCameras(path);
  ASSERT_EQ(cameras.size(), 2u);
  EXPECT_EQ(cameras[0].name, "door");
  EXPECT_EQ(cameras[0].eye, first.eye);
  EXPECT_EQ(cameras[0].lookAt, first.lookAt);
  EXPECT_EQ(cameras[0].up, first.up);
  EXPECT_EQ(cameras[0].fieldOfView, first.fieldOfView);
  EXPECT_EQ(cameras[0].aspect, first.aspect);
  EXPECT_EQ(cameras[1].eye.x, 5.0);
}

TEST(CameraFile, MistakesSayWhere)
{
  const TemporaryFolder folder;
  const auto messageOf = [&](const std::string& text)
  {
    try
    {
      ReadCameras(folder.Write("walk.txt", text));
    }
    catch (const InputError& error)
    {
      return std::string(error.what());
    }
    return std::string("read");
  };
  EXPECT_NE(messageOf("\n# camera a eye 0 0 0\n").find("walk.txt:2: "), std::string::npos);
  const std::string flat = "# camera a eye 0 0 0 look-at 1 0 0 up 0 0 1 fov 0 aspect 1\n";
  EXPECT_NE(messageOf(flat).find("walk.txt:1: "), std::string::npos);
  EXPECT_NE(messageOf("no camera\n").find("there is no camera in it"), std::string::npos);
  EXPECT_THROW(ReadCameras(folder / "none.txt"), InputError);
  Camera camera;
  camera.name = "two words";
  EXPECT_THROW(PrintCamera(camera), InputError);
}

} // namespace
} // namespace vantage
