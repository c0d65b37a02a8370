#include "io/AtomicFile.h"
#include "core/Error.h"
#include "io/Files.h"

#include <gtest/gtest.h>

namespace vantage
{
namespace
{

using test::ReadText;
using test::TemporaryFolder;

TEST(AtomicFile, WritesAndReplaces)
{
  const TemporaryFolder folder;
  WriteTextAtomically(folder / "a.txt", "one");
  WriteTextAtomically(folder / "a.txt", "two");
  EXPECT_EQ(ReadText(folder / "a.txt"), "two");
  EXPECT_EQ(folder.FileCount(), 1u);
}

TEST(AtomicFile, AFailedWriterLeavesTheOldFile)
{
  const TemporaryFolder folder;
  WriteTextAtomically(folder / "a.txt", "old");
  EXPECT_THROW(WriteAtomically(folder / "a.txt",
                 [](const std::string& temporary)
                 {
                   std::ofstream(temporary) << "half";
                   throw InputError("stop");
                 }),
    InputError);
  EXPECT_EQ(ReadText(folder / "a.txt"), "old");
  EXPECT_EQ(folder.FileCount(), 1u);
}

TEST(AtomicFile, TheTemporaryNameKeepsFolderAndSuffix)
{
  const TemporaryFolder folder;
  WriteAtomically(folder / "a.b.png",
    [&](const std::string& temporary)
    {
      EXPECT_EQ(std::filesystem::path(temporary).extension(), ".png");
      EXPECT_EQ(std::filesystem::path(temporary).parent_path(),
        std::filesystem::path(folder / "a.b.png").parent_path());
    });
}

TEST(AtomicFile, CheckingLeavesNothingBehind)
{
  const TemporaryFolder folder;
  CheckWritable(folder / "a.txt");
  EXPECT_EQ(folder.FileCount(), 0u);
}

TEST(AtomicFile, RefusesFoldersAndWhatIsNoFile)
{
  const TemporaryFolder folder;
  EXPECT_THROW(CheckWritable(folder / "none/a.txt"), InputError);
  EXPECT_THROW(CheckWritable(folder / "."), InputError);
  EXPECT_THROW(CheckWritable("/dev/null"), InputError);
  EXPECT_THROW(CheckWritable(""), InputError);
}

TEST(AtomicFile, FollowsALink)
{
  const TemporaryFolder folder;
  WriteTextAtomically(folder / "target.txt", "old");
  std::filesystem::create_symlink("target.txt", folder / "link.txt");
  WriteTextAtomically(folder / "link.txt", "new");
  EXPECT_EQ(ReadText(folder / "target.txt"), "new");
  EXPECT_TRUE(std::filesystem::is_symlink(folder / "link.txt"));
}

} // namespace
} // namespace vantage
