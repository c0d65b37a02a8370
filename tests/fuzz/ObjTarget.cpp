#include "fuzz/Target.h"
#include "io/Files.h"
#include "io/ObjFile.h"

namespace vantage::fuzz
{

/// The bytes are an .obj beside a good m.mtl with the materials a and b. What was read comes back
/// when it is written.
void ReadBytes(const std::string& bytes)
{
  static const test::TemporaryFolder folder;
  static const std::string materials =
    folder.Write("m.mtl", "newmtl a\nKd .5 .5 .5\nnewmtl b\nKe 1 1 1\nsides 1\n");
  const std::string path = folder.Write("s.obj", bytes);
  Scene scene;
  std::vector<std::string> warnings;
  if (!IsRead([&] { scene = ReadObj(path, &warnings); }))
  {
    return;
  }
  scene.Validate();
  WriteObj(scene, folder / "again.obj");
  RequireSame(ReadObj(folder / "again.obj"), scene);
}

} // namespace vantage::fuzz
