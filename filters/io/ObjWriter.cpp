#include "io/ObjFile.h"

#include "core/Error.h"
#include "io/AtomicFile.h"
#include "io/CameraFile.h"
#include "io/MtlFile.h"
#include "io/TextLines.h"

#include <filesystem>

namespace vantage
{

namespace
{

/// A blank in a file name of a mtllib statement is written with a backslash.
std::string EscapeFileName(const std::string& name)
{
  std::string escaped;
  for (const char c : name)
  {
    escaped += c == ' ' || c == '\\' ? std::string{ '\\', c } : std::string{ c };
  }
  return escaped;
}

std::string PrintPolygons(const Scene& scene)
{
  std::string text;
  std::uint32_t current = ~0u;
  for (std::size_t p = 0; p < scene.PolygonCount(); ++p)
  {
    if (scene.materialOfPolygon[p] != current)
    {
      current = scene.materialOfPolygon[p];
      text += "usemtl " + scene.materials[current].name + "\n";
    }
    text += "f";
    for (std::uint32_t i = scene.offsets[p]; i < scene.offsets[p + 1]; ++i)
    {
      text += " " + std::to_string(scene.indices[i] + 1);
    }
    text += "\n";
  }
  return text;
}

} // namespace

void WriteObj(const Scene& scene, const std::string& path)
{
  scene.Validate();
  const std::string mtlPath = MtlPathOf(path);
  std::string text;
  for (const Camera& camera : scene.cameras)
  {
    text += PrintCamera(camera);
  }
  text += "mtllib " + EscapeFileName(std::filesystem::path(mtlPath).filename().string()) + "\n";
  for (const Vec3& v : scene.vertices)
  {
    text += "v " + PrintTriple(v) + "\n";
  }
  text += PrintPolygons(scene);

  // The scene is renamed last, so that it never stands there without its materials.
  WriteAtomically(path,
    [&](const std::string& temporary)
    {
      WriteTextAtomically(temporary, text);
      WriteTextAtomically(mtlPath, PrintMtl(scene.materials));
    });
}

std::string MtlPathOf(const std::string& objPath)
{
  return std::filesystem::path(objPath).replace_extension(".mtl").string();
}

} // namespace vantage
