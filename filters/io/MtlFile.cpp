#include "io/MtlFile.h"

#include "core/Error.h"
#include "io/TextLines.h"

#include <algorithm>
#include <limits>
#include <unordered_set>

namespace vantage
{

namespace
{

constexpr double Infinity = std::numeric_limits<double>::infinity();

Color ReadColor(const TextLines& lines, const std::string& what, double high)
{
  if (lines.Words().size() != 4)
  {
    lines.Fail(what + " needs three numbers", "write red, green and blue");
  }
  const Color c = lines.Triple(1);
  for (int k = 0; k < 3; ++k)
  {
    if (c[k] < 0.0)
    {
      lines.Fail(what + " " + PrintNumber(c[k]) + " is negative", "write zero or more");
    }
    if (c[k] > high)
    {
      lines.Fail(what + " " + PrintNumber(c[k]) + " is above " + PrintNumber(high),
        "a surface cannot reflect more than it receives: write " + PrintNumber(high) + " or less");
    }
  }
  return c;
}

Color ReadEmission(const TextLines& lines)
{
  const Color emission = ReadColor(lines, "emission (Ke)", Infinity);
  for (int k = 0; k < 3; ++k)
  {
    if (!IsComputable(emission[k]))
    {
      lines.Fail("emission (Ke) " + PrintNumber(emission[k]) + " is too dim or too bright",
        "write 0, or a number between 1e-100 and 1e100");
    }
  }
  return emission;
}

double ReadShininess(const TextLines& lines)
{
  const double shininess = lines.Number(1);
  if (shininess < 0.0)
  {
    lines.Fail("shininess (Ns) " + PrintNumber(shininess) + " is negative", "write zero or more");
  }
  return shininess;
}

bool ReadIsTwoSided(const TextLines& lines)
{
  const double sides = lines.Number(1);
  if (sides != 1.0 && sides != 2.0)
  {
    lines.Fail("sides is " + PrintNumber(sides), "write 1 or 2");
  }
  return sides == 2.0;
}

/// Name of a new material, which is taken from here on.
std::string ReadName(const TextLines& lines, std::unordered_set<std::string>& taken)
{
  if (lines.Words().size() != 2)
  {
    lines.Fail("newmtl needs a name of one word", "write one, without white space");
  }
  const std::string name(lines.Words()[1]);
  if (!taken.insert(name).second)
  {
    lines.Fail("material " + TextLines::Quoted(name) + " is defined for the second time",
      "rename one of them");
  }
  return name;
}

/// One statement about the material.
void ReadStatement(const TextLines& lines, Material& material, std::vector<std::string>* warnings)
{
  const std::string_view word = lines.Words()[0];
  if (word == "Kd")
  {
    material.albedo = ReadColor(lines, "albedo (Kd)", 1.0);
  }
  else if (word == "Ke")
  {
    material.emission = ReadEmission(lines);
  }
  else if (word == "Ks")
  {
    material.specular = ReadColor(lines, "specular reflectance (Ks)", 1.0);
  }
  else if (word == "Ns")
  {
    material.shininess = ReadShininess(lines);
  }
  else if (word == "sides")
  {
    material.twoSided = ReadIsTwoSided(lines);
  }
  else if (word.substr(0, 4) == "map_" && warnings)
  {
    warnings->push_back(lines.Path() + ":" + std::to_string(lines.Line()) + ": texture " +
                        std::string(word) + " is ignored; bake it into Kd or Ke");
  }
}

/// Programs for modelling write highlights as Ks, whatever is left of the light after Kd.
void LimitSpecular(
  const TextLines& lines, std::size_t line, Material& material, std::vector<std::string>* warnings)
{
  const double most = MaxChannel(material.albedo + material.specular);
  if (most <= 1.0 + 1e-12) // a rounding of the sum, as in Scene::Validate
  {
    return;
  }
  double part = 1.0;
  for (int k = 0; k < 3; ++k)
  {
    if (material.specular[k] > 0.0)
    {
      part = std::min(part, (1.0 - material.albedo[k]) / material.specular[k]);
    }
  }
  material.specular *= part;
  if (warnings)
  {
    warnings->push_back(lines.Path() + ":" + std::to_string(line) + ": material '" + material.name +
                        "': Kd + Ks is " + PrintNumber(most) +
                        ", above 1; Ks is lowered to what Kd leaves");
  }
}

} // namespace

void ReadMtl(
  const std::string& path, std::vector<Material>& materials, std::vector<std::string>* warnings)
{
  TextLines lines(path);
  const std::size_t first = materials.size();
  std::unordered_set<std::string> taken;
  for (const Material& m : materials)
  {
    taken.insert(m.name);
  }
  std::size_t lineOfMaterial = 0;
  while (lines.Next())
  {
    const std::string_view word = lines.Words()[0];
    if (word == "newmtl")
    {
      if (materials.size() > first)
      {
        LimitSpecular(lines, lineOfMaterial, materials.back(), warnings);
      }
      Material material;
      material.name = ReadName(lines, taken);
      materials.push_back(material);
      lineOfMaterial = lines.Line();
    }
    else if (word.front() != '#')
    {
      if (materials.size() == first)
      {
        lines.Fail(
          TextLines::Quoted(word) + " stands before the first newmtl", "name the material first");
      }
      ReadStatement(lines, materials.back(), warnings);
    }
  }
  if (materials.size() > first)
  {
    LimitSpecular(lines, lineOfMaterial, materials.back(), warnings);
  }
}

std::string PrintMtl(const std::vector<Material>& materials)
{
  std::string text;
  std::unordered_set<std::string> names;
  for (const Material& m : materials)
  {
    if (m.name.empty() || m.name.find_first_of(" \t\r\n\f\v") != std::string::npos)
    {
      throw InputError("material '" + m.name +
                       "': OBJ asks for names without white space; "
                       "rename it");
    }
    if (!names.insert(m.name).second)
    {
      throw InputError("material '" + m.name + "': there are two of that name; rename one");
    }
    text += "newmtl " + m.name + "\nKd " + PrintTriple(m.albedo) + "\nKe " +
            PrintTriple(m.emission) + "\nKs " + PrintTriple(m.specular) + "\nNs " +
            PrintNumber(m.shininess) + "\nsides " + (m.twoSided ? "2\n\n" : "1\n\n");
  }
  return text;
}

} // namespace vantage
