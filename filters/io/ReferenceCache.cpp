#include "io/ReferenceCache.h"

#include "core/Error.h"
#include "io/ExrFile.h"

#include <cstdio>
#include <filesystem>

namespace vantage
{

ReferenceImage CachedReference(const std::string& folder, const std::string& name,
  const Scene& scene, const Camera& camera, const ReferenceSettings& settings,
  const ReferenceProgress& progress)
{
  char hash[17];
  std::snprintf(hash, sizeof hash, "%016llx",
    static_cast<unsigned long long>(ReferenceKey(scene, camera, settings)));
  const auto fileOf = [&](int half)
  {
    const std::string file = name + "-" + hash + (half == 0 ? "-a.exr" : "-b.exr");
    return (std::filesystem::path(folder) / file).string();
  };
  ReferenceHalves images;
  if (std::filesystem::exists(fileOf(0)) && std::filesystem::exists(fileOf(1)))
  {
    images.halves = { ReadExr(fileOf(0)), ReadExr(fileOf(1)) };
    return images.Joined();
  }
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (!std::filesystem::is_directory(folder))
  {
    throw InputError(folder + ": the folder for references cannot be made (" +
                     (error ? error.message() : "it is a file") + "); choose another");
  }
  images = MakeReferenceHalves(scene, camera, settings, progress);
  for (int half = 0; half < 2; ++half)
  {
    WriteExr(images.halves[half], fileOf(half));
  }
  return images.Joined();
}

} // namespace vantage
