#include "io/ObjFile.h"

#include "core/Error.h"
#include "io/AtomicFile.h"
#include "io/CameraFile.h"
#include "io/MtlFile.h"
#include "io/ObjLines.h"
#include "io/TextLines.h"

#include <filesystem>
#include <fstream>
#include <map>
#include <tiny_obj_loader.h>

namespace vantage
{

namespace
{

/// Hands tinyobjloader the names of materials that were read already.
class KnownMaterials : public tinyobj::MaterialReader
{
public:
  explicit KnownMaterials(const std::vector<Material>& materials)
    : Materials(materials)
  {
  }

  bool operator()(const std::string&, std::vector<tinyobj::material_t>*,
    std::map<std::string, int>* idOfName, std::string*, std::string*) override
  {
    for (std::size_t m = 0; m < this->Materials.size(); ++m)
    {
      idOfName->emplace(this->Materials[m].name, static_cast<int>(m));
    }
    return true;
  }

private:
  const std::vector<Material>& Materials;
};

/// Appends the polygons of a shape; a material of -1 becomes `defaultMaterial`.
void AppendShape(const tinyobj::mesh_t& mesh, std::uint32_t defaultMaterial, Scene& scene)
{
  std::size_t corner = 0;
  for (std::size_t f = 0; f < mesh.num_face_vertices.size(); ++f)
  {
    for (int k = 0; k < mesh.num_face_vertices[f]; ++k)
    {
      scene.indices.push_back(static_cast<std::uint32_t>(mesh.indices[corner++].vertex_index));
    }
    scene.offsets.push_back(static_cast<std::uint32_t>(scene.indices.size()));
    const int material = mesh.material_ids[f];
    scene.materialOfPolygon.push_back(
      material < 0 ? defaultMaterial : static_cast<std::uint32_t>(material));
  }
}

void AddDefaultMaterialIfUsed(Scene& scene)
{
  const auto id = static_cast<std::uint32_t>(scene.materials.size());
  for (const std::uint32_t material : scene.materialOfPolygon)
  {
    if (material == id)
    {
      Material plain;
      plain.name = "default";
      scene.materials.push_back(plain);
      return;
    }
  }
}

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

Scene ReadObj(const std::string& path, std::vector<std::string>* warnings)
{
  ObjLines lines = ReadObjLines(path);
  if (lines.faces == 0)
  {
    throw InputError(path + ": it has no polygons; add at least one face (f)");
  }

  tinyobj::attrib_t attributes;
  std::vector<tinyobj::shape_t> shapes;
  std::vector<tinyobj::material_t> unused;
  KnownMaterials materials(lines.materials);
  std::string complaints;
  std::string errors;
  std::ifstream file(path, std::ios::binary);
  const bool isRead =
    tinyobj::LoadObj(&attributes, &shapes, &unused, &complaints, &errors, &file, &materials, false);

  Scene scene;
  scene.vertices = std::move(lines.vertices);
  scene.materials = std::move(lines.materials);
  scene.cameras = std::move(lines.cameras);
  const auto defaultMaterial = static_cast<std::uint32_t>(scene.materials.size());
  for (const tinyobj::shape_t& shape : shapes)
  {
    AppendShape(shape.mesh, defaultMaterial, scene);
  }
  if (!isRead || scene.PolygonCount() != lines.faces)
  {
    throw InputError(path + ": it cannot be read as OBJ (" + errors.substr(0, errors.find('\n')) +
                     "); export it again");
  }
  AddDefaultMaterialIfUsed(scene);
  scene.Validate();
  if (warnings)
  {
    warnings->insert(warnings->end(), lines.warnings.begin(), lines.warnings.end());
  }
  return scene;
}

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
