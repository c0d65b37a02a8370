#include "io/ObjLines.h"

#include "core/Error.h"
#include "io/CameraFile.h"
#include "io/MtlFile.h"
#include "io/TextLines.h"

#include <algorithm>
#include <charconv>
#include <filesystem>
#include <set>

namespace vantage
{

namespace
{

/// tinyobjloader counts the corners of a face in one byte.
constexpr std::size_t MostCorners = 255;

/// Statements without a meaning for light.
const std::set<std::string_view> Harmless = { "vn", "vt", "vp", "vw", "t", "g", "o", "s", "mg",
  "usemap", "maplib", "lod", "bevel", "c_interp", "d_interp", "shadow_obj", "trace_obj" };

/// Shapes that are no polygons.
const std::set<std::string_view> OtherShapes = { "l", "p", "cstype", "deg", "bmat", "step", "curv",
  "curv2", "surf", "parm", "trim", "hole", "scrv", "sp", "end", "con", "ctech", "stech" };

/// Reads a file from first to last line.
class ObjLineReader
{
public:
  explicit ObjLineReader(const std::string& path)
    : Lines(path)
  {
  }

  ObjLines Read()
  {
    while (this->Lines.Next())
    {
      this->ReadLine();
    }
    if (this->LargestIndex > static_cast<long long>(this->Result.vertices.size()))
    {
      this->FailIndex(this->LineOfLargestIndex, std::to_string(this->LargestIndex));
    }
    if (this->Lines.EndsAbruptly())
    {
      this->Warn("the last line has no line end; the file may have been cut off");
    }
    return std::move(this->Result);
  }

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
      this->CheckUseOfMaterial();
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
      this->Lines.Fail("'" + std::string(word.substr(0, 20)) + "' is no statement of OBJ",
        "mend or remove the line");
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
      this->CheckCorner(this->Lines.Words()[i]);
    }
    ++this->Result.faces;
  }

  /// A corner is v, v/vt, v//vn or v/vt/vn; only v matters.
  void CheckCorner(std::string_view corner)
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
        this->CheckIndex(corner, text, part == 0);
      }
      begin = end + 1;
      ++part;
    }
  }

  void CheckIndex(std::string_view corner, std::string_view text, bool isVertex)
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
    // A positive index may refer to a vertex further down.
    if (isVertex && index > this->LargestIndex)
    {
      this->LargestIndex = index;
      this->LineOfLargestIndex = this->Lines.Line();
    }
  }

  void CheckUseOfMaterial()
  {
    const auto& words = this->Lines.Words();
    const std::vector<Material>& known = this->Result.materials;
    const std::string name(words.size() > 1 ? words[1] : "");
    if (std::none_of(known.begin(), known.end(), [&](const Material& m) { return m.name == name; }))
    {
      this->Lines.Fail("material '" + name + "' is in no .mtl file named above",
        "define it there or correct the name");
    }
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
    if (name.empty() || !std::filesystem::is_regular_file(path))
    {
      this->Lines.Fail(
        "material file '" + path + "' does not exist", "put it there or correct the mtllib line");
    }
    if (this->ReadMaterialFiles.insert(path).second)
    {
      ReadMtl(path, this->Result.materials, &this->Result.warnings);
    }
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
    this->Result.warnings.push_back(
      this->Lines.Path() + ":" + std::to_string(this->Lines.Line()) + ": " + what);
  }

  [[noreturn]] void FailCorner(std::string_view corner) const
  {
    this->Lines.Fail("'" + std::string(corner) + "' is no corner of a face",
      "write v, v/vt, v//vn or v/vt/vn with whole numbers");
  }

  [[noreturn]] void FailIndex(std::size_t line, const std::string& index) const
  {
    this->Lines.FailAt(line, "vertex index " + index + " is out of range",
      "the file has " + std::to_string(this->Result.vertices.size()) +
        " vertices up to here, counted from 1, or from -1 backwards");
  }

  TextLines Lines;
  ObjLines Result;
  std::set<std::string> ReadMaterialFiles;
  std::set<std::string> WarnedShapes;
  long long LargestIndex = 0;
  std::size_t LineOfLargestIndex = 0;
};

} // namespace

ObjLines ReadObjLines(const std::string& path)
{
  return ObjLineReader(path).Read();
}

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

} // namespace vantage
