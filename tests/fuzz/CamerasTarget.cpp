#include "fuzz/Target.h"
#include "io/CameraFile.h"
#include "io/Files.h"

namespace vantage::fuzz
{

/// The bytes are a file of cameras; all that are read are valid and come back when they are
/// written.
void ReadBytes(const std::string& bytes)
{
  static const test::TemporaryFolder folder;
  Scene scene;
  if (!IsRead([&] { scene.cameras = ReadCameras(folder.Write("walk.txt", bytes)); }))
  {
    return;
  }
  std::string text;
  for (const Camera& camera : scene.cameras)
  {
    camera.Validate();
    text += PrintCamera(camera);
  }
  Scene again;
  again.cameras = ReadCameras(folder.Write("again.txt", text));
  RequireSame(again, scene);
}

} // namespace vantage::fuzz
