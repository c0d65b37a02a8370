#pragma once

#include "core/scene/Scene.h"

#include <string>
#include <vector>

/// \file SceneFile.h
/// Scenes by the suffix of their file: .obj (io/ObjFile.h) and .vtp (SceneAdapter.h).

namespace vantage
{

const std::vector<std::string>& SceneSuffixes();

/// A valid scene. `warnings` receives a line for each thing that was read over.
/// \throw InputError that says what, where and the mend.
Scene ReadScene(const std::string& path, std::vector<std::string>* warnings = nullptr);

/// \throw InputError when the suffix is unknown or the file cannot be written.
void WriteScene(const Scene& scene, const std::string& path);

} // namespace vantage
