#pragma once

#include "core/scene/Scene.h"

#include <string>
#include <vector>

/// \file ObjLines.h
/// The strict half of reading OBJ. tinyobjloader knows the grammar of faces, groups and materials,
/// but takes "nan" for 0, passes over lines it does not understand, and its numbers are not
/// correctly rounded. So every line is checked here first, and the numbers are read here.

namespace vantage
{

/// What the lines of an OBJ file say, apart from the faces' own grammar.
struct ObjLines
{
  std::vector<Vec3> vertices;
  std::vector<Material> materials; ///< of all .mtl files, in order
  std::vector<Camera> cameras;
  std::size_t faces = 0;
  std::vector<std::string> warnings;
};

/// \throw InputError as ReadObj does.
ObjLines ReadObjLines(const std::string& path);

/// Undoes the backslashes of a file name in a mtllib statement; tinyobjloader knows them as well.
std::string UnescapeFileName(const std::string& name);

} // namespace vantage
