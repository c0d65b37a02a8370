#pragma once

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <gtest/gtest.h>
#include <iterator>
#include <string>

/// \file Files.h
/// Files that a test makes and reads.

namespace vantage::test
{

/// An empty folder that lives as long as this object.
class TemporaryFolder
{
public:
  TemporaryFolder()
  {
    std::string name = (std::filesystem::temp_directory_path() / "vantage-XXXXXX").string();
    if (mkdtemp(name.data()) == nullptr)
    {
      ADD_FAILURE() << "cannot make the folder " << name;
    }
    this->Folder = name;
  }
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;
  ~TemporaryFolder()
  {
    std::error_code ignored;
    std::filesystem::remove_all(this->Folder, ignored);
  }

  std::string operator/(const std::string& name) const { return (this->Folder / name).string(); }

  /// Writes a text, returns its path.
  std::string Write(const std::string& name, const std::string& text) const
  {
    std::ofstream(this->Folder / name, std::ios::binary) << text;
    return *this / name;
  }

  std::size_t FileCount() const
  {
    const std::filesystem::directory_iterator files(this->Folder);
    return static_cast<std::size_t>(std::distance(begin(files), end(files)));
  }

private:
  std::filesystem::path Folder;
};

inline std::string ReadText(const std::string& path)
{
  std::ifstream file(path, std::ios::binary);
  return { std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>() };
}

} // namespace vantage::test
