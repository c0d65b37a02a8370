#pragma once

#include "core/scene/Scene.h"

#include <array>
#include <optional>
#include <string>
#include <vector>

namespace CLI
{
class App;
}

/// \file CameraOptions.h
/// The arguments that say from where a scene is seen, and how large.

namespace vantage
{

struct CameraOptions
{
  std::vector<std::string> names; ///< of cameras of the scene
  std::optional<std::array<double, 3>> eye, lookAt, up;
  std::optional<double> fieldOfView;
  std::optional<std::array<int, 2>> size; ///< pixels

  /// \throw InputError when there are no pixels.
  void Validate() const;
  /// Width and height of a camera's image: as asked for, or 512 high.
  std::array<int, 2> SizeOf(const Camera& camera) const;
  /// The cameras of the names, or those of the walk, else the first of the scene, changed by --eye
  /// and the like; their aspect ratios are those of the images. At least one. \throw InputError
  /// \param file of the scene, for complaints
  std::vector<Camera> Choose(
    const Scene& scene, const std::string& file, const std::vector<Camera>& walk = {}) const;
};

/// Declares all but the names; `options` must outlive the parsing.
void DeclareCameraOptions(CLI::App& command, CameraOptions& options);

} // namespace vantage
