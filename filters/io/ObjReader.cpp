#include "core/Error.h"
#include "io/CameraFile.h"
#include "io/MtlFile.h"
#include "io/ObjFile.h"
#include "io/TextLines.h"

#include <algorithm>
#include <charconv>
#include <filesystem>
#include <set>
#include <unordered_map>

namespace vantage
{

namespace
{

/// The time it takes to cut a polygon into convex parts grows faster than the number of its
/// corners.
constexpr std::size_t MostCorners = 255;

/// Of a polygon before any usemtl, until its material is known.
constexpr std::uint32_t NoMaterial = ~0u;

/// Statements without a meaning for light.
const std::set<std::string_view> Harmless = { "vn", "vt", "vp", "vw", "t", "g", "o", "s", "mg",
  "usemap", "maplib", "lod", "bevel", "c_interp", "d_interp", "shadow_obj", "trace_obj" };

/// Shapes that are no polygons.
const std::set<std::string_view> OtherShapes = { "l", "p", "cstype", "deg", "bmat", "step", "curv",
  "curv2", "surf", "parm", "trim", "hole", "scrv", "sp", "end", "con", "ctech", "stech" };

/// Undoes the backslashes of a file name in a mtllib statement.
std::string UnescapeFileName(const std::string& name)
{
  std::string plain;
  for (std::size_t i = 0; i < name.size(); ++i)
  {
    i += name[i] == '\\' && i + 1 < name.size() ? 1 : 0;
    plain += name[i];
  }
  return plain;
}

/// Reads a file from first to last line.
class ObjLineReader
{
public:
  explicit ObjLineReader(const std::string& path)
    : Lines(path)
  {
  }

  Scene Read()
  {
    while (this->Lines.Next())
    {
      this->ReadLine();
    }
    if (this->LargestIndex > static_cast<long long>(this->Result.vertices.size()))
    {
      this->FailIndex(this->LineOfLargestIndex, std::to_string(this->LargestIndex));
    }
    if (this->Result.PolygonCount() == 0)
    {
      throw InputError(this->Lines.Path() + ": it has no polygons; add at least one face (f)");
    }
    if (this->Lines.EndsAbruptly())
    {
      this->Warn("the last line has no line end; the file may have been cut off");
    }
    this->AddDefaultMaterialIfUsed();
    return std::move(this->Result);
  }

  std::vector<std::string> TakeWarnings() { return std::move(this->Warnings); }

private:
  void ReadLine()
  {
    const std::string_view word = this->Lines.Words()[0];
    if (word == "v")
    {
      this->ReadVertex();
    }
    else if (word == "f")
    {
      this->ReadFace();
    }
    else if (word == "usemtl")
    {
      this->UseMaterial();
    }
    else if (word == "mtllib")
    {
      this->ReadMaterials();
    }
    else if (word == "#")
    {
      this->ReadCameraIfAny();
    }
    else if (OtherShapes.count(word) > 0)
    {
      if (this->WarnedShapes.insert(std::string(word)).second)
      {
        this->Warn("'" + std::string(word) + "' is no polygon and is read over");
      }
    }
    else if (word.front() != '#' && Harmless.count(word) == 0)
    {
      this->Lines.Fail(
        TextLines::Quoted(word) + " is no statement of OBJ", "mend or remove the line");
    }
  }

  void ReadVertex()
  {
    // Some programs append a weight or a colour.
    const std::size_t numbers = this->Lines.Words().size() - 1;
    if (numbers < 3)
    {
      this->Lines.Fail(
        "vertex with " + std::to_string(numbers) + " of three coordinates", "write x, y and z");
    }
    this->Result.vertices.push_back(this->Lines.Triple(1));
    for (std::size_t i = 4; i <= numbers; ++i)
    {
      this->Lines.Number(i);
    }
  }

  void ReadFace()
  {
    const std::size_t corners = this->Lines.Words().size() - 1;
    if (corners < 3 || corners > MostCorners)
    {
      this->Lines.Fail("face with " + std::to_string(corners) + " corners",
        "give three to " + std::to_string(MostCorners));
    }
    for (std::size_t i = 1; i <= corners; ++i)
    {
      this->ReadCorner(this->Lines.Words()[i]);
    }
    this->Result.offsets.push_back(static_cast<std::uint32_t>(this->Result.indices.size()));
    this->Result.materialOfPolygon.push_back(this->CurrentMaterial);
  }

  /// A corner is v, v/vt, v//vn or v/vt/vn; only v matters.
  void ReadCorner(std::string_view corner)
  {
    int part = 0;
    std::size_t begin = 0;
    while (begin <= corner.size())
    {
      const std::size_t end = std::min(corner.find('/', begin), corner.size());
      const std::string_view text = corner.substr(begin, end - begin);
      const bool mayBeEmpty = part == 1 && end < corner.size();
      if (part > 2 || (text.empty() && !mayBeEmpty))
      {
        this->FailCorner(corner);
      }
      if (!text.empty())
      {
        this->ReadIndex(corner, text, part == 0);
      }
      begin = end + 1;
      ++part;
    }
  }

  void ReadIndex(std::string_view corner, std::string_view text, bool isVertex)
  {
    int index = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), index);
    if (error != std::errc() || end != text.data() + text.size())
    {
      this->FailCorner(corner);
    }
    const auto known = static_cast<long long>(this->Result.vertices.size());
    if (index == 0 || (isVertex && -static_cast<long long>(index) > known))
    {
      this->FailIndex(this->Lines.Line(), std::string(text));
    }
    if (!isVertex)
    {
      return;
    }
    this->Result.indices.push_back(
      static_cast<std::uint32_t>(index > 0 ? index - 1 : known + index));
    // A positive index may refer to a vertex further down.
    if (index > this->LargestIndex)
    {
      this->LargestIndex = index;
      this->LineOfLargestIndex = this->Lines.Line();
    }
  }

  void UseMaterial()
  {
    const auto& words = this->Lines.Words();
    const std::string name(words.size() > 1 ? words[1] : "");
    const auto known = this->MaterialOfName.find(name);
    if (known == this->MaterialOfName.end())
    {
      this->Lines.Fail("material " + TextLines::Quoted(name) + " is in no .mtl file named above",
        "define it there or correct the name");
    }
    this->CurrentMaterial = known->second;
  }

  void ReadMaterials()
  {
    const auto& words = this->Lines.Words();
    std::string name;
    for (std::size_t i = 1; i < words.size(); ++i)
    {
      if (i > 1 && (name.empty() || name.back() != '\\'))
      {
        this->Lines.Fail("mtllib names more than one file",
          "write one line for each, and a backslash before a blank in a name");
      }
      name += (i > 1 ? " " : "") + std::string(words[i]);
    }
    const std::filesystem::path folder = std::filesystem::path(this->Lines.Path()).parent_path();
    const std::string path = (folder / UnescapeFileName(name)).string();
    std::error_code error; // such as a name that is too long
    if (name.empty() || !std::filesystem::is_regular_file(path, error))
    {
      this->Lines.Fail(
        "material file '" + path + "' does not exist", "put it there or correct the mtllib line");
    }
    if (this->ReadMaterialFiles.insert(path).second)
    {
      std::vector<Material>& materials = this->Result.materials;
      const std::size_t known = materials.size();
      ReadMtl(path, materials, &this->Warnings);
      for (std::size_t m = known; m < materials.size(); ++m)
      {
        this->MaterialOfName.emplace(materials[m].name, static_cast<std::uint32_t>(m));
      }
    }
  }

  void AddDefaultMaterialIfUsed()
  {
    std::vector<std::uint32_t>& used = this->Result.materialOfPolygon;
    if (std::find(used.begin(), used.end(), NoMaterial) == used.end())
    {
      return;
    }
    std::replace(used.begin(), used.end(), NoMaterial,
      static_cast<std::uint32_t>(this->Result.materials.size()));
    Material plain;
    plain.name = "default";
    while (this->MaterialOfName.count(plain.name) > 0)
    {
      plain.name += "'";
    }
    this->Result.materials.push_back(plain);
  }

  void ReadCameraIfAny()
  {
    if (const std::optional<Camera> camera = CameraNote(this->Lines))
    {
      this->Result.cameras.push_back(*camera);
    }
  }

  void Warn(const std::string& what)
  {
    this->Warnings.push_back(
      this->Lines.Path() + ":" + std::to_string(this->Lines.Line()) + ": " + what);
  }

  [[noreturn]] void FailCorner(std::string_view corner) const
  {
    this->Lines.Fail(TextLines::Quoted(corner) + " is no corner of a face",
      "write v, v/vt, v//vn or v/vt/vn with whole numbers");
  }

  [[noreturn]] void FailIndex(std::size_t line, const std::string& index) const
  {
    this->Lines.FailAt(line, "vertex index " + index + " is out of range",
      "the file has " + std::to_string(this->Result.vertices.size()) +
        " vertices up to here, counted from 1, or from -1 backwards");
  }

  TextLines Lines;
  Scene Result;
  std::vector<std::string> Warnings;
  std::set<std::string> ReadMaterialFiles;
  std::unordered_map<std::string, std::uint32_t> MaterialOfName;
  std::uint32_t CurrentMaterial = NoMaterial;
  std::set<std::string> WarnedShapes;
  long long LargestIndex = 0;
  std::size_t LineOfLargestIndex = 0;
};

} // namespace

Scene ReadObj(const std::string& path, std::vector<std::string>* warnings)
{
  ObjLineReader reader(path);
  Scene scene = reader.Read();
  scene.Validate();
  if (warnings)
  {
    const std::vector<std::string> found = reader.TakeWarnings();
    warnings->insert(warnings->end(), found.begin(), found.end());
  }
  return scene;
}

} // namespace vantage
