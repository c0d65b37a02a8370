#include "CommandLine.h"

#include "core/Error.h"

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <iostream>
#include <tbb/global_control.h>

namespace vantage
{

namespace
{

std::string OneLine(std::string text)
{
  while (!text.empty() && std::isspace(static_cast<unsigned char>(text.back())))
  {
    text.pop_back();
  }
  std::replace(text.begin(), text.end(), '\n', ' ');
  std::replace(text.begin(), text.end(), '\r', ' ');
  return text;
}

} // namespace

void PrintError(const std::string& what)
{
  std::cerr << "vantage: " << OneLine(what) << '\n';
}

void PrintWarnings(const std::vector<std::string>& warnings)
{
  for (const std::string& warning : warnings)
  {
    PrintError("warning: " + warning);
  }
}

std::string SuffixOf(const std::string& path)
{
  std::string suffix = std::filesystem::path(path).extension().string();
  std::transform(suffix.begin(), suffix.end(), suffix.begin(),
    [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return suffix;
}

void RequireSuffix(const std::string& path, const std::vector<std::string>& known)
{
  const std::string suffix = SuffixOf(path);
  if (std::find(known.begin(), known.end(), suffix) == known.end())
  {
    throw InputError(path + ": unknown suffix '" + suffix + "'; choose one of: " + Join(known));
  }
}

void PrepareFolder(const std::string& folder)
{
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (error)
  {
    throw InputError(
      folder + ": cannot be made a folder (" + error.message() + "); choose another one with -o");
  }
}

std::size_t ThreadsFor(int asked)
{
  return asked > 0
           ? static_cast<std::size_t>(asked)
           : tbb::global_control::active_value(tbb::global_control::max_allowed_parallelism);
}

std::string Join(const std::vector<std::string>& words)
{
  std::string text;
  for (const std::string& word : words)
  {
    text += (text.empty() ? "" : ", ") + word;
  }
  return text;
}

} // namespace vantage
