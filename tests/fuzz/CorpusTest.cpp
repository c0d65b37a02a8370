#include "fuzz/Target.h"
#include "io/Files.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace vantage
{
namespace
{

std::vector<std::string> CorpusFiles()
{
  std::vector<std::string> paths;
  for (const auto& entry : std::filesystem::directory_iterator(VANTAGE_CORPUS))
  {
    paths.push_back(entry.path().string());
  }
  std::sort(paths.begin(), paths.end());
  return paths;
}

TEST(Corpus, EveryFileIsReadOrRefused)
{
  ASSERT_FALSE(CorpusFiles().empty());
  for (const std::string& path : CorpusFiles())
  {
    EXPECT_NO_THROW(fuzz::ReadBytes(test::ReadText(path))) << path;
  }
}

TEST(Corpus, EveryFileCutOffAnywhereIsReadOrRefused)
{
  constexpr std::size_t Places = 40;
  for (const std::string& path : CorpusFiles())
  {
    const std::string whole = test::ReadText(path);
    const std::size_t step = whole.size() / Places + 1;
    for (std::size_t size = 0; size < whole.size(); size += step)
    {
      EXPECT_NO_THROW(fuzz::ReadBytes(whole.substr(0, size))) << path << " cut off at " << size;
    }
  }
}

} // namespace
} // namespace vantage
