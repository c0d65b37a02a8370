#pragma once

#include "core/scene/Scene.h"

#include <string>
#include <vector>

/// \file ObjFile.h
/// Scenes as Wavefront OBJ with MTL materials.
///
/// Read: polygons as they are (no triangulation, at most 255 corners), front side by the right-hand
/// rule; the materials of MtlFile.h; and cameras, which are comments to all other programs: see
/// CameraFile.h. A polygon before any usemtl gets a material of albedo 0.5 named "default" (with a
/// prime when a file has one of that name). Groups, normals and texture coordinates are read over;
/// lines, points and curves too, with a warning.

namespace vantage
{

/// Coordinates are read correctly rounded, so that what WriteObj wrote comes back to the bit.
/// `warnings` receives one line for each thing that was read over.
/// \throw InputError "file:line: what; mend" at the first of: no such file or material file, an
/// unknown statement, a control character, a word that should be a finite number and is not, too
/// few numbers or corners, an index of 0 or out of range (negative ones count from the end), a
/// material that no file defines, a value out of range, no polygons.
Scene ReadObj(const std::string& path, std::vector<std::string>* warnings = nullptr);

/// Writes `path` and, beside it, the materials under the same name with the suffix .mtl; both
/// whole or not at all. \throw InputError when the scene is not valid, a name cannot be written
/// (OBJ asks for unique names without white space) or a file cannot be written.
void WriteObj(const Scene& scene, const std::string& path);

/// The name of the materials file that WriteObj writes.
std::string MtlPathOf(const std::string& objPath);

} // namespace vantage
