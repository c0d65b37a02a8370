#include "report/Provenance.h"

#include "TextTable.h"

#include <cstdio>
#include <fstream>
#include <iterator>
#include <sys/utsname.h>
#include <thread>
#include <unistd.h>

namespace vantage
{

namespace
{

/// What follows "model name :" in the description of the first processor.
std::string ProcessorName()
{
  std::ifstream file("/proc/cpuinfo");
  for (std::string line; std::getline(file, line);)
  {
    if (line.rfind("model name", 0) == 0)
    {
      const std::size_t begin = line.find_first_not_of(" \t", line.find(':') + 1);
      return begin == std::string::npos ? "" : line.substr(begin);
    }
  }
  return "";
}

} // namespace

std::string HashOfText(const std::string& text)
{
  std::uint64_t hash = 0xcbf29ce484222325ull;
  for (const char c : text)
  {
    hash = (hash ^ static_cast<unsigned char>(c)) * 0x100000001b3ull;
  }
  char digits[17];
  std::snprintf(digits, sizeof digits, "%016llx", static_cast<unsigned long long>(hash));
  return digits;
}

std::string HashOfImage(const Image& image)
{
  const char* bytes = reinterpret_cast<const char*>(image.pixels.data());
  return HashOfText(
    std::to_string(image.width) + ' ' + std::string(bytes, image.pixels.size() * sizeof(Color)));
}

std::string ProgramVersion()
{
  static const std::string version = []
  {
    std::ifstream program("/proc/self/exe", std::ios::binary);
    const std::string bytes{ std::istreambuf_iterator<char>(program), {} };
    return std::string(VANTAGE_VERSION ", build ") + HashOfText(bytes);
  }();
  return version;
}

std::string LibraryVersions()
{
  return VANTAGE_LIBRARIES ", compiler " __VERSION__;
}

std::string MachineDescription()
{
  std::string text = ProcessorName();
  text += (text.empty() ? "" : ", ") + std::to_string(std::thread::hardware_concurrency()) +
          " processors";
  const double bytes =
    static_cast<double>(sysconf(_SC_PHYS_PAGES)) * static_cast<double>(sysconf(_SC_PAGE_SIZE));
  text += ", " + Fixed(bytes / 1e9, 0) + " GB";
  utsname system{};
  if (uname(&system) == 0)
  {
    text += std::string(", ") + system.sysname + ' ' + system.release;
  }
  return text;
}

} // namespace vantage
