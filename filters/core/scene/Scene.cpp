#include "core/scene/Scene.h"

#include "core/Error.h"

#include <algorithm>
#include <cmath>

namespace vantage
{

namespace
{

bool IsFinite(const Vec3& v)
{
  return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

bool IsWithin(const Color& c, double low, double high)
{
  for (int k = 0; k < 3; ++k)
  {
    if (!(c[k] >= low && c[k] <= high))
    {
      return false;
    }
  }
  return true;
}

std::string Print(const Color& c)
{
  return "(" + std::to_string(c.x) + ", " + std::to_string(c.y) + ", " + std::to_string(c.z) + ")";
}

void ValidateMaterial(const Material& m)
{
  const std::string who = "material '" + m.name + "': ";
  if (!IsWithin(m.albedo, 0.0, 1.0))
  {
    throw InputError(who + "albedo " + Print(m.albedo) + " must lie between 0 and 1");
  }
  if (!IsFinite(m.emission) || !IsWithin(m.emission, 0.0, HUGE_VAL))
  {
    throw InputError(who + "emission " + Print(m.emission) + " must be finite and not negative");
  }
  for (int k = 0; k < 3; ++k)
  {
    if (!IsComputable(m.emission[k]))
    {
      throw InputError(who + "emission must be 0, or between 1e-100 and 1e100: squares of it are "
                             "computed; choose another unit");
    }
  }
  if (!IsWithin(m.specular, 0.0, 1.0))
  {
    throw InputError(who + "specular " + Print(m.specular) + " must lie between 0 and 1");
  }
  if (!IsWithin(m.albedo + m.specular, 0.0, 1.0 + 1e-12))
  {
    throw InputError(who + "albedo + specular " + Print(m.albedo + m.specular) +
                     " is above 1: it would reflect more than it receives; lower one of them");
  }
  if (!(m.shininess >= 0.0 && std::isfinite(m.shininess)))
  {
    throw InputError(who + "shininess must be finite and not negative");
  }
}

void ValidatePolygons(const Scene& scene)
{
  if (scene.PolygonCount() == 0)
  {
    throw InputError("scene: it has no polygons; add at least one");
  }
  for (std::size_t p = 0; p < scene.PolygonCount(); ++p)
  {
    const std::string who = "polygon " + std::to_string(p) + ": ";
    const std::size_t end = scene.offsets[p + 1];
    if (end < std::size_t{ scene.offsets[p] } + 3 || end > scene.indices.size())
    {
      throw InputError(who + "needs at least three vertices");
    }
    for (std::uint32_t i = scene.offsets[p]; i < scene.offsets[p + 1]; ++i)
    {
      if (scene.indices[i] >= scene.vertices.size())
      {
        throw InputError(who + "vertex index " + std::to_string(scene.indices[i]) +
                         " is out of range; the scene has " +
                         std::to_string(scene.vertices.size()) + " vertices");
      }
    }
    if (scene.materialOfPolygon[p] >= scene.materials.size())
    {
      throw InputError(who + "material index " + std::to_string(scene.materialOfPolygon[p]) +
                       " is out of range; the scene has " + std::to_string(scene.materials.size()) +
                       " materials");
    }
  }
}

} // namespace

void Scene::AddPolygon(const std::vector<Vec3>& points, std::uint32_t material)
{
  for (const Vec3& p : points)
  {
    this->indices.push_back(static_cast<std::uint32_t>(this->vertices.size()));
    this->vertices.push_back(p);
  }
  this->offsets.push_back(static_cast<std::uint32_t>(this->indices.size()));
  this->materialOfPolygon.push_back(material);
}

std::vector<std::string> WarningsOf(const std::vector<Material>& materials)
{
  const auto isSpecular = [](const Material& m) { return MaxChannel(m.specular) > 0.0; };
  const auto count = std::count_if(materials.begin(), materials.end(), isSpecular);
  if (count == 0)
  {
    return {};
  }
  const auto first = std::find_if(materials.begin(), materials.end(), isSpecular);
  return { "materials: the specular part of '" + first->name + "'" +
           (count > 1 ? " and of " + std::to_string(count - 1) + " more" : "") +
           " is left out, as all surfaces are computed as diffuse" };
}

void Scene::Validate() const
{
  if (this->materialOfPolygon.size() != this->PolygonCount())
  {
    throw InputError("scene: " + std::to_string(this->PolygonCount()) + " polygons but " +
                     std::to_string(this->materialOfPolygon.size()) +
                     " material indices; give one each");
  }
  for (std::size_t v = 0; v < this->vertices.size(); ++v)
  {
    if (!IsFinite(this->vertices[v]))
    {
      throw InputError("vertex " + std::to_string(v) + ": its coordinates must be finite numbers");
    }
  }
  for (const Material& m : this->materials)
  {
    ValidateMaterial(m);
  }
  ValidatePolygons(*this);
  for (const Camera& c : this->cameras)
  {
    c.Validate();
  }
}

const Camera& Scene::FindCamera(const std::string& wanted) const
{
  std::string known;
  for (const Camera& c : this->cameras)
  {
    if (c.name == wanted)
    {
      return c;
    }
    known += (known.empty() ? "" : ", ") + c.name;
  }
  throw UnknownNameError("camera", wanted, known.empty() ? "(the scene has none)" : known);
}

} // namespace vantage
