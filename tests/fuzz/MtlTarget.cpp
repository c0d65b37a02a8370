#include "fuzz/Target.h"
#include "io/Files.h"
#include "io/MtlFile.h"

namespace vantage::fuzz
{

/// The bytes are an .mtl, which is refused whole or gives materials that a scene may have, and that
/// come back when they are written.
void ReadBytes(const std::string& bytes)
{
  static const test::TemporaryFolder folder;
  Scene scene;
  std::vector<std::string> warnings;
  if (!IsRead([&] { ReadMtl(folder.Write("m.mtl", bytes), scene.materials, &warnings); }) ||
      scene.materials.empty())
  {
    return;
  }
  scene.AddPolygon({ Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, 1, 0) }, 0);
  scene.Validate();
  Scene again = scene;
  again.materials.clear();
  ReadMtl(folder.Write("again.mtl", PrintMtl(scene.materials)), again.materials);
  RequireSame(again, scene);
}

} // namespace vantage::fuzz
