#pragma once

#include "core/scene/Scene.h"

#include <string>
#include <vector>

/// \file MtlFile.h
/// Materials of Wavefront OBJ scenes.

namespace vantage
{

/// Appends the materials of a file. What is read of each:
///   newmtl NAME   one word
///   Kd R G B      albedo, 0 .. 1, default 0.5
///   Ke R G B      emitted radiance, W m^-2 sr^-1, 0 (default) or 1e-100 .. 1e100
///   Ks R G B      reflectance of the normalised Phong lobe, 0 .. 1, default 0
///   Ns N          its exponent, >= 0, default 0
///   sides 1|2     1: the back neither reflects nor emits; default 2 (a statement of Vantage's own)
/// All else is ignored, textures with a warning. Ks is lowered where Kd + Ks is above 1, with a
/// warning.
/// \throw InputError "file:line: what; mend": no such file, not a number, value out of range,
/// a name that is used twice.
void ReadMtl(const std::string& path, std::vector<Material>& materials,
  std::vector<std::string>* warnings = nullptr);

/// The text of such a file. \throw InputError when a name is empty, has white space or is not
/// unique: OBJ could not refer to it.
std::string PrintMtl(const std::vector<Material>& materials);

} // namespace vantage
