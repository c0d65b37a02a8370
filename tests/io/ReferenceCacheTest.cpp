#include "io/ReferenceCache.h"

#include "core/Error.h"
#include "io/Files.h"
#include "support/TestScenes.h"

#include <gtest/gtest.h>

namespace vantage
{
namespace
{

TEST(ReferenceCache, AFolderThatCannotBeMadeIsNamed)
{
  const test::TemporaryFolder folder;
  const Scene scene = test::MakeLitBox();
  folder.Write("file", "no folder");
  for (const std::string name : { "file", "file/below" })
  {
    try
    {
      CachedReference(folder / name, "box", scene, scene.cameras[0]);
      FAIL() << "a reference was made in " << name;
    }
    catch (const InputError& error)
    {
      const std::string message = error.what();
      EXPECT_EQ(message.find(folder / name), 0u) << message;
      EXPECT_NE(message.find("; choose another"), std::string::npos) << message;
    }
  }
}

} // namespace
} // namespace vantage
