#include "fuzz/Target.h"

#include <algorithm>

namespace vantage::fuzz
{

namespace
{

void RequireSame(const Material& a, const Material& b)
{
  Require(a.name == b.name && a.albedo == b.albedo && a.emission == b.emission &&
            a.specular == b.specular && a.shininess == b.shininess && a.twoSided == b.twoSided,
    "material '" + a.name + "' comes back changed");
}

void RequireSame(const Camera& a, const Camera& b)
{
  Require(a.name == b.name && a.eye == b.eye && a.lookAt == b.lookAt && a.up == b.up &&
            a.fieldOfView == b.fieldOfView && a.aspect == b.aspect,
    "camera '" + a.name + "' comes back changed");
}

template <typename T>
void RequireSameList(const std::vector<T>& a, const std::vector<T>& b)
{
  Require(a.size() == b.size(), "materials or cameras are lost");
  for (std::size_t i = 0; i < a.size(); ++i)
  {
    RequireSame(a[i], b[i]);
  }
}

} // namespace

bool IsRead(const std::function<void()>& read)
{
  try
  {
    read();
    return true;
  }
  catch (const InputError& error)
  {
    const std::string line = error.what();
    Require(!line.empty(), "a message that says nothing");
    Require(std::none_of(line.begin(), line.end(),
              [](char c) { return static_cast<unsigned char>(c) < ' ' || c == '\x7f'; }),
      "a message with control characters");
    return false;
  }
}

void RequireSame(const Scene& a, const Scene& b)
{
  Require(a.vertices == b.vertices && a.indices == b.indices && a.offsets == b.offsets &&
            a.materialOfPolygon == b.materialOfPolygon,
    "polygons come back changed");
  RequireSameList(a.materials, b.materials);
  RequireSameList(a.cameras, b.cameras);
}

} // namespace vantage::fuzz
