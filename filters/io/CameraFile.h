#pragma once

#include "core/scene/Camera.h"

#include <optional>
#include <string>
#include <vector>

/// \file CameraFile.h
/// Cameras as lines of text. OBJ files hold them as comments; a file of nothing else is a walk:
///
///     # camera NAME eye X Y Z look-at X Y Z up X Y Z fov DEGREES aspect RATIO
///
/// with the vertical field of view and width / height.

namespace vantage
{

class TextLines;

/// The camera that the line notes; nothing for any other line.
/// \throw InputError "file:line: what; mend" when the note is not complete or the camera not valid.
std::optional<Camera> CameraNote(const TextLines& lines);

/// All cameras of a file, in its order; what else it holds is read over.
/// \throw InputError as above, or when there is no file or no camera in it.
std::vector<Camera> ReadCameras(const std::string& path);

/// A line, with its end. \throw InputError for a name that is empty or has white space.
std::string PrintCamera(const Camera& camera);

} // namespace vantage
