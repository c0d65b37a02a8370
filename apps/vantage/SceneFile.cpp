#include "SceneFile.h"

#include "CommandLine.h"
#include "SceneAdapter.h"
#include "VtkFile.h"
#include "core/Error.h"
#include "io/ObjFile.h"

namespace vantage
{

const std::vector<std::string>& SceneSuffixes()
{
  static const std::vector<std::string> suffixes = { ".obj", ".vtp" };
  return suffixes;
}

Scene ReadScene(const std::string& path, std::vector<std::string>* warnings)
{
  RequireSuffix(path, SceneSuffixes());
  if (SuffixOf(path) == ".obj")
  {
    return ReadObj(path, warnings);
  }
  const vtkSmartPointer<vtkPolyData> polygons = ReadPolyData(path);
  try
  {
    Scene scene = PolyDataToScene(polygons);
    scene.Validate();
    return scene;
  }
  catch (const InputError& error)
  {
    throw InputError(path + ": " + error.what());
  }
}

void WriteScene(const Scene& scene, const std::string& path)
{
  RequireSuffix(path, SceneSuffixes());
  if (SuffixOf(path) == ".obj")
  {
    WriteObj(scene, path);
  }
  else
  {
    WritePolyData(SceneToPolyData(scene), path);
  }
}

} // namespace vantage
