#include "io/AtomicFile.h"

#include "core/Error.h"

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <sys/stat.h>
#include <unistd.h>

namespace vantage
{

namespace
{

namespace fs = std::filesystem;

[[noreturn]] void Refuse(const fs::path& path, const std::string& why)
{
  throw InputError(path.string() + ": cannot be written (" + why +
                   "); choose another file or check folder and permissions");
}

/// Where the bytes shall end up: what a link points to, else the path itself.
fs::path Target(const std::string& path)
{
  if (fs::path(path).filename().empty())
  {
    Refuse(path, "it is not the name of a file");
  }
  std::error_code error;
  fs::path target = fs::weakly_canonical(path, error);
  if (error)
  {
    target = path;
  }
  const fs::file_status status = fs::status(target, error);
  if (fs::exists(status) && !fs::is_regular_file(status))
  {
    Refuse(path, "it is not an ordinary file");
  }
  // A rename would replace a file that its owner has protected.
  if (fs::exists(status) && access(path.c_str(), W_OK) != 0)
  {
    Refuse(path, std::strerror(errno));
  }
  return target;
}

/// An empty file beside the target, removed at the end of its life unless it was moved.
class TemporaryFile
{
public:
  explicit TemporaryFile(const fs::path& target)
  {
    const std::string suffix = target.extension().string();
    this->Name = (target.parent_path() / (target.stem().string() + ".XXXXXX" + suffix)).string();
    const int file = mkstemps(this->Name.data(), static_cast<int>(suffix.size()));
    if (file < 0)
    {
      const std::string why = std::strerror(errno);
      this->Name.clear();
      Refuse(target, why);
    }
    // mkstemps makes files that only the owner may read; give the usual permissions instead.
    const mode_t mask = umask(0);
    umask(mask);
    fchmod(file, 0666 & ~mask);
    close(file);
  }
  TemporaryFile(const TemporaryFile&) = delete;
  TemporaryFile& operator=(const TemporaryFile&) = delete;
  ~TemporaryFile()
  {
    if (!this->Name.empty())
    {
      unlink(this->Name.c_str());
    }
  }

  const std::string& Path() const { return this->Name; }

  void MoveTo(const fs::path& target)
  {
    if (std::rename(this->Name.c_str(), target.c_str()) != 0)
    {
      Refuse(target, std::strerror(errno));
    }
    this->Name.clear();
  }

private:
  std::string Name;
};

} // namespace

void CheckWritable(const std::string& path)
{
  const TemporaryFile probe(Target(path));
}

void WriteAtomically(
  const std::string& path, const std::function<void(const std::string& temporary)>& write)
{
  const fs::path target = Target(path);
  TemporaryFile file(target);
  write(file.Path());
  file.MoveTo(target);
}

void WriteTextAtomically(const std::string& path, const std::string& text)
{
  WriteAtomically(path,
    [&](const std::string& temporary)
    {
      std::ofstream file(temporary, std::ios::binary);
      file << text;
      file.close();
      if (!file)
      {
        Refuse(path, "writing failed, the disk may be full");
      }
    });
}

} // namespace vantage
