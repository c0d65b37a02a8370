#include "CameraOptions.h"

#include "core/Error.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>

namespace vantage
{

namespace
{

constexpr int DefaultHeight = 512;

Vec3 ToVec3(const std::array<double, 3>& v)
{
  return { v[0], v[1], v[2] };
}

} // namespace

void CameraOptions::Validate() const
{
  if (this->size && ((*this->size)[0] < 1 || (*this->size)[1] < 1))
  {
    throw InputError("--size: " + std::to_string((*this->size)[0]) + " " +
                     std::to_string((*this->size)[1]) +
                     " has no pixels; give a width and a height of 1 or more");
  }
}

std::array<int, 2> CameraOptions::SizeOf(const Camera& camera) const
{
  const int width = std::max(1, static_cast<int>(std::lround(DefaultHeight * camera.aspect)));
  return this->size.value_or(std::array<int, 2>{ width, DefaultHeight });
}

std::vector<Camera> CameraOptions::Choose(
  const Scene& scene, const std::string& file, const std::vector<Camera>& walk) const
{
  std::vector<Camera> chosen = walk;
  for (const std::string& name : this->names)
  {
    chosen.push_back(scene.FindCamera(name));
  }
  if (chosen.empty() && !scene.cameras.empty())
  {
    chosen.push_back(scene.cameras.front());
  }
  if (chosen.empty() && (!this->eye || !this->lookAt))
  {
    throw InputError(file + ": it has no camera; give --eye X Y Z and --look-at X Y Z");
  }
  if (chosen.empty())
  {
    chosen.emplace_back().up = Vec3(0.0, 0.0, 1.0);
  }
  for (Camera& camera : chosen)
  {
    camera.eye = this->eye ? ToVec3(*this->eye) : camera.eye;
    camera.lookAt = this->lookAt ? ToVec3(*this->lookAt) : camera.lookAt;
    camera.up = this->up ? ToVec3(*this->up) : camera.up;
    camera.fieldOfView = this->fieldOfView.value_or(camera.fieldOfView);
    const auto [width, height] = this->SizeOf(camera);
    camera.aspect = static_cast<double>(width) / height;
    camera.Validate();
  }
  return chosen;
}

void DeclareCameraOptions(CLI::App& command, CameraOptions& options)
{
  command.add_option("--eye", options.eye, "Position X Y Z");
  command.add_option("--look-at", options.lookAt, "Middle of the image X Y Z");
  command.add_option("--up", options.up, "Upward direction X Y Z [0 0 1 without a camera]");
  command.add_option("--fov", options.fieldOfView, "Vertical field of view, degrees");
  command.add_option("--size", options.size, "Pixels W H [height 512]");
}

} // namespace vantage
