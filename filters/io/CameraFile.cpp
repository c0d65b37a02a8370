#include "io/CameraFile.h"

#include "core/Error.h"
#include "io/TextLines.h"

namespace vantage
{

std::optional<Camera> CameraNote(const TextLines& lines)
{
  const auto& words = lines.Words();
  if (words.size() < 4 || words[0] != "#" || words[1] != "camera" || words[3] != "eye")
  {
    return std::nullopt;
  }
  if (words.size() != 19 || words[7] != "look-at" || words[11] != "up" || words[15] != "fov" ||
      words[17] != "aspect")
  {
    lines.Fail("camera comment is not complete",
      "write # camera NAME eye X Y Z look-at X Y Z up X Y Z fov DEGREES aspect RATIO");
  }
  Camera camera;
  camera.name = words[2];
  camera.eye = lines.Triple(4);
  camera.lookAt = lines.Triple(8);
  camera.up = lines.Triple(12);
  camera.fieldOfView = lines.Number(16);
  camera.aspect = lines.Number(18);
  try
  {
    camera.Validate();
  }
  catch (const InputError& error)
  {
    throw InputError(lines.Path() + ":" + std::to_string(lines.Line()) + ": " + error.what());
  }
  return camera;
}

std::vector<Camera> ReadCameras(const std::string& path)
{
  TextLines lines(path);
  std::vector<Camera> cameras;
  while (lines.Next())
  {
    if (const std::optional<Camera> camera = CameraNote(lines))
    {
      cameras.push_back(*camera);
    }
  }
  if (cameras.empty())
  {
    throw InputError(path +
                     ": there is no camera in it; write lines such as # camera NAME eye X Y Z "
                     "look-at X Y Z up X Y Z fov DEGREES aspect RATIO");
  }
  return cameras;
}

std::string PrintCamera(const Camera& camera)
{
  if (camera.name.empty() || camera.name.find_first_of(" \t\r\n\f\v") != std::string::npos)
  {
    throw InputError(
      "camera '" + camera.name + "': OBJ asks for names without white space; rename it");
  }
  return "# camera " + camera.name + " eye " + PrintTriple(camera.eye) + " look-at " +
         PrintTriple(camera.lookAt) + " up " + PrintTriple(camera.up) + " fov " +
         PrintNumber(camera.fieldOfView) + " aspect " + PrintNumber(camera.aspect) + "\n";
}

} // namespace vantage
